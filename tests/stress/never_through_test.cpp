// 120 m/s and steps of 50 ms: the car moves by more than its own length in a step. Walls of no
// thickness, posts and bare ends stop it all the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>

#include "../response/random_impacts.h"
#include "bumper/engine_adapter/responder.h"
#include "extent.h"
#include "ode_joints.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double topSpeed = 120.0;
constexpr double longestStep = 0.05;

struct Approach {
  double heading = 0.0;  // rad, from the x axis
  double aside = 0.0;    // m: how far left of the origin the way passes
  double gap = 0.0;      // m: from the mass centre to the point of the way nearest the origin
  double yaw = 0.0;      // rad, against the heading
};

PlanarMotion startOf(const Approach& approach, double speed) {
  const Vector2 ahead = rotated(Vector2::UnitX(), approach.heading);
  return {.position = approach.aside * turnedLeft(ahead) - approach.gap * ahead,
          .yaw = approach.heading + approach.yaw,
          .velocity = speed * ahead,
          .yawRate = 0.0};
}

struct Passage {
  int impacts = 0;
  double deepest = 0.0;  // m, beyond what sliding may make of it
  bool through = false;  // the mass centre went through a wall
  double slowest = topSpeed;
  PlanarMotion end;
};

Passage drive(const Plan& plan, const PlanarMotion& start, double h, double duration) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(standing(plan));
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  place(car, start);
  Passage passage;
  double mostInside = 0.0;
  PlanarMotion before = start;
  for (int i = 0; i * h < duration; ++i) {
    passage.impacts +=
        static_cast<int>(std::ranges::count_if(responder.step(h), [](const ImpactEvent& event) {
          return event.phase == EventPhase::impact;
        }));
    dWorldQuickStep(ode.world, h);
    const PlanarMotion now = motionOf(car.body);
    mostInside = std::max({mostInside, slidingDepth(car.parameters, before, h),
                           slidingDepth(car.parameters, now, h)});
    passage.deepest =
        std::max(passage.deepest, deepestIntrusion(car.parameters, now, plan) - mostInside);
    passage.through = passage.through || leadsThrough(before.position, now.position, plan);
    passage.slowest = std::min(passage.slowest, now.velocity.norm());
    before = now;
  }
  passage.end = before;
  return passage;
}

// What stands across the way of a car that comes along the x axis.
struct Obstacle {
  const char* name;
  Plan plan;
  double halfWidth;  // m: the obstacle reaches this far left and right of the origin
};

std::vector<Obstacle> obstacles() {
  return {{"wall without thickness", {{{0.0, -30.0}, {0.0, 30.0}}}, 30.0},
          {"wall of 1 mm", slab({{0.0, -30.0}, {0.0, 30.0}}, 0.001), 30.0},
          {"oblique wall of 1 mm", slab({{-20.0, -30.0}, {20.0, 30.0}}, 0.001), 30.0},
          {"post of 10 cm", slab({{-0.05, 0.0}, {0.05, 0.0}}, 0.1), 0.05},
          {"bare end", {{{0.0, 0.0}, {30.0, 0.0}}}, 0.0},
          {"bare end of a slab", slab({{0.0, 0.0}, {30.0, 0.0}}, 0.3), 0.15},
          {"two posts",
           [] {
             Plan two = slab({{-0.05, -0.5}, {0.05, -0.5}}, 0.1);
             const Plan second = slab({{-0.05, 0.5}, {0.05, 0.5}}, 0.1);
             two.insert(two.end(), second.begin(), second.end());
             return two;
           }(),
           0.55}};
}

TEST(NeverThrough, AtTopSpeedAndLongestStep) {
  const double halfWidth = 0.9;
  for (const Obstacle& obstacle : obstacles()) {
    Random random(7);
    for (int i = 0; i < extent(100, 5'000); ++i) {
      const double speed = i % 4 == 0 ? topSpeed : random.uniform(1.0, topSpeed);
      const double h = i % 2 == 0 ? longestStep : random.uniform(0.001, longestStep);
      const double reach = 0.999 * (halfWidth + std::min(obstacle.halfWidth, 4.0));
      const Approach approach{.aside = random.uniform(-reach, reach),
                              .gap = 20.0 + random.uniform(0.0, speed * h)};
      const PlanarMotion start = startOf(approach, speed);
      const Passage passage = drive(obstacle.plan, start, h, 40.0 / speed + 5.0 * h);
      const auto describe = [&](std::ostream& out) -> std::ostream& {
        return out << obstacle.name << ", " << std::setprecision(17) << speed << " m/s, step " << h
                   << " s, aside " << approach.aside << " m, gap " << approach.gap << " m";
      };
      std::ostringstream what;
      describe(what);
      EXPECT_GE(passage.impacts, 1) << what.str();
      EXPECT_FALSE(passage.through) << what.str();
      EXPECT_LE(passage.deepest, 0.0) << what.str();
      if (::testing::Test::HasFailure()) break;  // the next obstacle
    }
  }
}

// Turned and turning cars meet the post with whatever side comes: nothing reaches into the outline.
TEST(NeverThrough, TurnedAndTurning) {
  for (const Obstacle& obstacle : obstacles()) {
    Random random(8);
    double deepest = 0.0;
    int through = 0;
    std::string deepestCase;
    for (int i = 0; i < extent(100, 5'000); ++i) {
      const Approach approach{.heading = random.uniform(-180.0, 180.0) * degree,
                              .aside = random.uniform(-3.0, 3.0),
                              .gap = random.uniform(60.0, 70.0),
                              .yaw = random.uniform(-180.0, 180.0) * degree};
      PlanarMotion start = startOf(approach, random.uniform(1.0, topSpeed));
      start.yawRate = random.uniform(-10.0, 10.0);
      const double h = random.uniform(0.001, longestStep);
      OdeWorld unused;
      if (deepestIntrusion(BoxCar(unused.world).parameters, start, obstacle.plan) > 0.0) continue;
      const Passage passage =
          drive(obstacle.plan, start, h, 80.0 / start.velocity.norm() + 5.0 * h);
      through += passage.through ? 1 : 0;
      if (passage.deepest <= deepest) continue;
      deepest = passage.deepest;
      std::ostringstream what;
      printExactly(what, BoxCar(unused.world).parameters, start, obstacle.plan) << "step " << h;
      deepestCase = what.str();
    }
    EXPECT_EQ(deepest, 0.0) << obstacle.name << "; deepest of all:\n" << deepestCase;
    EXPECT_EQ(through, 0) << obstacle.name;
  }
}

// How deep a disc reaches into the outline, m.
double discIntrusion(const VehicleParameters& car, const PlanarMotion& pose, const Vector2& centre,
                     double radius) {
  const Vector2 place = rotated(centre - pose.position, -pose.yaw);
  const Vector2 beyond(
      std::max(place.x() - car.massCentreToFront, -place.x() - car.massCentreToRear),
      std::abs(place.y()) - 0.5 * car.width);
  const double distance = beyond.x() > 0.0 && beyond.y() > 0.0 ? beyond.norm() : beyond.maxCoeff();
  return std::max(0.0, radius - distance);
}

// The application's own geom, a pole.
TEST(NeverThrough, Cylinder) {
  Random random(9);
  double deepest = 0.0;
  for (int i = 0; i < extent(200, 10'000); ++i) {
    const double radius = random.uniform(0.02, 0.5);
    const double speed = i % 4 == 0 ? topSpeed : random.uniform(1.0, topSpeed);
    const double h = i % 2 == 0 ? longestStep : random.uniform(0.001, longestStep);
    const bool straight = i % 3 != 0;
    OdeWorld ode;
    const dGeomID pole = dCreateCylinder(ode.space, radius, 2.0);
    dGeomSetPosition(pole, 0.0, 0.0, 1.0);
    Responder responder(ode.world);
    responder.addBarrier(pole);
    BoxCar car(ode.world);
    responder.addVehicle(car.body, car.parameters);
    const double reach = 0.999 * (0.9 + radius);
    PlanarMotion start = startOf({.aside = random.uniform(-reach, reach),
                                  .gap = 10.0 + random.uniform(0.0, speed * h),
                                  .yaw = straight ? 0.0 : random.uniform(-3.14, 3.14)},
                                 speed);
    if (!straight) start.yawRate = random.uniform(-10.0, 10.0);
    place(car, start);
    std::size_t events = 0;
    double mostInside = slidingDepth(car.parameters, start, h);
    for (int k = 0; k * h < 20.0 / speed + 5.0 * h; ++k) {
      events += responder.step(h).size();
      dWorldQuickStep(ode.world, h);
      const double depth =
          discIntrusion(car.parameters, motionOf(car.body), Vector2::Zero(), radius);
      deepest = std::max(deepest, depth);
      std::ostringstream what;
      printExactly(what, car.parameters, start, {})
          << "radius " << radius << ", step " << h << ", at step " << k;
      mostInside = std::max(mostInside, slidingDepth(car.parameters, motionOf(car.body), h));
      ASSERT_LE(depth, mostInside) << what.str();
    }
    if (straight) {
      ASSERT_GE(events, 1U) << "radius " << radius << ", speed " << speed << ", step " << h
                            << ", aside " << start.position.y();
    }
  }
}

// ODE looks where the car is when a step begins, and sees it before the wall and then behind it.
TEST(NeverThrough, ContactJointsMissWallsAndPosts) {
  for (const Obstacle& obstacle : obstacles()) {
    int missed = 0;
    constexpr int phases = 30;
    for (int i = 0; i < phases; ++i) {
      const PlanarMotion start =
          startOf({.gap = 20.0 + i * topSpeed * longestStep / phases}, topSpeed);
      const JointRun run =
          runWithJoints(obstacle.plan, start, {.step = longestStep, .duration = 0.4});
      // Beyond what it met with nearly all of its speed, or run through by it.
      const bool beyond = run.end.position.x() > 5.0 && run.end.velocity.x() > 0.9 * topSpeed;
      missed += beyond || run.deepest > 0.5 ? 1 : 0;
    }
    EXPECT_GT(missed, 0) << obstacle.name;
  }
}

}  // namespace
}  // namespace bumper::tests
