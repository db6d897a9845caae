// The application destroys its world, spaces and geoms in whatever order it likes. What valgrind
// and the address sanitizer see is a part of these tests.

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

Scene wall() { return straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0, 5, 1); }

dGeomID asGeom(dSpaceID space) { return reinterpret_cast<dGeomID>(space); }

enum class Kind { simple, hash, sweep_and_prune, quadtree };

dSpaceID makeSpace(Kind kind, dSpaceID in = nullptr) {
  const dVector3 centre = {0.0, 0.0, 0.0};
  const dVector3 extents = {200.0, 200.0, 50.0};
  switch (kind) {
    case Kind::simple:
      return dSimpleSpaceCreate(in);
    case Kind::hash:
      return dHashSpaceCreate(in);
    case Kind::sweep_and_prune:
      return dSweepAndPruneSpaceCreate(in, dSAP_AXES_XYZ);
    case Kind::quadtree:
      return dQuadTreeSpaceCreate(in, centre, extents, 4);
  }
  return nullptr;
}

void placeAtWall(BoxCar& car) {
  car.place({0.0, 0.85, 0.55}, Eigen::Matrix3d::Identity());
  car.move({0.0, -3.0, 0.0}, Eigen::Vector3d::Zero());
}

// Every geom that near callbacks get.
void keepBoth(void* data, dGeomID a, dGeomID b) {
  auto& seen = *static_cast<std::vector<dGeomID>*>(data);
  seen.push_back(a);
  seen.push_back(b);
}

class InSpaces : public ::testing::TestWithParam<Kind> {};

std::string nameOf(const ::testing::TestParamInfo<Kind>& kind) {
  const char* const names[] = {"simple", "hash", "sweep_and_prune", "quadtree"};
  return names[static_cast<std::size_t>(kind.param)];
}

TEST_P(InSpaces, SpaceAndWorldGoFirst) {
  const dWorldID world = dWorldCreate();
  const dSpaceID space = makeSpace(GetParam());
  std::optional<Responder> responder(world);
  responder->addBarrier(wall(), {.space = space});
  responder->addBarrier(wall(), {.space = space});
  const dBodyID body = dBodyCreate(world);
  dGeomSetBody(dCreateBox(space, 4.0, 1.8, 0.6), body);
  responder->addVehicle(body, parametersFromGeoms(body, {}, 0.5));
  dSpaceDestroy(space);
  dWorldDestroy(world);
  responder.reset();
}

TEST_P(InSpaces, TheWorldGoesBeforeItsVehicles) {
  const dWorldID world = dWorldCreate();
  const dSpaceID space = makeSpace(GetParam());
  Responder responder(world);
  const BarrierId barrier = responder.addBarrier(wall(), {.space = space});
  const dBodyID body = dBodyCreate(world);
  const VehicleId vehicle =
      responder.addVehicle(body, parametersFromBodies(body, {}, 2.0, 2.0, 1.8, 0.5));
  dWorldDestroy(world);
  dSpaceDestroy(space);
  responder.removeVehicle(vehicle);
  responder.removeBarrier(barrier);
  EXPECT_TRUE(responder.step(h).empty());
}

TEST_P(InSpaces, WhatIsLeftGoesOn) {
  OdeWorld ode;
  const dSpaceID space = makeSpace(GetParam());
  Responder responder(ode.world);
  const BarrierId gone = responder.addBarrier(wall(), {.space = space, .name = "gate"});
  BoxCar car(ode.world, ode.space);
  responder.addVehicle(car.body, car.parameters);
  const dGeomID old = responder.geom(gone);
  ASSERT_NE(old, nullptr);
  dSpaceDestroy(space);

  EXPECT_EQ(responder.geom(gone), nullptr);
  placeAtWall(car);
  EXPECT_FALSE(responder.step(h).empty());  // its walls are there until they are removed
  EXPECT_THROW(responder.updateBarrier(gone, wall()), Error);
  responder.removeBarrier(gone);
  placeAtWall(car);
  dBodySetForce(car.body, 0.0, 0.0, 0.0);
  EXPECT_TRUE(responder.step(h).empty());

  const BarrierId next = responder.addBarrier(wall(), {.space = ode.space});
  EXPECT_TRUE(responder.claims(car.geom, responder.geom(next)));
}

TEST_P(InSpaces, RemovingABarrierLeavesNothingInItsSpace) {
  const OdeWorld ode;
  const dSpaceID space = makeSpace(GetParam());
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(wall(), {.space = space});
  EXPECT_EQ(dSpaceGetNumGeoms(space), 2);  // … and what watches
  responder.updateBarrier(barrier, wall());
  EXPECT_EQ(dSpaceGetNumGeoms(space), 2);
  responder.removeBarrier(barrier);
  EXPECT_EQ(dSpaceGetNumGeoms(space), 0);
  dSpaceDestroy(space);
}

TEST_P(InSpaces, ASpaceGoesWithTheOneThatHoldsIt) {
  const OdeWorld ode;
  const dSpaceID outer = dHashSpaceCreate(nullptr);
  const dSpaceID inner = makeSpace(GetParam(), outer);
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(wall(), {.space = inner});
  dSpaceDestroy(outer);
  EXPECT_EQ(responder.geom(barrier), nullptr);
}

TEST_P(InSpaces, ASpaceThatDoesNotCleanUpLeavesTheGeom) {
  const OdeWorld ode;
  const dSpaceID space = makeSpace(GetParam());
  dSpaceSetCleanup(space, 0);
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(wall(), {.space = space});
  dSpaceDestroy(space);
  ASSERT_NE(responder.geom(barrier), nullptr);
  EXPECT_EQ(dGeomGetSpace(responder.geom(barrier)), nullptr);
  // The new one has no space to go to.
  responder.updateBarrier(barrier, wall());
  EXPECT_EQ(dGeomGetSpace(responder.geom(barrier)), nullptr);
}

TEST_P(InSpaces, NoNearCallbackGetsWhatWatches) {
  OdeWorld ode;
  const dSpaceID outer = dHashSpaceCreate(nullptr);
  const dSpaceID space = makeSpace(GetParam(), outer);
  Responder responder(ode.world);
  const dGeomID mesh = responder.geom(
      responder.addBarrier(straightWall({70.0, 0.0}, {90.0, 10.0}, 1.0, 5, 1), {.space = space}));
  dReal ofMesh[6];
  dReal ofSpace[6];
  dGeomGetAABB(mesh, ofMesh);
  dGeomGetAABB(asGeom(space), ofSpace);
  // A quadtree is as large as it was made, sweep and prune has no end.
  const bool fits = GetParam() == Kind::simple || GetParam() == Kind::hash;
  for (int i = 0; i < 6 && fits; ++i) EXPECT_EQ(ofMesh[i], ofSpace[i]) << i;

  const dGeomID everywhere = dCreateBox(space, 400.0, 400.0, 40.0);
  std::vector<dGeomID> seen;
  dSpaceCollide(space, &seen, &keepBoth);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0] == mesh ? seen[1] : seen[0], everywhere);
  EXPECT_TRUE(seen[0] == mesh || seen[1] == mesh);
  seen.clear();
  const dGeomID probe = dCreateBox(nullptr, 400.0, 400.0, 40.0);
  dSpaceCollide2(asGeom(space), probe, &seen, &keepBoth);
  EXPECT_EQ(seen.size(), 4U);  // the mesh and the box
  dGeomDestroy(probe);
  dSpaceDestroy(outer);
}

INSTANTIATE_TEST_SUITE_P(Lifetime, InSpaces,
                         ::testing::Values(Kind::simple, Kind::hash, Kind::sweep_and_prune,
                                           Kind::quadtree),
                         nameOf);

TEST(Lifetime, AGeomIsDestroyedByItself) {
  for (const Kind kind : {Kind::simple, Kind::hash, Kind::sweep_and_prune}) {
    const OdeWorld ode;
    const dSpaceID space = makeSpace(kind, ode.space);
    Responder responder(ode.world);
    const BarrierId removed = responder.addBarrier(wall(), {.space = space, .name = "gate"});
    responder.addBarrier(wall(), {.space = space});
    const BarrierId kept = responder.addBarrier(wall(), {.space = space});
    dGeomDestroy(responder.geom(removed));
    EXPECT_THROW(responder.updateBarrier(removed, wall()), Error);
    responder.removeBarrier(removed);
    EXPECT_EQ(dSpaceGetNumGeoms(space), 4);
    dGeomDestroy(responder.geom(kept));
  }
}

// As a level is unloaded.
TEST(Lifetime, AllGeomsOfASpaceAreDestroyedOneByOne) {
  const OdeWorld ode;
  Responder responder(ode.world);
  const BarrierId first = responder.addBarrier(wall(), {.space = ode.space});
  responder.addBarrier(wall(), {.space = ode.space});
  while (dSpaceGetNumGeoms(ode.space) > 0) dGeomDestroy(dSpaceGetGeom(ode.space, 0));
  EXPECT_EQ(responder.geom(first), nullptr);
  responder.removeBarrier(first);
  responder.addBarrier(wall(), {.space = ode.space});
}

TEST(Lifetime, AGeomIsMovedToAnotherSpaceOfTheSameTree) {
  const OdeWorld ode;
  const dSpaceID one = dSimpleSpaceCreate(ode.space);
  const dSpaceID other = dSimpleSpaceCreate(dHashSpaceCreate(ode.space));
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(wall(), {.space = one});
  dSpaceRemove(one, responder.geom(barrier));
  dSpaceAdd(other, responder.geom(barrier));
  responder.updateBarrier(barrier, wall());
  EXPECT_EQ(dGeomGetSpace(responder.geom(barrier)), other);
  EXPECT_EQ(dSpaceGetNumGeoms(one), 0);
  responder.removeBarrier(barrier);
  EXPECT_EQ(dSpaceGetNumGeoms(other), 0);
}

TEST(Lifetime, AGeomInNoSpaceIsBumpers) {
  OdeWorld ode;
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(wall());
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  placeAtWall(car);
  EXPECT_TRUE(responder.claims(car.geom, responder.geom(barrier)));
  dSpaceAdd(ode.space, responder.geom(barrier));
  responder.removeBarrier(barrier);
  EXPECT_EQ(dSpaceGetNumGeoms(ode.space), 0);
}

// malloc hands the memory of a geom to the next one: that is no barrier.
TEST(Lifetime, AnotherGeomAtTheSameAddressIsNotTheBarrier) {
  OdeWorld ode;
  const dSpaceID space = dHashSpaceCreate(nullptr);
  Responder responder(ode.world);
  const BarrierId first = responder.addBarrier(wall(), {.space = space});
  const dGeomID old = responder.geom(first);
  BoxCar car(ode.world, ode.space);
  responder.addVehicle(car.body, car.parameters);
  placeAtWall(car);
  ASSERT_TRUE(responder.claims(car.geom, old));
  const OdeMesh mesh(nullptr, wall());
  const dTriMeshDataID data = dGeomTriMeshGetTriMeshDataID(mesh.geom);
  dSpaceDestroy(space);

  dGeomID fresh = nullptr;
  for (int i = 0; i < 50 && fresh != old; ++i) {
    fresh = dCreateTriMesh(ode.space, data, nullptr, nullptr, nullptr);
  }
  if (fresh != old) GTEST_SKIP() << "the memory was not used again";
  EXPECT_FALSE(responder.claims(car.geom, fresh));
  const auto left = [&] {
    dContact contact = {};
    contact.geom.g1 = car.geom;
    contact.geom.g2 = fresh;
    contact.geom.side1 = -1;
    contact.geom.pos[2] = 0.5;
    return responder.keepUnclaimed(car.geom, fresh, &contact, 1);
  };
  EXPECT_EQ(left(), 1);
  // It can become one by itself, and the old one does not take it along.
  responder.addBarrier(fresh);
  EXPECT_EQ(left(), 0);
  responder.removeBarrier(first);
  EXPECT_EQ(left(), 0);
}

TEST(Lifetime, GeomsOfTheApplicationsAreGoneBeforeTheyAreRemoved) {
  OdeWorld ode;
  Responder responder(ode.world);
  auto mesh = std::make_unique<OdeMesh>(ode.space, wall());
  const dGeomID box = dCreateBox(ode.space, 60.0, 0.2, 2.0);
  const dGeomID post = dCreateCylinder(ode.space, 0.2, 2.0);
  const BarrierId barriers[] = {responder.addBarrier(mesh->geom), responder.addBarrier(box),
                                responder.addBarrier(post)};
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  mesh.reset();
  dGeomDestroy(box);
  dGeomDestroy(post);
  placeAtWall(car);
  EXPECT_FALSE(responder.step(h).empty());
  for (const BarrierId barrier : barriers) responder.removeBarrier(barrier);
}

TEST(Lifetime, OdeIsClosedFirst) {
  dSpaceID spaceLeft = nullptr;
  {
    auto ode = std::make_unique<OdeWorld>();
    Responder responder(ode->world);
    responder.addBarrier(wall(), {.space = ode->space});
    Responder other(ode->world);
    const dSpaceID space = dHashSpaceCreate(nullptr);
    other.addBarrier(wall(), {.space = space});
    ode.reset();
    dCloseODE();
    spaceLeft = space;
  }
  dSpaceDestroy(spaceLeft);
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
}

}  // namespace
}  // namespace bumper::tests
