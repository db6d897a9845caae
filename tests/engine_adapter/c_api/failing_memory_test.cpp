// If memory runs out in a call of the C interface, wherever that is, it says so, has no effect and
// loses nothing.

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "c_world.h"
#include "failing_new.h"

namespace bumper::tests {
namespace {

using Call = std::function<int(CWorld&)>;

// What is to be seen of a world's next half second.
std::vector<double> seen(CWorld& world) {
  std::vector<double> result;
  for (int i = 0; i < 100; ++i) {
    result.push_back(world.step());
    for (const BoxCar* each : {&world.car, &world.other}) {
      const Eigen::Vector3d velocity = each->velocity();
      result.insert(result.end(), {velocity.x(), velocity.y(), each->angularVelocity().z()});
    }
  }
  return result;
}

// Whether the call succeeded after so many allocations.
bool succeedsAfter(long allocations, const Call& call, const std::vector<double>& without) {
  CWorld world;
  const long before = live;
  untilFailure = allocations;
  const int answer = call(world);
  untilFailure = -1;
  if (answer >= 0) return true;
  EXPECT_EQ(answer, BUMPER_OUT_OF_MEMORY);
  EXPECT_TRUE(std::string(bumper_last_error()).ends_with(": out of memory")) << bumper_last_error();
  EXPECT_EQ(live, before);
  EXPECT_EQ(seen(world), without);
  EXPECT_GE(call(world), 0) << bumper_last_error();
  return false;
}

void expectNoEffect(const Call& call) {
  CWorld untouched;
  const std::vector<double> without = seen(untouched);
  for (const bool once : {true, false}) {
    failsOnce = once;
    long allocations = 0;
    while (!succeedsAfter(allocations, call, without) && !testing::Test::HasFailure()) {
      ++allocations;
    }
    EXPECT_GT(allocations, 0) << "nothing was tested";
  }
  failsOnce = true;
}

TEST(CFailingMemory, InCreatingAResponder) {
  expectNoEffect([](CWorld& world) {
    auto settings = initialised(bumper_init_response_settings);
    const double points[] = {0.1, 0.1, 0.2, 0.05};
    settings.restitution.shape = BUMPER_CURVE_TABLE;
    settings.restitution.points = points;
    settings.restitution.point_count = 2;
    auto options = initialised(bumper_init_responder_options);
    options.response = &settings;
    bumper_responder made{};
    const int answer = bumper_create_responder(world.ode.world, &options, &made);
    EXPECT_EQ(made.value != 0, answer == BUMPER_OK);
    if (answer == BUMPER_OK) bumper_destroy_responder(made);
    return answer;
  });
}

TEST(CFailingMemory, InAddingAScene) {
  const CWall far(200.0);
  expectNoEffect([&](CWorld& world) {
    const auto settings = initialised(bumper_init_response_settings);
    const bumper_material_response materials[] = {{.material = "steel", .response = &settings}};
    auto options = initialised(bumper_init_barrier_options);
    options.space = world.ode.space;
    options.name = "a name that is long enough to be on the heap";
    options.materials = materials;
    options.material_count = 1;
    bumper_barrier made{};
    const int answer = bumper_add_scene(world.responder, &far.scene, &options, &made);
    EXPECT_EQ(made.value != 0, answer == BUMPER_OK);
    return answer;
  });
}

TEST(CFailingMemory, InAddingAGeom) {
  OdeWorld other;
  const dGeomID box = dCreateBox(other.space, 1.0, 1.0, 1.0);
  dGeomSetPosition(box, 200.0, 0.0, 0.5);
  expectNoEffect([&](CWorld& world) {
    bumper_barrier made{};
    return bumper_add_geom(world.responder, box, nullptr, &made);
  });
}

TEST(CFailingMemory, InAddingASpace) {
  OdeWorld other;
  for (const double x : {200.0, 210.0}) {
    dGeomSetPosition(dCreateBox(other.space, 1.0, 1.0, 1.0), x, 0.0, 0.5);
  }
  expectNoEffect(
      [&](CWorld& world) { return bumper_add_space(world.responder, other.space, nullptr); });
}

TEST(CFailingMemory, InUpdatingAScene) {
  expectNoEffect([](CWorld& world) {
    return bumper_update_scene(world.responder, world.barrier, &world.wall.scene);
  });
}

TEST(CFailingMemory, InAddingAVehicle) {
  expectNoEffect([](CWorld& world) {
    const auto parameters = inC(world.spare.parameters);
    auto options = initialised(bumper_init_vehicle_options);
    options.name = "a name that is long enough to be on the heap";
    bumper_vehicle made{};
    const int answer =
        bumper_add_vehicle(world.responder, world.spare.body, &parameters, &options, &made);
    EXPECT_EQ(made.value != 0, answer == BUMPER_OK);
    return answer;
  });
}

TEST(CFailingMemory, InSettingAPair) {
  expectNoEffect([](CWorld& world) {
    auto settings = initialised(bumper_init_response_settings);
    settings.restitution.grazing = 1.0;
    auto options = initialised(bumper_init_pair_options);
    options.response = &settings;
    return bumper_set_pair(world.responder, world.vehicle, world.otherVehicle, &options);
  });
}

TEST(CFailingMemory, InSavingAndRestoring) {
  expectNoEffect([](CWorld& world) {
    bumper_state state{};
    int answer = bumper_save(world.responder, &state);
    EXPECT_EQ(state.value != 0, answer == BUMPER_OK);
    if (answer != BUMPER_OK) return answer;
    answer = bumper_restore(world.responder, state);
    EXPECT_EQ(bumper_destroy_state(state), BUMPER_OK);
    return answer;
  });
}

TEST(CFailingMemory, RefusingNeedsNone) {
  CWorld world;
  untilFailure = 0;
  failsOnce = false;
  const int stale = bumper_step({}, 0.005);
  const int bad = bumper_step(world.responder, -1.0);
  untilFailure = -1;
  failsOnce = true;
  // A message needs memory to be put together: without, it says that.
  EXPECT_LT(stale, 0);
  EXPECT_LT(bad, 0);
}

}  // namespace
}  // namespace bumper::tests
