// What handles stand for, from their making to their end; saved states; messages.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <string>
#include <thread>
#include <vector>

#include "c_world.h"

namespace bumper::tests {
namespace {

struct Bodies {
  explicit Bodies(const CWorld& world) {
    for (std::size_t i = 0; i < 2; ++i) {
      const dBodyID body = i == 0 ? world.car.body : world.other.body;
      for (std::size_t k = 0; k < 3; ++k) {
        position[i][k] = dBodyGetPosition(body)[k];
        velocity[i][k] = dBodyGetLinearVel(body)[k];
        angular[i][k] = dBodyGetAngularVel(body)[k];
      }
      for (std::size_t k = 0; k < 4; ++k) quaternion[i][k] = dBodyGetQuaternion(body)[k];
    }
  }
  void restore(const CWorld& world) const {
    for (std::size_t i = 0; i < 2; ++i) {
      const dBodyID body = i == 0 ? world.car.body : world.other.body;
      dBodySetPosition(body, position[i][0], position[i][1], position[i][2]);
      dBodySetQuaternion(body, quaternion[i].data());
      dBodySetLinearVel(body, velocity[i][0], velocity[i][1], velocity[i][2]);
      dBodySetAngularVel(body, angular[i][0], angular[i][1], angular[i][2]);
    }
  }
  bool operator==(const Bodies&) const = default;

  std::array<std::array<double, 3>, 2> position{};
  std::array<std::array<double, 3>, 2> velocity{};
  std::array<std::array<double, 3>, 2> angular{};
  std::array<std::array<double, 4>, 2> quaternion{};
};

TEST(CStates, ContinueBitForBit) {
  CWorld world;
  world.stepToImpact();  // a pulse is pending now
  bumper_state state{};
  ASSERT_EQ(bumper_save(world.responder, &state), BUMPER_OK);
  const Bodies then(world);
  double timeThen = 0.0;
  ASSERT_EQ(bumper_get_time(world.responder, &timeThen), BUMPER_OK);
  std::vector<Bodies> first;
  for (int round = 0; round < 3; ++round) {
    if (round > 0) {
      then.restore(world);
      ASSERT_EQ(bumper_restore(world.responder, state), BUMPER_OK) << bumper_last_error();
      double time = 0.0;
      ASSERT_EQ(bumper_get_time(world.responder, &time), BUMPER_OK);
      ASSERT_EQ(time, timeThen);
    }
    for (std::size_t i = 0; i < 200; ++i) {
      world.step();
      if (round == 0) {
        first.emplace_back(world);
      } else {
        ASSERT_TRUE(Bodies(world) == first[i]) << "step " << i << " of round " << round;
      }
    }
  }
  EXPECT_EQ(bumper_destroy_state(state), BUMPER_OK);
}

// A state in which nothing pends is not that one: the test above would notice.
TEST(CStates, AreThoseOfTheirTime) {
  CWorld world;
  bumper_state early{};
  ASSERT_EQ(bumper_save(world.responder, &early), BUMPER_OK);
  world.stepToImpact();
  const Bodies then(world);
  world.step();
  const Bodies next(world);
  then.restore(world);
  ASSERT_EQ(bumper_restore(world.responder, early), BUMPER_OK);
  world.step();
  EXPECT_FALSE(Bodies(world) == next);
  EXPECT_EQ(bumper_destroy_state(early), BUMPER_OK);
}

TEST(CStates, OfOtherVehiclesAreRefused) {
  CWorld world;
  bumper_state state{};
  ASSERT_EQ(bumper_save(world.responder, &state), BUMPER_OK);
  ASSERT_EQ(bumper_remove_vehicle(world.responder, world.vehicle), BUMPER_OK);
  EXPECT_EQ(bumper_restore(world.responder, state), BUMPER_INVALID_ARGUMENT);
  EXPECT_NE(std::string(bumper_last_error()).find("saved state"), std::string::npos);
  EXPECT_EQ(bumper_destroy_state(state), BUMPER_OK);
}

TEST(CHandles, AreNeverUsedTwice) {
  OdeWorld ode;
  std::vector<bumper_responder> gone;
  for (int i = 0; i < 1000; ++i) {
    bumper_responder responder{};
    ASSERT_EQ(bumper_create_responder(ode.world, nullptr, &responder), BUMPER_OK);
    for (const bumper_responder each : gone) ASSERT_NE(each.value, responder.value);
    ASSERT_EQ(bumper_destroy_responder(responder), BUMPER_OK);
    gone.push_back(responder);
  }
  for (const bumper_responder each : gone) {
    ASSERT_EQ(bumper_step(each, 0.005), BUMPER_STALE_HANDLE);
    ASSERT_EQ(bumper_destroy_responder(each), BUMPER_STALE_HANDLE);
  }
}

TEST(CHandles, OfManyRespondersNameTheirOwn) {
  OdeWorld ode;
  std::array<bumper_responder, 300> all{};
  for (bumper_responder& each : all) {
    ASSERT_EQ(bumper_create_responder(ode.world, nullptr, &each), BUMPER_OK);
  }
  for (std::size_t i = 0; i < all.size(); i += 3) {
    ASSERT_EQ(bumper_destroy_responder(all[i]), BUMPER_OK);
  }
  double h = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    h = 1e-3 * static_cast<double>(i);
    ASSERT_EQ(bumper_step(all[i], h), i % 3 == 0 ? int{BUMPER_STALE_HANDLE} : 0);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % 3 == 0) continue;
    double time = 0.0;
    ASSERT_EQ(bumper_get_time(all[i], &time), BUMPER_OK);
    EXPECT_EQ(time, 1e-3 * static_cast<double>(i));
    ASSERT_EQ(bumper_destroy_responder(all[i]), BUMPER_OK);
  }
}

TEST(CHandles, AreFoundWhileOtherThreadsMakeSome) {
  // Each world is its thread's own; ODE's own allocations are made beforehand.
  std::array<OdeWorld, 4> odes;
  std::array<std::thread, odes.size()> threads;
  std::array<int, odes.size()> failures{};
  for (std::size_t i = 0; i < odes.size(); ++i) {
    threads[i] = std::thread([&, i] {
      dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
      bumper_responder kept{};
      if (bumper_create_responder(odes[i].world, nullptr, &kept) != BUMPER_OK) ++failures[i];
      for (int round = 0; round < 500; ++round) {
        bumper_responder other{};
        if (bumper_create_responder(odes[i].world, nullptr, &other) != BUMPER_OK) ++failures[i];
        if (bumper_step(kept, 0.001) != 0) ++failures[i];
        if (bumper_destroy_responder(other) != BUMPER_OK) ++failures[i];
        if (bumper_step(other, 0.001) != BUMPER_STALE_HANDLE) ++failures[i];
      }
      if (bumper_destroy_responder(kept) != BUMPER_OK) ++failures[i];
      dCleanupODEAllDataForThread();
    });
  }
  for (std::thread& each : threads) each.join();
  for (const int each : failures) EXPECT_EQ(each, 0);
}

TEST(CErrors, AreOfTheThreadThatCalled) {
  EXPECT_EQ(bumper_destroy_state({}), BUMPER_STALE_HANDLE);
  std::thread([] {
    EXPECT_STREQ(bumper_last_error(), "");
    EXPECT_LT(bumper_step({}, 0.005), 0);
    EXPECT_STREQ(bumper_last_error(), "bumper_step: responder is 0, which names nothing");
  }).join();
  EXPECT_STREQ(bumper_last_error(), "bumper_destroy_state: state is 0, which names nothing");
}

// A name that is too long for a message is cut off between two characters.
TEST(CErrors, AreCutOffBetweenCharacters) {
  CWorld world;
  for (std::size_t shift = 0; shift < 4; ++shift) {
    std::string name(shift, 'x');
    for (int i = 0; i < 2000; ++i) name += "€";
    const auto settings = initialised(bumper_init_response_settings);
    const bumper_material_response materials[] = {
        {.material = name.c_str(), .response = &settings}};
    auto options = initialised(bumper_init_barrier_options);
    options.materials = materials;
    options.material_count = 1;
    bumper_barrier barrier{};
    ASSERT_EQ(bumper_add_scene(world.responder, &world.wall.scene, &options, &barrier),
              BUMPER_INVALID_ARGUMENT);
    const std::string message = bumper_last_error();
    EXPECT_GT(message.size(), 1000U);
    EXPECT_TRUE(message.ends_with("€"));
  }
}

TEST(CEvents, AreVoidOnceTheirNamesMayBe) {
  CWorld world;
  auto event = initialised(bumper_init_event);
  world.stepToImpact();
  ASSERT_EQ(bumper_get_event(world.responder, 0, &event), BUMPER_OK);
  ASSERT_EQ(bumper_update_scene(world.responder, world.barrier, &world.wall.scene), BUMPER_OK)
      << bumper_last_error();
  EXPECT_EQ(bumper_get_event(world.responder, 0, &event), BUMPER_INVALID_ARGUMENT);
  world.start();
  world.stepToImpact();
  ASSERT_EQ(bumper_remove_vehicle(world.responder, world.vehicle), BUMPER_OK);
  EXPECT_EQ(bumper_get_event(world.responder, 0, &event), BUMPER_INVALID_ARGUMENT);
}

TEST(CSpaces, AreKeptInStep) {
  CWorld world;
  const bumper_responder responder = world.responder;
  const dSpaceID space = dSimpleSpaceCreate(world.ode.space);
  const dGeomID first = dCreateBox(space, 1.0, 1.0, 1.0);
  dGeomSetPosition(first, 100.0, 0.0, 0.5);
  const dGeomID plane = dCreatePlane(space, 0.0, 0.0, 1.0, -10.0);
  ASSERT_EQ(bumper_add_space(responder, space, nullptr), 1) << bumper_last_error();
  bumper_barrier barrier{};
  ASSERT_EQ(bumper_get_space_barrier(responder, space, 0, &barrier), BUMPER_OK);
  dGeomID geom = nullptr;
  ASSERT_EQ(bumper_get_geom(responder, barrier, &geom), BUMPER_OK);
  EXPECT_EQ(geom, first);
  ASSERT_EQ(bumper_left_geom_count(responder, space), 1);
  const char* reason = "";
  ASSERT_EQ(bumper_get_left_geom(responder, space, 0, &geom, &reason), BUMPER_OK);
  EXPECT_EQ(geom, plane);
  EXPECT_STRNE(reason, "");

  // One comes into the cars' way, the other one goes.
  const dGeomID second = dCreateBox(space, 1.0, 40.0, 1.0);
  dGeomSetPosition(second, 5.0, 0.0, 0.5);
  dGeomDestroy(first);
  ASSERT_EQ(bumper_update_space(responder, space), 1) << bumper_last_error();
  EXPECT_EQ(bumper_get_geom(responder, barrier, &geom), BUMPER_STALE_HANDLE);
  ASSERT_EQ(bumper_get_space_barrier(responder, space, 0, &barrier), BUMPER_OK);
  ASSERT_EQ(bumper_get_geom(responder, barrier, &geom), BUMPER_OK);
  EXPECT_EQ(geom, second);
  for (int i = 0; i < 200; ++i) world.step();
  EXPECT_LT(dBodyGetPosition(world.car.body)[0], 4.5 - 2.0);

  ASSERT_EQ(bumper_remove_space(responder, space), BUMPER_OK);
  EXPECT_EQ(bumper_get_geom(responder, barrier, &geom), BUMPER_STALE_HANDLE);
  EXPECT_EQ(bumper_update_space(responder, space), BUMPER_INVALID_ARGUMENT);
}

TEST(CWarnings, AreText) {
  CWorld world;
  const BoxCar damped(world.ode.world);
  dBodySetLinearDamping(damped.body, 0.01);
  const auto parameters = inC(damped.parameters);
  auto options = initialised(bumper_init_vehicle_options);
  options.name = "damped";
  bumper_vehicle vehicle{};
  const int before = bumper_warning_count(world.responder);
  ASSERT_EQ(bumper_add_vehicle(world.responder, damped.body, &parameters, &options, &vehicle),
            BUMPER_OK);
  ASSERT_EQ(bumper_warning_count(world.responder), before + 1);
  const char* text = nullptr;
  ASSERT_EQ(bumper_get_warning(world.responder, static_cast<std::size_t>(before), &text),
            BUMPER_OK);
  EXPECT_NE(std::string(text).find("damped"), std::string::npos) << text;
  EXPECT_EQ(bumper_remove_vehicle(world.responder, vehicle), BUMPER_OK);
}

TEST(CReport, CountsWalls) {
  const CWorld world;
  auto report = initialised(bumper_init_wall_report);
  ASSERT_EQ(bumper_get_wall_report(world.responder, world.barrier, &report), BUMPER_OK);
  EXPECT_EQ(report.walls, 2U);
  EXPECT_EQ(report.highest_top, 1.0);
  EXPECT_GT(report.memory, 0U);
}

TEST(CIssues, AreThoseOfTheStep) {
  const CWorld world;
  dBodySetKinematic(world.car.body);
  EXPECT_EQ(bumper_step(world.responder, 0.005), 0);
  EXPECT_EQ(bumper_get_issues(world.responder), BUMPER_ISSUE_KINEMATIC);
  EXPECT_EQ(bumper_get_vehicle_issues(world.responder, world.vehicle), BUMPER_ISSUE_KINEMATIC);
  EXPECT_EQ(bumper_get_vehicle_issues(world.responder, world.otherVehicle), 0);
}

TEST(CPairs, CanBeLeftAlone) {
  CWorld world;
  auto options = initialised(bumper_init_pair_options);
  options.collide = 0;
  ASSERT_EQ(bumper_set_pair(world.responder, world.otherVehicle, world.vehicle, &options),
            BUMPER_OK);
  auto event = initialised(bumper_init_event);
  for (int i = 0; i < 200; ++i) {
    const int events = world.step();
    for (int k = 0; k < events; ++k) {
      ASSERT_EQ(bumper_get_event(world.responder, static_cast<std::size_t>(k), &event), BUMPER_OK);
      EXPECT_STREQ(event.other_vehicle, "");
    }
  }
  EXPECT_STREQ(event.barrier, "wall");
}

TEST(CBand, IsThatOfCpp) {
  const CWorld world;
  const auto parameters = inC(world.car.parameters);
  bumper_band band{};
  ASSERT_EQ(bumper_default_band(&parameters, &band), BUMPER_OK);
  EXPECT_EQ(band.bottom, defaultBand(world.car.parameters).bottom);
  EXPECT_EQ(band.top, defaultBand(world.car.parameters).top);
  ASSERT_EQ(bumper_plate_band(&parameters, &band), BUMPER_OK);
  EXPECT_EQ(band.top, plateBand(world.car.parameters).top);
}

TEST(CParameters, FromGeomsAreThoseOfCpp) {
  const CWorld world;
  auto parameters = initialised(bumper_init_vehicle_parameters);
  ASSERT_EQ(bumper_parameters_from_geoms(world.car.body, nullptr, 0.55, &parameters), BUMPER_OK);
  const VehicleParameters expected = parametersFromGeoms(world.car.body, {}, 0.55);
  EXPECT_EQ(parameters.mass_centre_to_front, expected.massCentreToFront);
  EXPECT_EQ(parameters.width, expected.width);
  EXPECT_EQ(parameters.yaw_inertia, expected.yawInertia);
}

}  // namespace
}  // namespace bumper::tests
