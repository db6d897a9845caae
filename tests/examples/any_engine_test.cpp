// The car of an engine of one's own, by both of the paper's ways, against an ODE body with Bumper:
// the same flight between walls, in steps of any size.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "../engine_adapter/free_drive.h"
#include "own_car.h"

namespace bumper::tests {
namespace {

using examples::OwnCar;

// 0.2 to 20 ms, s.
double stepOf(int number) { return 0.0101 + 0.0099 * std::sin(1.7 * number); }

/// The greatest difference of place, heading and velocities, in m, rad and s, over 3 s; impacts are
/// counted.
struct Comparison {
  double byForce = 0.0;
  double byReset = 0.0;
  int impacts = 0;
};

double difference(const PlanarMotion& motion, const FreeDrive& drive) {
  const Eigen::Vector3d velocity = drive.responder.velocity(drive.vehicle);
  const Eigen::Vector2d ahead = drive.ahead();
  return std::max({(motion.position - drive.position()).norm(),
                   (motion.velocity - velocity.head<2>()).norm(),
                   (Vector2(std::cos(motion.yaw), std::sin(motion.yaw)) - ahead).norm(),
                   std::abs(motion.yawRate - drive.responder.yawRate(drive.vehicle))});
}

Comparison compare(const PlanarMotion& start, const ResponseSettings& settings, bool withThrust) {
  // An L, and a short wall that stands in the way.
  const std::array<std::array<Vector2, 2>, 3> lines{{{Vector2(0.0, 0.0), Vector2(40.0, 0.0)},
                                                     {Vector2(40.0, 0.0), Vector2(40.0, 30.0)},
                                                     {Vector2(20.0, 12.0), Vector2(30.0, 13.0)}}};
  FreeDrive drive({.response = settings});
  std::vector<WallSegment> walls;
  for (const auto& [from, to] : lines) {
    drive.responder.addBarrier(sheets({from, to}));
    WallSegment wall;
    wall.start = from;
    wall.end = to;
    wall.normal = turnedLeft((to - from).normalized());
    wall.settings = &settings;
    walls.push_back(wall);
  }
  drive.start(start.position, start.yaw, 0.0);
  drive.car.move({start.velocity.x(), start.velocity.y(), 0.0}, {0.0, 0.0, start.yawRate});
  OwnCar byForce(drive.car.parameters, start);
  OwnCar byReset(drive.car.parameters, start);

  Comparison result;
  double time = 0.0;
  for (int i = 0; time < 3.0; ++i) {
    const double h = stepOf(i);
    if (withThrust) {
      const PlanarForce wind{.force = {900.0, -400.0 * std::cos(0.1 * i)}, .yawMoment = 300.0};
      dBodyAddForce(drive.car.body, wind.force.x(), wind.force.y(), 0.0);
      dBodyAddTorque(drive.car.body, 0.0, 0.0, wind.yawMoment);
      byForce.push(wind);
      byReset.push(wind);
    }
    result.impacts += static_cast<int>(drive.step(h).size());
    byForce.stepByForce(walls, h);
    byReset.stepByReset(walls, h);
    time += h;
    result.byForce = std::max(result.byForce, difference(byForce.motion(), drive));
    result.byReset = std::max(result.byReset, difference(byReset.motion(), drive));
  }
  return result;
}

TEST(AnyEngine, BothWaysAreTheOdeBodysFlight) {
  ResponseSettings energy;
  energy.law = Law::energy;
  for (const ResponseSettings& settings : {ResponseSettings{}, energy}) {
    for (const bool withThrust : {false, true}) {
      int impacts = 0;
      for (int i = 0; i < 20; ++i) {
        const double angle = (8.0 + 3.0 * i) * std::numbers::pi / 180.0;
        const PlanarMotion start{.position = {5.0 + 0.5 * i, 8.0},
                                 .yaw = -angle + 0.05 * i,
                                 .velocity = 25.0 * Vector2(std::cos(angle), -std::sin(angle)),
                                 .yawRate = 0.1 * (i % 7) - 0.3};
        const Comparison found = compare(start, settings, withThrust);
        EXPECT_LT(found.byForce, 1e-9) << i;
        EXPECT_LT(found.byReset, 1e-9) << i;
        impacts += found.impacts;
      }
      EXPECT_GT(impacts, 30);
    }
  }
}

}  // namespace
}  // namespace bumper::tests
