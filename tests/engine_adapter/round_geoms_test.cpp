// Spheres and capsules as barriers, and what is said of classes whose shape ODE does not tell.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "bumper/response/error.h"
#include "turned_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

// The car's band: 0.275 m (half of its mass centre's height) to 0.75 m above the ground.
constexpr double bandBottom = 0.275;
constexpr double bandTop = 0.75;

/// Drives at 15 m/s along x at the given y until the first impact; it has no vehicle if there was
/// none.
ImpactEvent firstImpact(TurnedWorld& world, double y) {
  const VehicleId car =
      world.addCar({.place = {-10.0, y, 0.55}, .velocity = {15.0, 0.0, 0.0}}, "car");
  ImpactEvent found;
  const double start = world.responder.time();
  for (int i = 0; i < 300 && found.vehicle.empty(); ++i) {
    const TurnedWorld::Step step = world.step(h);
    if (!step.events.empty()) found = step.events.front();
  }
  found.time -= start;
  world.responder.removeVehicle(car);
  return found;
}

ImpactEvent impactOn(const std::function<dGeomID(TurnedWorld&)>& build, double y) {
  TurnedWorld world({});
  world.responder.addBarrier(build(world));
  return firstImpact(world, y);
}

// When the front touches a circle head-on.
double timeTo(double centre, double radius) { return (10.0 - 2.1 + centre - radius) / 15.0; }

TEST(RoundGeoms, ASphereIsACircleWhereItIsWidestInTheBand) {
  constexpr double radius = 0.6;
  // Its middle within the band, above it, below it.
  for (const double height : {0.5, 1.0, 0.1}) {
    const auto ball = [&](TurnedWorld& w) { return w.addSphere({2.0, 0.0, height}, radius); };
    const double beyond = height - std::clamp(height, bandBottom, bandTop);
    const double wide = std::sqrt(radius * radius - beyond * beyond);
    const ImpactEvent front = impactOn(ball, 0.3);
    EXPECT_NEAR(front.time, timeTo(2.0, wide), 1e-9) << height;
    EXPECT_NEAR((front.normal - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
    // Beside the car's front corner by 0.2 m: the corner meets the circle.
    const ImpactEvent corner = impactOn(ball, 1.1);
    EXPECT_NEAR(corner.time, timeTo(2.0, std::sqrt(wide * wide - 0.04)), 1e-9) << height;
    EXPECT_TRUE(impactOn(ball, 0.9 + wide + 0.001).vehicle.empty()) << height;
  }
}

// What of a ball is flatter than 45° is no wall: a car drives under or over it, or ODE answers.
TEST(RoundGeoms, TheFlatPartsOfASphereAreNoWall) {
  constexpr double radius = 2.0;
  const double steep = radius * std::sqrt(0.5);
  for (const double side : {-1.0, 1.0}) {
    const double edge = side < 0.0 ? bandBottom : bandTop;
    const auto at = [&](double beyond) {
      return [=](TurnedWorld& w) { return w.addSphere({3.0, 0.0, edge + side * beyond}, radius); };
    };
    EXPECT_FALSE(impactOn(at(steep - 0.01), 0.0).vehicle.empty());
    EXPECT_TRUE(impactOn(at(steep + 0.01), 0.0).vehicle.empty());
  }
}

TEST(RoundGeoms, AnUprightCapsuleIsAPostWithRoundEnds) {
  constexpr double radius = 0.4;
  const auto capsule = [&](double middle) {
    return [=](TurnedWorld& w) {
      return w.addCapsule({2.0, 0.0, middle}, Eigen::Vector3d::UnitZ(), radius, 1.0);
    };
  };
  EXPECT_NEAR(impactOn(capsule(0.5), 0.0).time, timeTo(2.0, radius), 1e-9);
  // Its lower end is in the band, its axis is above.
  const double wide = std::sqrt(radius * radius - 0.04);
  EXPECT_NEAR(impactOn(capsule(bandTop + 0.2 + 0.5), 0.0).time, timeTo(2.0, wide), 1e-9);
  EXPECT_TRUE(impactOn(capsule(bandTop + 0.3 + 0.5), 0.0).vehicle.empty());
  // Leaning by 10°: a circle around its axis at the mass centre's height.
  const double lean = 10.0 * std::numbers::pi / 180.0;
  const ImpactEvent leaning = impactOn(
      [&](TurnedWorld& w) {
        return w.addCapsule({2.0, 0.0, 0.75}, {std::sin(lean), 0.0, std::cos(lean)}, radius, 1.0);
      },
      0.0);
  EXPECT_NEAR(leaning.time, timeTo(2.0 - 0.2 * std::tan(lean), radius), 1e-9);
}

// A rail of tube: 24 sides, whose corners lie on it.
TEST(RoundGeoms, ALyingCapsuleIsAWall) {
  constexpr double radius = 0.3;
  const auto tube = [&](TurnedWorld& w) {
    return w.addCapsule({2.0, 0.0, 0.5}, Eigen::Vector3d::UnitY(), radius, 6.0);
  };
  const ImpactEvent hit = impactOn(tube, 0.5);
  EXPECT_NEAR(hit.time, timeTo(2.0, radius), 1e-6);
  EXPECT_NEAR((hit.normal - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(hit.triangle, -1);
  EXPECT_TRUE(impactOn(tube, 3.0 + radius + 0.9 + 0.01).vehicle.empty());
  EXPECT_FALSE(impactOn(tube, 3.0 + radius + 0.9 - 0.05).vehicle.empty());
}

// Where Bumper owns the contact no joint is made: on the side, not on the top.
TEST(RoundGeoms, SidesAreClaimedTopsAreNot) {
  TurnedWorld world({});
  const dGeomID ball = world.addSphere({0.0, 0.0, 0.2}, 0.8);
  world.responder.addBarrier(ball);
  world.addCar({.place = {0.0, 0.0, 1.3}});
  const dGeomID car = dBodyGetFirstGeom(world.body(0));
  std::array<dContact, 8> contacts{};
  const auto kept = [&](const Eigen::Vector3d& place) {
    dBodySetPosition(world.body(0), place.x(), place.y(), place.z());
    EXPECT_FALSE(world.responder.claims(car, ball));
    const int count = dCollide(car, ball, 8, &contacts[0].geom, sizeof(dContact));
    EXPECT_GT(count, 0);
    return world.responder.keepUnclaimed(car, ball, contacts.data(), count);
  };
  EXPECT_GT(kept({0.0, 0.0, 1.3}), 0);
  EXPECT_EQ(kept({-0.8 - 2.1 + 0.1, 0.0, 0.55}), 0);
}

TEST(RoundGeoms, WhatOdeDoesNotTellIsAnErrorThatHelps) {
  OdeWorld ode;
  Responder responder(ode.world);
  const auto errorOf = [&](dGeomID geom) {
    std::string text;
    try {
      responder.addBarrier(geom);
    } catch (const Error& error) {
      text = error.what();
    }
    return text;
  };
  const std::array<double, 4> heights{};
  const dHeightfieldDataID data = dGeomHeightfieldDataCreate();
  dGeomHeightfieldDataBuildDouble(data, heights.data(), 0, 10.0, 10.0, 2, 2, 1.0, 0.0, 1.0, 0);
  const dGeomID field = dCreateHeightfield(ode.space, data, 1);
  EXPECT_NE(errorOf(field).find("a heightfield, whose shape ODE does not tell"), std::string::npos);
  EXPECT_NE(errorOf(field).find(".geom = geom"), std::string::npos);
  dGeomDestroy(field);
  dGeomHeightfieldDataDestroy(data);
  EXPECT_NE(errorOf(dCreateRay(ode.space, 1.0)).find("a ray"), std::string::npos);
  const dGeomID none = dCreateSphere(ode.space, 0.0);
  EXPECT_NE(errorOf(none).find("without a radius"), std::string::npos);
}

}  // namespace
}  // namespace bumper::tests
