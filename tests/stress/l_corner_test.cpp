// The paper's L-shaped wall at 60 mph, entered at every angle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "extent.h"
#include "ode_joints.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double sixtyMph = 26.8224;

// The faces of testRail(), as its header gives them: at 6° and 101° to the x axis.
const Vector2 sideNormal = rotated(Vector2::UnitY(), 6.0 * degree);
const Vector2 sidePoint(42.334, -0.900);
const Vector2 endNormal = rotated(-Vector2::UnitX(), 11.0 * degree);
const Vector2 endPoint(67.197, 1.713);

Vector2 meeting() {
  const Vector2 along = -turnedLeft(sideNormal);
  return sidePoint + endNormal.dot(endPoint - sidePoint) / endNormal.dot(along) * along;
}

// Towards a point `before` the corner along the side wall, at an angle to that wall.
PlanarMotion entryAt(double angle, double before) {
  const Vector2 along = -turnedLeft(sideNormal);
  const Vector2 way = rotated(along, -angle);
  const Vector2 aim = meeting() + 1.5 * sideNormal - (1.5 + before) * along;
  return {.position = aim - 14.0 * way,
          .yaw = std::atan2(way.y(), way.x()),
          .velocity = sixtyMph * way,
          .yawRate = 0.0};
}

// How far the outline's corners lie behind either face, m.
double behind(const VehicleParameters& car, const PlanarMotion& motion) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Vector2& corner : Outline(car).corners()) {
    const Vector2 place = motion.position + rotated(corner, motion.yaw);
    deepest =
        std::max({deepest, -sideNormal.dot(place - sidePoint), -endNormal.dot(place - endPoint)});
  }
  return deepest;
}

class LCorner : public ::testing::TestWithParam<double> {};

TEST_P(LCorner, AtEveryAngle) {
  const double h = GetParam();
  const Scene scene = testRail();
  double worst = -1.0;
  std::size_t mostEvents = 0;
  for (int angle = 1; angle <= 89; angle += extent(4, 1)) {
    for (const double before : {0.0, 0.7, 2.0, 5.0}) {
      const PlanarMotion start = entryAt(angle * degree, before);
      OdeWorld ode;
      Responder responder(ode.world);
      responder.addBarrier(scene);
      BoxCar car(ode.world);
      responder.addVehicle(car.body, car.parameters);
      place(car, start);
      if (behind(car.parameters, start) > 0.0) continue;
      const double energyAtStart = lawEnergyOf(car, responder);
      double energy = energyAtStart;
      std::size_t events = 0;
      std::ostringstream what;
      printExactly(what, car.parameters, start, {}) << angle << "°, step " << h;
      for (int i = 0; i * h < 4.0; ++i) {
        for (const ImpactEvent& event : responder.step(h)) {
          if (event.phase != EventPhase::impact) continue;
          ++events;
          EXPECT_LE(event.energyRatio, 1.0 + 1e-12) << what.str();
        }
        EXPECT_EQ(responder.issues(), step_issue::none) << what.str() << " at step " << i;
        dWorldQuickStep(ode.world, h);
        const double energyBefore = energy;
        energy = lawEnergyOf(car, responder);
        EXPECT_LE(energy, energyBefore * (1.0 + 1e-11)) << what.str();
        const double depth = behind(car.parameters, motionOf(car.body));
        worst = std::max(worst, depth);
        EXPECT_LE(depth, 1e-3) << what.str() << " at step " << i;
        if (::testing::Test::HasFailure()) return;
      }
      EXPECT_GE(events, 1U) << what.str();
      EXPECT_LT(energy, 0.95 * energyAtStart) << what.str();
      mostEvents = std::max(mostEvents, events);
    }
  }
  std::printf("[ figures  ] deepest %.3g mm, at most %zu events\n", 1e3 * worst, mostEvents);
}

INSTANTIATE_TEST_SUITE_P(Steps, LCorner, ::testing::Values(0.001, 0.005, 0.02, 0.05),
                         [](const auto& each) {
                           return std::to_string(std::lround(1e3 * each.param)) + "ms";
                         });

TEST(LCornerWithContactJoints, SinksInOrGainsEnergy) {
  double deepest = 0.0;
  double mostEnergy = 0.0;
  double topRise = 0.0;
  for (int angle = 1; angle <= 89; angle += 8) {
    OdeWorld ode;
    ode.bounce = 0.05;
    const OdeMesh walls(ode.space, testRail());
    BoxCar car(ode.world, ode.space);
    place(car, entryAt(angle * degree, 0.7));
    const double energy = energyOf(car.body);
    for (int i = 0; i < 400; ++i) {
      ode.step(0.005, nullptr, [] {});
      deepest = std::max(deepest, behind(car.parameters, motionOf(car.body)));
      mostEnergy = std::max(mostEnergy, energyOf(car.body) / energy);
      topRise = std::max(topRise, std::abs(car.velocity().z()));
    }
  }
  std::printf("[ figures  ] joints: deepest %.3f m, energy %.3f, rise %.2f m/s\n", deepest,
              mostEnergy, topRise);
  EXPECT_GT(deepest, 0.05);
}

}  // namespace
}  // namespace bumper::tests
