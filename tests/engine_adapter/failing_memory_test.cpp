// What set-up calls leave behind: nothing if memory runs out in one of them, wherever that is, and
// nothing once all is removed.

#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "failing_new.h"
#include "ode_world.h"
#include "roadside.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

// A wall along x at a y, and triangles that a warning is about.
Scene wallAt(double y) {
  Roadside road;
  road.addRail(y, y, -15.0, 15.0);
  for (int i = 0; i < 4; ++i) {
    const double x = 10.0 * i;
    road.addQuad(Roadside::ground, {x, y - 40, 0}, {x + 10, y - 40, 0}, {x + 10, y - 50, 17},
                 {x, y - 50, 17});
  }
  return road.scene;
}

// Of the application's, in the way of the second car.
class Box {
 public:
  explicit Box(dSpaceID space) : geom(dCreateBox(space, 60.0, 0.2, 2.0)) {
    dGeomSetPosition(geom, 100.0, -0.1, 1.0);
  }
  ~Box() { dGeomDestroy(geom); }
  Box(const Box&) = delete;
  Box& operator=(const Box&) = delete;
  Box(Box&&) = delete;
  Box& operator=(Box&&) = delete;
  dGeomID geom;
};

// A car that hits the rail, one that is a vehicle only later, and one linked with it.
struct Situation {
  Situation() : responder(ode.world) {
    rail = responder.addBarrier(wallAt(0.0), {.space = ode.space, .name = "rail"});
    post = responder.addBarrier(postGeom.geom, {.name = "post"});
    car = responder.addVehicle(first.body, first.parameters, {.name = "car"});
    reset(first, 0.0);
    reset(second, 100.0);
    dBodySetLinearDamping(second.body, 0.01);
    dGeomSetPosition(postGeom.geom, -100.0, -0.1, 1.0);
    // Contacts and a pulse to remember.
    for (int i = 0; i < 3; ++i) step();
    saved = responder.save();
    dWorldSetGravity(ode.world, 0.0, -1e-3, 0.0);
  }

  static void reset(BoxCar& some, double x) {
    some.place({x, 1.3, 0.55}, Eigen::Matrix3d::Identity());
    some.move({3.0, -5.0, 0.0}, {0.0, 0.0, 0.1});
  }

  std::size_t step() {
    const std::size_t events = responder.step(h).size();
    dWorldQuickStep(ode.world, h);
    return events;
  }

  // All that is to be seen of it, in the next half second.
  std::vector<double> seen() {
    std::vector<double> result;
    reset(first, 0.0);
    reset(second, 100.0);
    result.push_back(static_cast<double>(responder.warnings().size()));
    for (const std::string& each : responder.warnings()) {
      result.push_back(static_cast<double>(std::hash<std::string>{}(each) % 1000));
    }
    result.push_back(static_cast<double>(responder.save().vehicles.size()));
    result.push_back(dSpaceGetNumGeoms(ode.space));
    result.push_back(responder.claims(first.geom, box.geom) ? 1.0 : 0.0);
    result.push_back(responder.claims(second.geom, box.geom) ? 1.0 : 0.0);
    for (int i = 0; i < 100; ++i) {
      result.push_back(static_cast<double>(step()));
      for (const BoxCar* each : {&first, &second}) {
        const Eigen::Vector3d velocity = each->velocity();
        result.insert(result.end(), {velocity.x(), velocity.y(), each->angularVelocity().z()});
      }
    }
    return result;
  }

  OdeWorld ode;
  BoxCar first{ode.world, ode.space};
  BoxCar second{ode.world, ode.space};
  BoxCar linked{ode.world, ode.space};
  Box box{ode.space};
  Box postGeom{ode.space};
  Responder responder;
  BarrierId rail;
  BarrierId post;
  VehicleId car;
  SavedState saved;
};

using Call = std::function<void(Situation&)>;

std::vector<double> seenAfter(const Call& call) {
  Situation situation;
  call(situation);
  return situation.seen();
}

// Whether the call came to its end. If not: what is to be seen then is what would be without it,
// and it can be made again.
bool succeedsUntil(long allocations, bool once, const Call& call,
                   const std::vector<double>& without, const std::vector<double>& with) {
  Situation situation;
  untilFailure = allocations;
  failsOnce = once;
  bool succeeds = true;
  try {
    call(situation);
  } catch (const std::bad_alloc&) {
    succeeds = false;
  }
  untilFailure = -1;
  SCOPED_TRACE("after " + std::to_string(allocations) + " allocations");
  if (succeeds) {
    EXPECT_EQ(situation.seen(), with);
    return true;
  }
  EXPECT_EQ(situation.seen(), without);
  Situation again;
  untilFailure = allocations;
  EXPECT_THROW(call(again), std::bad_alloc);
  untilFailure = -1;
  call(again);
  EXPECT_EQ(again.seen(), with);
  return false;
}

void expectAllOrNothing(const Call& call) {
  const std::vector<double> without = seenAfter([](Situation&) {});
  const std::vector<double> with = seenAfter(call);
  // GoogleTest keeps some memory from its first use on.
  succeedsUntil(0, true, call, without, with);
  for (const bool once : {true, false}) {
    long allocations = 0;
    for (bool succeeds = false; !succeeds && !::testing::Test::HasFailure(); ++allocations) {
      const long before = live;
      succeeds = succeedsUntil(allocations, once, call, without, with);
      EXPECT_EQ(live, before) << "lost after " << allocations << " allocations";
    }
    EXPECT_GT(allocations, 1) << "nothing was tested";
  }
}

TEST(FailingMemory, AddingASceneIsAllOrNothing) {
  const Scene scene = wallAt(0.0);
  BarrierOptions options{.name = "a name that is long enough to be on the heap"};
  options.materials["steel"] = {};
  options.walls.scenery = "a pattern that is long enough to be on the heap .*";
  Scene moved = scene;
  for (Eigen::Vector3d& vertex : moved.vertices) vertex.x() += 100.0;
  for (SceneMesh& mesh : moved.meshes) mesh.material = "steel";
  expectAllOrNothing([&](Situation& situation) {
    BarrierOptions own = options;
    own.space = situation.ode.space;
    situation.responder.addBarrier(moved, own);
  });
}

TEST(FailingMemory, AddingAGeomIsAllOrNothing) {
  expectAllOrNothing(
      [](Situation& situation) { situation.responder.addBarrier(situation.box.geom); });
}

TEST(FailingMemory, AddingASpaceIsAllOrNothing) {
  BarrierOptions options{.name = "a name that is long enough to be on the heap"};
  options.walls.scenery = "a pattern that is long enough to be on the heap .*";
  expectAllOrNothing(
      [&](Situation& situation) { situation.responder.addBarriers(situation.ode.space, options); });
}

TEST(FailingMemory, AddingAVehicleIsAllOrNothing) {
  expectAllOrNothing([](Situation& situation) {
    const dBodyID linked[] = {situation.linked.body};
    const VehicleParameters one = situation.second.parameters;
    VehicleParameters both =
        parametersFromBodies(situation.second.body, linked, one.massCentreToFront,
                             one.massCentreToRear, one.width, one.massCentreHeight);
    situation.responder.addVehicle(situation.second.body, both,
                                   {.linkedBodies = linked, .finiteRotation = true});
  });
}

TEST(FailingMemory, UpdatingIsAllOrNothing) {
  const Scene moved = wallAt(0.5);
  expectAllOrNothing(
      [&](Situation& situation) { situation.responder.updateBarrier(situation.rail, moved); });
  expectAllOrNothing([&](Situation& situation) {
    dGeomSetPosition(situation.postGeom.geom, 0.0, 0.4, 1.0);
    // One that was only moved is not read anew.
    dGeomBoxSetLengths(situation.postGeom.geom, 0.3, 0.3, 2.0);
    situation.responder.updateBarrier(situation.post);
  });
}

TEST(FailingMemory, RestoringIsAllOrNothing) {
  expectAllOrNothing([](Situation& situation) { situation.responder.restore(situation.saved); });
}

TEST(FailingMemory, RemovingNeedsNone) {
  Situation situation;
  untilFailure = 0;
  situation.responder.removeVehicle(situation.car);
  situation.responder.removeBarrier(situation.rail);
  untilFailure = -1;
  EXPECT_TRUE(situation.responder.warnings().empty());
  for (int i = 0; i < 10; ++i) situation.step();
}

TEST(FailingMemory, OfANewResponder) {
  OdeWorld ode;
  const long before = live;
  bool failed = true;
  for (long k = 0; failed; ++k) {
    untilFailure = k;
    failsOnce = true;
    failed = false;
    try {
      const Responder responder(ode.world);
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    untilFailure = -1;
  }
  EXPECT_EQ(live, before);
}

// As many allocations live after a thousand rounds as after the first; an id names nothing else.
TEST(FailingMemory, WhatIsRemovedLeavesNothing) {
  Situation situation;
  Responder& responder = situation.responder;
  const Scene scene = wallAt(0.0);
  BarrierId firstBarrier;
  VehicleId firstVehicle;
  const auto round = [&] {
    const BarrierId barrier = responder.addBarrier(scene, {.space = situation.ode.space});
    const BarrierId box = responder.addBarrier(situation.box.geom);
    const VehicleId vehicle =
        responder.addVehicle(situation.second.body, situation.second.parameters);
    EXPECT_NE(barrier, firstBarrier);
    EXPECT_NE(vehicle, firstVehicle);
    responder.removeBarrier(barrier);
    responder.removeBarrier(box);
    responder.removeVehicle(vehicle);
    return std::pair(barrier, vehicle);
  };
  for (int i = 0; i < 3; ++i) std::tie(firstBarrier, firstVehicle) = round();
  const long before = live;
  const int geoms = dSpaceGetNumGeoms(situation.ode.space);
  for (int i = 0; i < 1000; ++i) round();
  EXPECT_EQ(live, before);
  EXPECT_EQ(dSpaceGetNumGeoms(situation.ode.space), geoms);
  EXPECT_THROW(responder.removeBarrier(firstBarrier), Error);
  EXPECT_THROW(responder.removeVehicle(firstVehicle), Error);
}

}  // namespace
}  // namespace bumper::tests
