// What set-up calls notice, of whom, and for how long.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "hinge2_car.h"
#include "ode_world.h"
#include "roadside.h"

namespace bumper::tests {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double h = 0.005;

TEST(Warnings, DampingTakesItsShare) {
  OdeWorld ode;
  Responder responder(ode.world);
  BoxCar car(ode.world);
  dBodySetLinearDamping(car.body, 0.01);
  responder.addVehicle(car.body, car.parameters, {.name = "taxi"});
  EXPECT_THAT(responder.warnings(),
              ElementsAre(AllOf(HasSubstr("'taxi'"), HasSubstr("linear damping"))));
}

// Four wheels, one sentence; with all of them linked there is nothing to say.
TEST(Warnings, WheelsThatAreNotLinked) {
  OdeWorld ode;
  Responder responder(ode.world);
  Hinge2Car car(ode.world, ode.space, {0.0, 0.0}, 0.0, 0.0, 0.0);
  const VehicleParameters chassisOnly = parametersFromBodies(car.chassis, {}, 2.1, 2.1, 1.8, 0.6);
  const VehicleId alone = responder.addVehicle(car.chassis, chassisOnly);
  EXPECT_THAT(responder.warnings(), ElementsAre(HasSubstr("not among the linked bodies")));
  responder.removeVehicle(alone);
  EXPECT_THAT(responder.warnings(), IsEmpty());
  responder.addVehicle(car.chassis,
                       parametersFromGeoms(car.chassis, car.wheels, car.massCentre().z()),
                       {.linkedBodies = car.wheels});
  EXPECT_THAT(responder.warnings(), IsEmpty());
}

TEST(Warnings, TheyGoWithTheirVehicleAlone) {
  OdeWorld ode;
  Responder responder(ode.world);
  BoxCar one(ode.world);
  BoxCar other(ode.world);
  dBodySetLinearDamping(one.body, 0.01);
  dBodySetAngularDamping(other.body, 0.01);
  const VehicleId first = responder.addVehicle(one.body, one.parameters, {.name = "one"});
  responder.addVehicle(other.body, other.parameters, {.name = "other"});
  ASSERT_EQ(responder.warnings().size(), 2U);
  for (int i = 0; i < 3; ++i) {
    responder.step(h);
    dWorldQuickStep(ode.world, h);
  }
  EXPECT_EQ(responder.warnings().size(), 2U);
  responder.removeVehicle(first);
  EXPECT_THAT(responder.warnings(), ElementsAre(HasSubstr("'other'")));
}

// Spheres of radius 0.32 m, 0.75 m from the middle, under an outline that ends at 0.9 m.
TEST(Warnings, WheelsThatStandOutOfTheOutline) {
  OdeWorld ode;
  Responder responder(ode.world);
  Hinge2Car car(ode.world, ode.space, {3.0, -2.0}, 0.0, 0.7, 0.0);
  responder.addVehicle(car.chassis, car.parameters(), {.name = "taxi", .linkedBodies = car.wheels});
  EXPECT_THAT(responder.warnings(),
              ElementsAre(AllOf(HasSubstr("'taxi'"), HasSubstr("linked bodies stand out"),
                                HasSubstr("by 0.17 m at the sides"), Not(HasSubstr("front")))));
}

// The same wheels, and a band that begins above them.
TEST(Warnings, WhatStandsOutBelowTheBandHitsNoWall) {
  OdeWorld ode;
  Responder responder(ode.world);
  Hinge2Car car(ode.world, ode.space, {3.0, -2.0}, 0.0, 0.7, 0.0);
  responder.addVehicle(car.chassis, car.parameters(),
                       {.linkedBodies = car.wheels, .band = Band{.bottom = 0.65, .top = 0.8}});
  EXPECT_THAT(responder.warnings(), IsEmpty());
}

TEST(Warnings, AnOutlineSmallerThanTheChassis) {
  OdeWorld ode;
  BoxCar car(ode.world);
  const auto warned = [&](VehicleParameters parameters) {
    Responder responder(ode.world);
    responder.addVehicle(car.body, parameters);
    const auto all = responder.warnings();
    return all.empty() ? std::string() : all[0];
  };
  VehicleParameters changed = car.parameters;
  EXPECT_EQ(warned(changed), "");
  changed.massCentreToFront -= 0.009;
  EXPECT_EQ(warned(changed), "");
  changed.massCentreToFront = 2.0;
  changed.massCentreToRear = 2.25;
  EXPECT_THAT(warned(changed), AllOf(HasSubstr("smaller than the chassis"),
                                     HasSubstr("by 0.10 m at the front and 0.25 m at the rear:")));
  changed = car.parameters;
  changed.width = 0.9;  // half of it was given
  EXPECT_THAT(warned(changed), HasSubstr("by 0.45 m at the sides"));
  changed = car.parameters;
  // The box is 0.7 m high around a mass centre 0.05 m above the ground, as it were.
  changed.massCentreHeight = 0.05;
  EXPECT_THAT(warned(changed), HasSubstr("reach 0.35 m below the mass centre"));
}

TEST(Warnings, GravityThatSaysUpIsElsewhere) {
  OdeWorld ode;
  Responder responder(ode.world);
  BoxCar one(ode.world);
  BoxCar two(ode.world);
  const auto add = [&](const BoxCar& car) {
    return responder.addVehicle(car.body, car.parameters);
  };
  const auto onlyAboutGravity =
      ElementsAre(HasSubstr("gravity is (0, -9.81, 0), not along -up: up is (0, 0, 1)"));
  dWorldSetGravity(ode.world, 0.0, -9.81, 0.0);
  const VehicleId first = add(one);
  EXPECT_THAT(responder.warnings(), onlyAboutGravity);
  const VehicleId second = add(two);
  EXPECT_THAT(responder.warnings(), onlyAboutGravity);
  responder.removeVehicle(first);
  EXPECT_THAT(responder.warnings(), onlyAboutGravity);
  for (const Eigen::Vector3d& fine :
       {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(0.0, 0.0, -1.6),
        Eigen::Vector3d(0.5, 0.0, -9.8)}) {
    dWorldSetGravity(ode.world, fine.x(), fine.y(), fine.z());
    responder.removeVehicle(add(one));
    EXPECT_THAT(responder.warnings(), IsEmpty()) << fine.transpose();
  }
  dWorldSetGravity(ode.world, 0.0, 0.0, 9.81);
  add(one);
  EXPECT_EQ(responder.warnings().size(), 1U);
  responder.removeVehicle(second);
}

// A wall beside a hill that no vehicle climbs.
TEST(Warnings, ManySteepTrianglesThatAreNoWalls) {
  Roadside road;
  road.addRail(0.0, 0.0, -15.0, 15.0);
  for (int i = 0; i < 4; ++i) {
    const double x = 10.0 * i;
    road.addQuad(Roadside::ground, {x, 20, 0}, {x + 10, 20, 0}, {x + 10, 30, 17}, {x, 30, 17});
  }
  OdeWorld ode;
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(road.scene, {.space = ode.space, .name = "hill"});
  EXPECT_EQ(responder.report(barrier).droppedOnGuess, 8U);
  EXPECT_THAT(responder.warnings(),
              ElementsAre(AllOf(HasSubstr("'hill'"), HasSubstr("8 triangles steeper than 45°"))));
  Roadside flat;
  flat.addRail(0.0, 0.0, -15.0, 15.0);
  responder.updateBarrier(barrier, flat.scene);
  EXPECT_THAT(responder.warnings(), IsEmpty());
}

}  // namespace
}  // namespace bumper::tests
