// Set-up calls refuse what cannot work, name it, and leave nothing behind.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void expectError(const std::function<void()>& call, const std::string& named) {
  try {
    call();
    ADD_FAILURE() << "no Error about " << named;
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(named));
  }
}

TEST(BadInput, NullWorld) {
  expectError([] { const Responder responder(nullptr); }, "world is null");
}

TEST(BadInput, SettingsOutOfRange) {
  const OdeWorld ode;
  ResponderOptions options;
  options.response.restitution = AngleCurve::constant(1.5);
  expectError([&] { const Responder responder(ode.world, options); }, "restitution");
}

TEST(BadInput, VehicleParameters) {
  OdeWorld ode;
  Responder responder(ode.world);
  BoxCar car(ode.world);
  const auto withMass = [&](double mass) {
    VehicleParameters changed = car.parameters;
    changed.mass = mass;
    return changed;
  };
  const auto withInertia = [&](double inertia) {
    VehicleParameters changed = car.parameters;
    changed.yawInertia = inertia;
    return changed;
  };
  expectError([&] { responder.addVehicle(car.body, withMass(0.0)); }, "mass is 0 kg");
  expectError([&] { responder.addVehicle(car.body, withMass(nan)); }, "mass");
  expectError([&] { responder.addVehicle(car.body, withInertia(-2600.0)); }, "yawInertia is -2600");
  // Not what the body weighs: the impulse would be wrong by as much.
  expectError([&] { responder.addVehicle(car.body, withMass(1300.0)); }, "mass is 1500 kg");
  expectError([&] { responder.addVehicle(car.body, withInertia(1300.0)); }, "yaw inertia is 2600");
  expectError([&] { responder.addVehicle(nullptr, car.parameters); }, "chassis is null");
  expectError(
      [&] {
        responder.addVehicle(car.body, car.parameters, {.band = Band{.bottom = 0.8, .top = 0.3}});
      },
      "band");
  expectError([&] { responder.addVehicle(car.body, car.parameters, {.tiltLimit = 2.0}); }, "tilt");
  const dBodyID twice[] = {car.body};
  expectError([&] { responder.addVehicle(car.body, car.parameters, {.linkedBodies = twice}); },
              "linked body 0");
  // Nothing of all that is left: the car can still be added, once.
  responder.addVehicle(car.body, car.parameters);
  expectError([&] { responder.addVehicle(car.body, car.parameters); }, "already");
}

TEST(BadInput, BodyOfAnotherWorld) {
  const OdeWorld ode;
  const OdeWorld other;
  Responder responder(ode.world);
  BoxCar car(other.world);
  expectError([&] { responder.addVehicle(car.body, car.parameters); }, "another world");
}

TEST(BadInput, Barriers) {
  OdeWorld ode;
  Responder responder(ode.world);
  const int geomsBefore = dSpaceGetNumGeoms(ode.space);

  Scene flat = straightWall({0.0, 0.0}, {10.0, 0.0}, 1.0);
  for (Eigen::Vector3d& v : flat.vertices) v = Eigen::Vector3d(v.x(), v.z(), 0.0);
  expectError([&] { responder.addBarrier(flat, {.space = ode.space, .name = "field"}); },
              "'field' has no wall");
  expectError([&] { responder.addBarrier(Scene{}, {.space = ode.space}); }, "triangle");
  Scene broken = straightWall({0.0, 0.0}, {10.0, 0.0}, 1.0);
  broken.vertices[1].x() = nan;
  expectError([&] { responder.addBarrier(broken, {.space = ode.space}); }, "finite");

  expectError([&] { responder.addBarrier(dGeomID{nullptr}); }, "null");
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters, {.name = "truck"});
  expectError([&] { responder.addBarrier(car.geom); }, "has a body of vehicle 'truck'");
  const dGeomID ray = dCreateRay(nullptr, 1.0);
  expectError([&] { responder.addBarrier(ray); }, "is a ray");
  dGeomDestroy(ray);
  const dGeomID point = dCreateSphere(nullptr, 0.0);
  expectError([&] { responder.addBarrier(point); }, "is a sphere without a radius");
  dGeomDestroy(point);
  const dGeomID field = dCreateHeightfield(nullptr, dGeomHeightfieldDataCreate(), 0);
  expectError([&] { responder.addBarrier(field); }, "is a heightfield");
  expectError([&] { responder.addBarrier(field); }, "give its faces as a scene");
  dGeomHeightfieldDataDestroy(dGeomHeightfieldGetHeightfieldData(field));
  dGeomDestroy(field);
  const dGeomID ground = dCreatePlane(nullptr, 0.0, 0.0, 1.0, 0.0);
  expectError([&] { responder.addBarrier(ground); }, "plane is flatter");
  dGeomDestroy(ground);
  expectError(
      [&] {
        responder.addBarrier(straightWall({0.0, 0.0}, {10.0, 0.0}, 1.0),
                             {.materials = {{"glass", ResponseSettings{}}}});
      },
      "no material 'glass'");
  EXPECT_EQ(dSpaceGetNumGeoms(ode.space), geomsBefore);

  const OdeMesh mesh(ode.space, straightWall({0.0, 0.0}, {10.0, 0.0}, 1.0));
  const BarrierId barrier = responder.addBarrier(mesh.geom);
  expectError([&] { responder.addBarrier(mesh.geom); }, "already");
  responder.removeBarrier(barrier);
  expectError([&] { responder.removeBarrier(barrier); }, "no barrier with id 0");
  expectError([&] { responder.removeVehicle({.value = 3}); }, "no vehicle with id 3");
  responder.addBarrier(mesh.geom);
}

TEST(BadInput, GeomsThatAreNotFinite) {
  OdeWorld ode;
  Responder responder(ode.world);
  const dGeomID plane = dCreatePlane(nullptr, 1.0, 0.0, 0.0, nan);
  expectError([&] { responder.addBarrier(plane); }, "plane has a number that is not finite");
  const dGeomID cylinder = dCreateCylinder(nullptr, 0.5, 2.0);
  dGeomSetPosition(cylinder, 0.0, nan, 0.0);
  expectError([&] { responder.addBarrier(cylinder); }, "cylinder has a number that is not finite");
  const dGeomID box = dCreateBox(nullptr, 1.0, 1.0, 1.0);
  dGeomSetPosition(box, 0.0, 0.0, std::numeric_limits<double>::infinity());
  expectError([&] { responder.addBarrier(box); }, "finite");
  for (const dGeomID geom : {plane, cylinder, box}) dGeomDestroy(geom);
}

TEST(BadInput, SavedStatesThatFitNothing) {
  OdeWorld ode;
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(straightWall({0.0, 0.0}, {10.0, 0.0}, 1.0));
  BoxCar one(ode.world);
  BoxCar other(ode.world);
  responder.addVehicle(one.body, one.parameters, {.name = "one"});
  responder.addVehicle(other.body, other.parameters);
  const SavedState fine = responder.save();
  SavedState twice = fine;
  twice.vehicles[1] = twice.vehicles[0];
  twice.time = 7.0;
  expectError([&] { responder.restore(twice); }, "'one' more than once");
  SavedState pressed = fine;
  pressed.vehicles[0].guards.push_back({.with = {.barrier = barrier}, .wall = 1000});
  expectError([&] { responder.restore(pressed); }, "no wall number 1000");
  pressed.vehicles[0].guards[0].with.barrier.value = 5;
  expectError([&] { responder.restore(pressed); }, "no barrier with id 5");
  EXPECT_EQ(responder.time(), 0.0);
  responder.restore(fine);
}

TEST(BadInput, WhatNoForceMoves) {
  OdeWorld ode;
  Responder responder(ode.world);
  BoxCar car(ode.world);
  dBodySetKinematic(car.body);
  expectError([&] { responder.addVehicle(car.body, car.parameters); }, "kinematic");
  const dGeomID empty = dCreateTriMesh(ode.space, nullptr, nullptr, nullptr, nullptr);
  expectError([&] { responder.addBarrier(empty); }, "no data");
  dGeomDestroy(empty);
}

TEST(BadInput, BarriersOfTwoMethods) {
  OdeWorld ode;
  Responder responder(ode.world);
  ResponseSettings paper;
  paper.method = Method::paper;
  expectError(
      [&] {
        responder.addBarrier(straightWall({0, 0}, {10, 0}, 1.0), {.response = paper});
      },
      "same method");
}

TEST(BadInput, AStateThatIsNotFiniteIsLeftAlone) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0));
  BoxCar lost(ode.world);
  BoxCar sound(ode.world);
  const VehicleId lostId = responder.addVehicle(lost.body, lost.parameters);
  const VehicleId soundId = responder.addVehicle(sound.body, sound.parameters);
  lost.place({0.0, 0.85, 0.55}, Eigen::Matrix3d::Identity());
  lost.move({nan, -3.0, 0.0}, Eigen::Vector3d::Zero());
  sound.place({10.0, 0.85, 0.55}, Eigen::Matrix3d::Identity());
  sound.move({0.0, -3.0, 0.0}, Eigen::Vector3d::Zero());

  const auto events = responder.step(0.005);
  ASSERT_FALSE(events.empty());
  for (const ImpactEvent& event : events) EXPECT_EQ(event.vehicle, "vehicle 1");
  EXPECT_EQ(responder.issues(lostId), step_issue::not_finite);
  EXPECT_EQ(responder.issues(soundId), step_issue::none);
  EXPECT_EQ(responder.issues(), step_issue::not_finite);
  EXPECT_EQ(dBodyGetForce(lost.body)[1], 0.0);
}

TEST(BadInput, StepsThatAreNoTime) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0));
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  car.place({0.0, 0.85, 0.55}, Eigen::Matrix3d::Identity());
  car.move({0.0, -3.0, 0.0}, Eigen::Vector3d::Zero());
  for (const double h : {-0.01, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(responder.step(h).empty());
    EXPECT_EQ(responder.issues(), step_issue::invalid_step);
  }
  EXPECT_TRUE(responder.step(0.0).empty());
  EXPECT_EQ(responder.issues(), step_issue::none);
  EXPECT_EQ(responder.time(), 0.0);
  EXPECT_EQ(dBodyGetForce(car.body)[1], 0.0);
}

}  // namespace
}  // namespace bumper::tests
