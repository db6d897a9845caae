// Barriers and vehicles come and go, in several worlds.

#include <gtest/gtest.h>

#include <string>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

void placeAtWall(BoxCar& car, double x, double wallAt = 0.0) {
  car.place({x, wallAt + 0.85, 0.55}, Eigen::Matrix3d::Identity());
  car.move({0.0, -3.0, 0.0}, Eigen::Vector3d::Zero());
  dBodySetForce(car.body, 0.0, 0.0, 0.0);
}

Scene wall() { return straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0, 5, 1); }

TEST(Lifecycle, ARemovedBarrierIsNoLongerThere) {
  OdeWorld ode;
  Responder responder(ode.world);
  const int geoms = dSpaceGetNumGeoms(ode.space);
  const BarrierId first = responder.addBarrier(wall(), {.space = ode.space, .name = "first"});
  EXPECT_EQ(dSpaceGetNumGeoms(ode.space), geoms + 2);  // … and the one that watches it
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  placeAtWall(car, 0.0);
  ASSERT_FALSE(responder.step(h).empty());

  responder.removeBarrier(first);
  EXPECT_EQ(dSpaceGetNumGeoms(ode.space), geoms);
  placeAtWall(car, 0.0);
  EXPECT_TRUE(responder.step(h).empty());

  responder.addBarrier(wall(), {.space = ode.space, .name = "second"});
  placeAtWall(car, 0.0);
  const auto events = responder.step(h);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].barrier, "second");
}

// Moved by 3 m it is hit there and no longer where it was, by its old id and name.
TEST(Lifecycle, AMovedGeomIsReadAnew) {
  OdeWorld ode;
  Responder responder(ode.world);
  dGeomID box = dCreateBox(ode.space, 60.0, 0.2, 2.0);
  dGeomSetPosition(box, 0.0, -0.1, 1.0);
  const BarrierId gate = responder.addBarrier(box, {.name = "gate"});
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  placeAtWall(car, 0.0);
  ASSERT_FALSE(responder.step(h).empty());

  dGeomSetPosition(box, 0.0, -3.1, 1.0);
  responder.updateBarrier(gate);
  EXPECT_EQ(responder.geom(gate), box);
  placeAtWall(car, 0.0);
  EXPECT_TRUE(responder.step(h).empty());
  placeAtWall(car, 0.0, -3.0);
  const auto events = responder.step(h);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].barrier, "gate");
  EXPECT_NEAR(events[0].contact.y(), -3.0, 1e-9);
  EXPECT_THROW(responder.updateBarrier(gate, wall()), Error);
}

TEST(Lifecycle, AMovedSceneTakesTheOldOnesPlace) {
  OdeWorld ode;
  Responder responder(ode.world);
  const int geoms = dSpaceGetNumGeoms(ode.space);
  const BarrierId gate = responder.addBarrier(wall(), {.space = ode.space, .name = "gate"});
  BoxCar car(ode.world, ode.space);
  responder.addVehicle(car.body, car.parameters);
  placeAtWall(car, 0.0);
  ASSERT_FALSE(responder.step(h).empty());

  Scene moved = wall();
  for (Eigen::Vector3d& vertex : moved.vertices) vertex.y() -= 3.0;
  responder.updateBarrier(gate, moved);
  EXPECT_EQ(dSpaceGetNumGeoms(ode.space), geoms + 3);  // the car's, the new one, its watcher
  EXPECT_TRUE(responder.claims(car.geom, responder.geom(gate)));
  placeAtWall(car, 0.0);
  EXPECT_TRUE(responder.step(h).empty());
  placeAtWall(car, 0.0, -3.0);
  EXPECT_FALSE(responder.step(h).empty());

  // Without walls, or without a scene, nothing changes.
  Scene flat = wall();
  for (Eigen::Vector3d& vertex : flat.vertices) vertex.z() = 0.0;
  EXPECT_THROW(responder.updateBarrier(gate, flat), Error);
  EXPECT_THROW(responder.updateBarrier(gate), Error);
  placeAtWall(car, 0.0, -3.0);
  EXPECT_FALSE(responder.step(h).empty());
  responder.removeBarrier(gate);
  EXPECT_THROW(responder.updateBarrier(gate, moved), Error);
}

// Long enough to be on the heap, and gone when the barrier is read anew.
TEST(Lifecycle, ABarrierKeepsThePatternThatItWasGiven) {
  OdeWorld ode;
  Responder responder(ode.world);
  Scene scene = wall();
  scene.meshes.push_back({.name = "a picture of a tree that nobody hits", .material = ""});
  scene.triangles.front().mesh = 1;
  BarrierId barrier;
  {
    const std::string pattern = "a picture of a tree that .*";
    BarrierOptions options;
    options.walls.scenery = pattern;
    barrier = responder.addBarrier(scene, options);
  }
  responder.updateBarrier(barrier, scene);
  EXPECT_EQ(responder.report(barrier).droppedScenery, 1U);
}

TEST(Lifecycle, ARemovedVehicleIsOdesAgain) {
  OdeWorld ode;
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(wall(), {.space = ode.space});
  auto car = std::make_unique<BoxCar>(ode.world, ode.space);
  const VehicleId vehicle = responder.addVehicle(car->body, car->parameters);
  placeAtWall(*car, 0.0);
  EXPECT_TRUE(responder.claims(car->geom, responder.geom(barrier)));
  EXPECT_TRUE(responder.claims(responder.geom(barrier), car->geom));  // either order
  responder.removeVehicle(vehicle);
  EXPECT_FALSE(responder.claims(car->geom, responder.geom(barrier)));
  car.reset();
  EXPECT_TRUE(responder.step(h).empty());
}

TEST(Lifecycle, EventsNameTheirParts) {
  OdeWorld ode;
  Responder responder(ode.world);
  Scene left = wall();
  left.meshes[0].material = "concrete";
  responder.addBarrier(left, {.name = "left"});
  Scene far = straightWall({100.0, 0.0}, {160.0, 0.0}, 1.0, 3, 1);
  far.meshes[0].material = "steel";
  responder.addBarrier(far, {.name = "far"});
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters, {.name = "van"});
  placeAtWall(car, 111.0);
  const auto events = responder.step(h);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].vehicle, "van");
  EXPECT_EQ(events[0].barrier, "far");
  EXPECT_EQ(events[0].material, "steel");
  EXPECT_EQ(events[0].time, 0.0);
  // The middle of the flush side is at x = 110.8, in the first 20 m panel: triangle 0 or 1.
  EXPECT_NEAR(events[0].contact.x(), 110.8, 1e-9);
  EXPECT_GE(events[0].triangle, 0);
  EXPECT_LE(events[0].triangle, 1);
}

TEST(Lifecycle, TwoWorldsDoNotMeet) {
  OdeWorld one;
  OdeWorld two;
  Responder inOne(one.world);
  Responder inTwo(two.world);
  inOne.addBarrier(wall());
  BoxCar first(one.world);
  BoxCar second(two.world);
  inOne.addVehicle(first.body, first.parameters);
  inTwo.addVehicle(second.body, second.parameters);
  placeAtWall(first, 0.0);
  placeAtWall(second, 0.0);
  EXPECT_FALSE(inOne.step(h).empty());
  EXPECT_TRUE(inTwo.step(h).empty());
}

// Far from the origin ODE's single precision is off by millimetres, the cut is not.
TEST(Lifecycle, AHundredKilometresFromTheOrigin) {
  OdeWorld ode;
  Responder responder(ode.world);
  constexpr double away = 1e5;
  responder.addBarrier(straightWall({away - 30.0, away}, {away + 30.0, away}, 1.0, 153, 4));
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  car.place({away, away + 0.899, 0.55}, Eigen::Matrix3d::Identity());  // 1 mm in
  car.move({0.0, -3.0, 0.0}, Eigen::Vector3d::Zero());
  const auto events = responder.step(h);
  ASSERT_FALSE(events.empty());
  EXPECT_NEAR(events[0].contact.x(), away - 0.2, 1e-9);
  EXPECT_NEAR(events[0].contact.y(), away, 1e-9);
}

}  // namespace
}  // namespace bumper::tests
