// Walls of one barrier answer each for itself while another one's force pulse runs or after it
// broke.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "free_drive.h"

namespace bumper::tests {
namespace {

using Eigen::Vector2d;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double h = 0.005;

struct Sample {
  Vector2d position;
  Vector2d ahead;
  Eigen::Vector3d velocity;
};

double farthestApart(const std::vector<Sample>& a, const std::vector<Sample>& b) {
  double farthest = a.size() == b.size() ? 0.0 : 1e9;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    farthest = std::max({farthest, (a[i].position - b[i].position).norm(),
                         (a[i].ahead - b[i].ahead).norm(), (a[i].velocity - b[i].velocity).norm()});
  }
  return farthest;
}

struct Outcome {
  std::vector<Sample> way;
  std::vector<ImpactEvent> impacts;  // their names are void
  double deepest = -1e9;             // intrusion of the last line
  double energyRatio = 1.0;
};

/// A drive at lines of sheets, all in one barrier or each in its own.
Outcome driveAt(const std::vector<std::vector<Vector2d>>& lines, bool together,
                const ResponseSettings& settings, const Vector2d& place, double yaw, double speed,
                double duration) {
  FreeDrive drive({.response = settings});
  Scene all;
  for (const std::vector<Vector2d>& line : lines) {
    addSheets(all, line);
    if (!together) drive.responder.addBarrier(sheets(line));
  }
  if (together) drive.responder.addBarrier(all);
  drive.start(place, yaw, speed);
  Outcome outcome;
  const double before = drive.energy();
  for (double t = 0.0; t < duration; t += h) {
    for (const ImpactEvent& event : drive.step(h)) {
      if (event.phase == EventPhase::impact) outcome.impacts.push_back(event);
    }
    outcome.way.push_back({drive.position(), drive.ahead(), drive.car.velocity()});
    outcome.deepest = std::max(outcome.deepest, drive.intrusion(lines.back()));
  }
  outcome.energyRatio = drive.energy() / before;
  return outcome;
}

// The side wall is grazed, the end wall follows 1.5 m on, before or after the corner is reached.
TEST(LongContact, DoesNotMuteAnotherWallOfItsBarrier) {
  constexpr double speed = 25.0;
  for (const double contactTime : {0.02, 0.05, 0.1, 0.2}) {
    for (const double angle : {2.0, 4.0, 8.0}) {
      for (const bool meets : {true, false}) {
        SCOPED_TRACE(testing::Message() << contactTime << ' ' << angle << ' ' << meets);
        ResponseSettings settings;
        settings.contactTime = contactTime;
        const double yaw = -angle * degree;
        // The front right corner starts 0.1 m above the side wall.
        const Vector2d corner(2.1 * std::cos(yaw) + 0.9 * std::sin(yaw),
                              2.1 * std::sin(yaw) - 0.9 * std::cos(yaw));
        const Vector2d place = Vector2d(0.0, 0.1) - corner;
        const double grazed = 0.1 / std::tan(angle * degree);
        const double end = grazed + 1.5;
        const std::vector<std::vector<Vector2d>> lines{
            {{-30.0, 0.0}, {meets ? end : end - 0.5, 0.0}},
            {{end, meets ? 0.0 : -3.0}, {end, 15.0}}};
        const Outcome one = driveAt(lines, true, settings, place, yaw, speed, 0.8);
        const Outcome two = driveAt(lines, false, settings, place, yaw, speed, 0.8);
        EXPECT_LE(farthestApart(one.way, two.way), 1e-6);
        EXPECT_LE(one.deepest, 0.5 * speed * contactTime);
        EXPECT_GE(one.impacts.size(), 2U);
        EXPECT_LT(one.way.back().velocity.x(), 0.5 * speed);
      }
    }
  }
}

// Panels that turn by a degree or two each, to either side.
TEST(LongContact, IsOneAlongAWallThatBendsGently) {
  for (const double contactTime : {0.05, 0.1, 0.2}) {
    for (const double turn : {-2.0, -1.0, -0.2, 0.0, 0.2, 1.0, 2.0}) {
      for (const double angle : {3.0, 6.0, 12.0}) {
        SCOPED_TRACE(testing::Message() << contactTime << ' ' << turn << ' ' << angle);
        ResponseSettings settings;
        settings.contactTime = contactTime;
        std::vector<Vector2d> line{{-20.0, 0.0}, {0.0, 0.0}};
        for (int i = 1; i <= 30; ++i) {
          const double heading = i * turn * degree;
          line.push_back(line.back() + 0.7 * Vector2d(std::cos(heading), std::sin(heading)));
        }
        const double yaw = -angle * degree;
        const Vector2d corner(2.1 * std::cos(yaw) + 0.9 * std::sin(yaw),
                              2.1 * std::sin(yaw) - 0.9 * std::cos(yaw));
        // It touches 0.4 m before the first bend.
        const Vector2d place = Vector2d(-0.4 - 0.1 / std::tan(angle * degree), 0.1) - corner;
        const Outcome outcome = driveAt({line}, true, settings, place, yaw, 20.0, 0.6);
        ASSERT_FALSE(outcome.impacts.empty());
        const double first = outcome.impacts.front().time;
        const auto during = std::count_if(
            outcome.impacts.begin(), outcome.impacts.end(),
            [&](const ImpactEvent& event) { return event.time < first + contactTime - 1e-9; });
        EXPECT_EQ(during, 1);
      }
    }
  }
}

ResponseSettings breaking(double remaining) {
  ResponseSettings settings;
  settings.law = Law::energy;
  settings.energyRoot = EnergyRoot::break_through;
  settings.energyRemaining = AngleCurve::constant(remaining);
  return settings;
}

std::vector<std::vector<Vector2d>> fences(int count) {
  std::vector<std::vector<Vector2d>> lines;
  for (int i = 0; i < count; ++i) lines.push_back({{5.0 + 0.5 * i, -8.0}, {5.0 + 0.5 * i, 8.0}});
  return lines;
}

TEST(FencesInARow, EachTakesItsShareHeadOn) {
  for (const int count : {1, 2, 5, 8}) {
    for (const double remaining : {0.7, 0.9}) {
      for (const double speed : {12.0, 40.0}) {
        SCOPED_TRACE(testing::Message() << count << ' ' << remaining << ' ' << speed);
        for (const bool together : {true, false}) {
          const Outcome outcome = driveAt(fences(count), together, breaking(remaining), {0.0, 0.3},
                                          0.0, speed, 30.0 / speed);
          EXPECT_EQ(outcome.impacts.size(), static_cast<std::size_t>(count));
          EXPECT_NEAR(outcome.energyRatio, std::pow(remaining, count), 1e-6);
        }
      }
    }
  }
}

TEST(FencesInARow, OneBarrierOrEachItsOwnIsTheSame) {
  for (const double angle : {-35.0, -10.0, 3.0, 20.0}) {
    for (const double speed : {12.0, 30.0}) {
      SCOPED_TRACE(testing::Message() << angle << ' ' << speed);
      const auto lines = fences(6);
      const Outcome one =
          driveAt(lines, true, breaking(0.9), {0.0, 0.0}, angle * degree, speed, 0.8);
      const Outcome two =
          driveAt(lines, false, breaking(0.9), {0.0, 0.0}, angle * degree, speed, 0.8);
      EXPECT_EQ(one.impacts.size(), 6U);
      EXPECT_EQ(two.impacts.size(), 6U);
      EXPECT_LE(farthestApart(one.way, two.way), 1e-6);
      double product = 1.0;
      for (const ImpactEvent& event : one.impacts) product *= event.energyRatio;
      EXPECT_NEAR(one.energyRatio, product, 1e-6);
    }
  }
}

// Panels of one fence that the front hits at once are one fence.
TEST(FencesInARow, TwoPanelsInLineCountOnce) {
  for (const double joint : {0.0, 0.005}) {
    for (const double seam : {-0.6, 0.0, 0.3}) {
      SCOPED_TRACE(testing::Message() << joint << ' ' << seam);
      FreeDrive drive({.response = breaking(0.8)});
      Scene scene;
      addSheets(scene, {{5.0, -8.0}, {5.0, seam}});
      addSheets(scene, {{5.0, seam + joint}, {5.0, 8.0}});
      drive.responder.addBarrier(scene);
      drive.start({0.0, 0.0}, 0.0, 20.0);
      const double before = drive.energy();
      int impacts = 0;
      for (int i = 0; i < 200; ++i) {
        for (const ImpactEvent& event : drive.step(h)) impacts += event.phase == EventPhase::impact;
      }
      EXPECT_EQ(impacts, 1);
      EXPECT_NEAR(drive.energy() / before, 0.8, 1e-6);
    }
  }
}

}  // namespace
}  // namespace bumper::tests
