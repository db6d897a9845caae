// A car flush at a wall meets the next one of an inside bend at that wall's own time.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "free_drive.h"

namespace bumper::tests {
namespace {

using Eigen::Vector2d;

constexpr double degree = std::numbers::pi / 180.0;

// Its right side is `off` from the first wall; nothing but the second one stops it.
void expectHeld(double off, double speed, double bend, double h, double bendAt) {
  SCOPED_TRACE(testing::Message() << "off " << off << ", " << speed << " m/s, bend "
                                  << bend / degree << ", step " << h << ", at " << bendAt);
  const Vector2d joint(bendAt, 0.0);
  const Vector2d along(std::cos(bend), std::sin(bend));
  const Vector2d normal(-along.y(), along.x());
  FreeDrive drive;
  drive.responder.addBarrier(sheets({{-20.0, 0.0}, joint, joint + 20.0 * along}));
  drive.start({0.0, 0.9 + off}, 0.0, speed);
  // The corner is in the second wall's plane then.
  const double expected = (bendAt - 2.1 + off / std::tan(bend)) / speed;
  std::optional<ImpactEvent> hit;
  double deepest = -1.0;
  for (double t = 0.0; t < expected + 0.05; t += h) {
    for (const ImpactEvent& event : drive.step(h)) {
      if (event.phase != EventPhase::impact || hit) continue;
      if (event.normal.head<2>().dot(normal) > std::cos(0.5 * bend)) hit = event;
    }
    const Vector2d corner = drive.world({2.1, -0.9});
    if (along.dot(corner - joint) > 0.0) deepest = std::max(deepest, -normal.dot(corner - joint));
  }
  ASSERT_TRUE(hit);
  // What stands in the first wall touches the second one's end before its plane or after.
  EXPECT_NEAR(hit->time, expected,
              off >= 0.0 ? 1e-6 : 1e-6 + std::abs(off) / std::tan(bend) / speed);
  // Head-on the whole front is hit.
  if (bend < 80.0 * degree) {
    EXPECT_NEAR((hit->contact.head<2>() - joint).norm(), 0.0, 0.3);
  }
  EXPECT_NEAR(hit->approachSpeed, speed * std::sin(bend), 1e-3 * speed);
  EXPECT_LE(deepest, 1e-4 + std::max(-off, 0.0));
}

TEST(InsideBend, IsMetAtItsOwnTime) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(3.0, 4.0);
  for (const double off : {0.0, -5e-5, 1e-3}) {
    for (const double speed : {10.0, 25.0, 40.0}) {
      for (const double bend : {10.0, 15.0, 30.0, 45.0, 70.0, 90.0}) {
        for (const double h : {0.001, 0.005, 0.0167}) {
          expectHeld(off, speed, bend * degree, h, place(random));
        }
      }
    }
  }
}

}  // namespace
}  // namespace bumper::tests
