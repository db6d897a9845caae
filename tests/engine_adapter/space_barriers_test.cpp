// A space whose geoms are barriers, each of its own.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <vector>

#include "../response/random_impacts.h"
#include "bumper/response/error.h"
#include "free_drive.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

dGeomID addBox(dSpaceID space, double x, double y, double yaw = 0.0) {
  const dGeomID box = dCreateBox(space, 1.0, 0.8, 1.2);
  dGeomSetPosition(box, x, y, 0.6);
  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, yaw);
  dGeomSetRotation(box, rotation);
  return box;
}

// 500 boxes in rows of 25, with lanes between them, some of them in a space within the space.
std::vector<dGeomID> addBoxes(dSpaceID space, dSpaceID within) {
  Random random(3);
  std::vector<dGeomID> boxes;
  for (int i = 0; i < 500; ++i) {
    boxes.push_back(addBox(i % 3 == 0 ? within : space, 6.0 * (i % 25) - 72.0,
                           6.0 * static_cast<double>(i / 25) - 57.0,
                           random.uniform(-std::numbers::pi, std::numbers::pi)));
  }
  return boxes;
}

/// The motion of five cars among the boxes, all of its bits; how many impacts there were.
std::vector<double> driveAmong(OdeWorld& ode, Responder& responder, int& impacts) {
  std::vector<std::unique_ptr<BoxCar>> cars;
  Random random(5);
  for (int i = 0; i < 5; ++i) {
    cars.push_back(std::make_unique<BoxCar>(ode.world));
    const double yaw = random.uniform(-std::numbers::pi, std::numbers::pi);
    cars.back()->place({24.0 * i - 45.0, 24.0 * i - 54.0 + 3.0, 0.55},
                       Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix());
    cars.back()->move({20.0 * std::cos(yaw), 20.0 * std::sin(yaw), 0.0}, {0.0, 0.0, 0.5});
    responder.addVehicle(cars.back()->body, cars.back()->parameters);
  }
  std::vector<double> numbers;
  for (int i = 0; i < 300; ++i) {
    for (const ImpactEvent& event : responder.step(h)) {
      ++impacts;
      numbers.push_back(event.time);
      numbers.push_back(event.impulseNormal);
    }
    dWorldQuickStep(ode.world, h);
    for (const auto& car : cars) {
      for (int k = 0; k < 3; ++k) {
        numbers.push_back(dBodyGetPosition(car->body)[k]);
        numbers.push_back(dBodyGetLinearVel(car->body)[k]);
        numbers.push_back(dBodyGetAngularVel(car->body)[k]);
      }
    }
  }
  return numbers;
}

TEST(SpaceBarriers, AsIfEachHadBeenAddedByItself) {
  int impacts = 0;
  std::vector<double> together;
  {
    OdeWorld ode;
    const dSpaceID within = dSimpleSpaceCreate(ode.space);
    const std::vector<dGeomID> boxes = addBoxes(ode.space, within);
    Responder responder(ode.world);
    const SpaceBarriers& found = responder.addBarriers(ode.space);
    EXPECT_EQ(found.barriers.size(), 500U);
    EXPECT_TRUE(found.left.empty());
    std::set<dGeomID> geoms;
    for (const BarrierId barrier : found.barriers) geoms.insert(responder.geom(barrier));
    EXPECT_EQ(geoms, std::set<dGeomID>(boxes.begin(), boxes.end()));
    together = driveAmong(ode, responder, impacts);
  }
  EXPECT_GT(impacts, 20);
  OdeWorld ode;
  const dSpaceID within = dSimpleSpaceCreate(ode.space);
  Responder responder(ode.world);
  for (const dGeomID box : addBoxes(ode.space, within)) responder.addBarrier(box);
  EXPECT_EQ(driveAmong(ode, responder, impacts), together);
}

TEST(SpaceBarriers, WhatMovesIsPassedOverAndWhatIsNoWallIsNamed) {
  OdeWorld ode;
  Responder responder(ode.world);
  const dGeomID box = addBox(ode.space, 0.0, 0.0);
  const dGeomID ground = dCreatePlane(ode.space, 0.0, 0.0, 1.0, 0.0);
  const dGeomID ray = dCreateRay(ode.space, 1.0);
  BoxCar car(ode.world, ode.space);
  const dGeomID off = addBox(ode.space, 9.0, 0.0);
  dGeomDisable(off);
  const dGeomID known = addBox(ode.space, 18.0, 0.0);
  responder.addBarrier(known);
  // A scene's own geom is a barrier already, and its watcher has a body.
  responder.addBarrier(sheets({{30.0, 0.0}, {30.0, 5.0}}), {.space = ode.space});
  const SpaceBarriers& found = responder.addBarriers(ode.space, {.name = "block"});
  ASSERT_EQ(found.barriers.size(), 1U);
  EXPECT_EQ(responder.geom(found.barriers.front()), box);
  ASSERT_EQ(found.left.size(), 2U);
  for (const SpaceBarriers::Left& each : found.left) {
    EXPECT_TRUE(each.geom == ground || each.geom == ray);
    EXPECT_NE(each.reason.find(each.geom == ground ? "flatter" : "a ray"), std::string::npos);
  }
  car.place({-4.0, 0.0, 0.55}, Eigen::Matrix3d::Identity());
  car.move({20.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
  responder.addVehicle(car.body, car.parameters);
  std::string hit;
  for (int i = 0; i < 40; ++i) {
    for (const ImpactEvent& event : responder.step(h)) hit = event.barrier;
    dWorldQuickStep(ode.world, h);
  }
  EXPECT_EQ(hit, "block");
}

TEST(SpaceBarriers, ComeAndGo) {
  OdeWorld ode;
  Responder responder(ode.world);
  std::vector<dGeomID> boxes;
  for (int i = 0; i < 6; ++i) boxes.push_back(addBox(ode.space, 10.0 * i, 0.0));
  const auto added = [&] {
    std::map<dGeomID, BarrierId> result;
    for (const BarrierId each : responder.updateBarriers(ode.space).barriers) {
      result[responder.geom(each)] = each;
    }
    return result;
  };
  responder.addBarriers(ode.space);
  const auto before = added();
  EXPECT_EQ(before.size(), 6U);
  // The x at which a car at 20 m/s along a line of the plane stops, or is past everything.
  const auto reached = [&](double y) {
    BoxCar car(ode.world);
    car.place({-20.0, y, 0.55}, Eigen::Matrix3d::Identity());
    car.move({30.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
    const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
    double most = -20.0;
    for (int i = 0; i < 600; ++i) {
      responder.step(h);
      dWorldQuickStep(ode.world, h);
      most = std::max(most, dBodyGetPosition(car.body)[0]);
    }
    responder.removeVehicle(vehicle);
    return most + 2.1;
  };
  EXPECT_NEAR(reached(0.0), -0.5, 0.1);

  // One is destroyed: its walls stay until the update.
  dGeomDestroy(boxes[0]);
  EXPECT_NEAR(reached(0.0), -0.5, 0.1);
  auto now = added();
  EXPECT_EQ(now.size(), 5U);
  EXPECT_NEAR(reached(0.0), 9.5, 0.1);
  EXPECT_THROW((void)responder.geom(before.at(boxes[0])), Error);

  // One moves, one is resized, one comes; ids of those that stay are kept.
  dGeomSetPosition(boxes[1], 10.0, 50.0, 0.6);
  dGeomBoxSetLengths(boxes[2], 5.0, 0.8, 1.2);
  boxes[0] = addBox(ode.space, 0.0, 30.0);
  now = added();
  EXPECT_EQ(now.size(), 6U);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_EQ(now.at(boxes[i]), before.at(boxes[i])) << i;
  EXPECT_NEAR(reached(0.0), 17.5, 0.1);
  EXPECT_NEAR(reached(50.0), 9.5, 0.1);
  EXPECT_NEAR(reached(30.0), -0.5, 0.1);

  // One gets a body, one is destroyed and another made, perhaps at its address.
  dBodyID body = dBodyCreate(ode.world);
  dGeomSetBody(boxes[2], body);
  dGeomDestroy(boxes[3]);
  boxes[3] = dCreateSphere(ode.space, 0.7);
  dGeomSetPosition(boxes[3], 30.0, 0.0, 0.6);
  now = added();
  EXPECT_EQ(now.size(), 5U);
  EXPECT_FALSE(now.contains(boxes[2]));
  EXPECT_NEAR(reached(0.0), 29.3, 0.1);

  responder.removeBarriers(ode.space);
  EXPECT_GT(reached(0.0), 60.0);
  EXPECT_THROW((void)added(), Error);
  responder.addBarriers(ode.space);
  EXPECT_EQ(added().size(), 5U);
  dGeomSetBody(boxes[2], nullptr);
  dBodyDestroy(body);
}

TEST(SpaceBarriers, ASpaceMayBeGoneBeforeItsBarriers) {
  OdeWorld ode;
  Responder responder(ode.world);
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  addBox(space, 0.0, 0.0);
  const BarrierId barrier = responder.addBarriers(space).barriers.front();
  dSpaceDestroy(space);
  responder.step(h);
  responder.removeBarriers(space);
  EXPECT_THROW((void)responder.geom(barrier), Error);
}

TEST(SpaceBarriers, WrongCallsAreErrorsThatChangeNothing) {
  OdeWorld ode;
  Responder responder(ode.world);
  addBox(ode.space, 0.0, 0.0);
  EXPECT_THROW(responder.addBarriers(nullptr), Error);
  EXPECT_THROW(responder.updateBarriers(ode.space), Error);
  EXPECT_THROW(responder.removeBarriers(ode.space), Error);
  ResponseSettings wrong;
  wrong.restSpeed = -1.0;
  EXPECT_THROW(responder.addBarriers(ode.space, {.response = wrong}), Error);
  EXPECT_THROW(responder.addBarriers(ode.space, {.materials = {{"rubber", {}}}}), Error);
  const dVector3 centre = {0.0, 0.0, 0.0};
  const dVector3 extents = {10.0, 10.0, 10.0};
  const dSpaceID tree = dQuadTreeSpaceCreate(ode.space, centre, extents, 3);
  EXPECT_THROW(responder.addBarriers(tree), Error);
  EXPECT_THROW(responder.addBarriers(ode.space), Error);
  dSpaceDestroy(tree);
  EXPECT_EQ(responder.addBarriers(ode.space).barriers.size(), 1U);
  EXPECT_THROW(responder.addBarriers(ode.space), Error);
}

}  // namespace
}  // namespace bumper::tests
