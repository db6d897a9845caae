// Every call that sets something up, with arguments that are NaN, infinite, negative, zero, huge,
// null and stale. (That none is left out: arguments_of_all_test.cpp.)

#include <memory>

#include "arguments.h"

namespace bumper::tests {
namespace {

template <typename Struct>
int withSize(int (*initialise)(Struct*, std::size_t), Struct* target) {
  return initialise(target, target != nullptr ? target->size : sizeof(Struct));
}

TEST_F(CArguments, OfInitFunctionsAreRefused) {
#define REFUSE_INIT(function, Struct, argument) \
  refuseFilling<Struct>(#function, argument,    \
                        [](Struct* target) { return withSize(function, target); })
  REFUSE_INIT(bumper_init_response_settings, bumper_response_settings, "settings");
  REFUSE_INIT(bumper_init_responder_options, bumper_responder_options, "options");
  REFUSE_INIT(bumper_init_wall_selection, bumper_wall_selection, "walls");
  REFUSE_INIT(bumper_init_barrier_options, bumper_barrier_options, "options");
  REFUSE_INIT(bumper_init_scene, bumper_scene, "scene");
  REFUSE_INIT(bumper_init_wall_report, bumper_wall_report, "report");
  REFUSE_INIT(bumper_init_vehicle_parameters, bumper_vehicle_parameters, "parameters");
  REFUSE_INIT(bumper_init_vehicle_options, bumper_vehicle_options, "options");
  REFUSE_INIT(bumper_init_pair_options, bumper_pair_options, "options");
  REFUSE_INIT(bumper_init_motion, bumper_motion, "motion");
  REFUSE_INIT(bumper_init_event, bumper_event, "event");
#undef REFUSE_INIT
}

TEST_F(CArguments, OfPresetsAreRefused) {
  const char* name = nullptr;
  for (const std::size_t index : {std::size_t{4}, hugeCount}) {
    expectRefused("bumper_get_preset", "index", bumper_get_preset(index, &name, nullptr));
  }
  expectRefused("bumper_get_preset", "name", bumper_get_preset(0, nullptr, nullptr));
  refuseFilling<Settings>("bumper_find_preset", "settings",
                          [](Settings* settings) { return bumper_find_preset("paper", settings); });
  expectRefused("bumper_find_preset", "name", bumper_find_preset(nullptr, &settings_));
  expectRefused("bumper_find_preset", "name", bumper_find_preset("", &settings_));
  expectRefused("bumper_find_preset", "name", bumper_find_preset("Paper", &settings_));
  Settings unset{};
  expectRefused("bumper_get_preset", "settings", bumper_get_preset(0, &name, &unset));
  EXPECT_EQ(name, nullptr);
}

TEST_F(CArguments, OfAResponderAreRefused) {
  using Options = bumper_responder_options;
  const char* call = "bumper_create_responder";
  bumper_responder made{};
  dWorldID world = world_.ode.world;
  expectRefused(call, "world", bumper_create_responder(nullptr, nullptr, &made));
  expectRefused(call, "responder", bumper_create_responder(world, nullptr, nullptr));
  const Options valid = initialised(bumper_init_responder_options);
  const Call<Options> with = [&](const Options* options) {
    return bumper_create_responder(world, options, &made);
  };
  refuseSizes<Options>(call, "options", valid, with);
  refuseMember<Options>(call, "options.vehicles_collide", valid, &Options::vehicles_collide, 2,
                        with);
  refuseMember<Options>(call, "options.delivery", valid, &Options::delivery, 2, with);
  refuseMember<Options>(call, "options.guard_contacts", valid, &Options::guard_contacts, 2, with);
  refuseMember<Options>(call, "options.skipping", valid, &Options::skipping, 2, with);
  refuseDirection<Options>(call, "options.up", valid, &Options::up, with);
  refuseMember<Options>(call, "options.metre", valid, &Options::metre, {0.0, -1.0}, with);
  for (const bool isOfWalls : {true, false}) {
    refuseSettings(call, isOfWalls ? "options.response" : "options.vehicle_response",
                   [&](const Settings* settings) {
                     Options options = valid;
                     (isOfWalls ? options.response : options.vehicle_response) = settings;
                     return with(&options);
                   });
  }
  EXPECT_EQ(made.value, 0U);
  refuseResponder("bumper_destroy_responder", bumper_destroy_responder);
}

TEST_F(CArguments, OfScenesAreRefused) {
  using Scene = bumper_scene;
  bumper_barrier made{};
  const Scene valid = world_.wall.scene;
  refuseResponder("bumper_add_scene", [&](bumper_responder responder) {
    return bumper_add_scene(responder, &valid, nullptr, &made);
  });
  refuseResponder("bumper_update_scene", [&](bumper_responder responder) {
    return bumper_update_scene(responder, world_.barrier, &valid);
  });
  refuseBarrier("bumper_update_scene", [&](bumper_barrier barrier) {
    return bumper_update_scene(world_.responder, barrier, &valid);
  });
  expectRefused("bumper_add_scene", "barrier",
                bumper_add_scene(world_.responder, &valid, nullptr, nullptr));

  const auto refuse = [&](const char* function, const Call<Scene>& call) {
    expectRefused(function, "scene", call(nullptr));
    refuseSizes<Scene>(function, "scene", valid, call);
    const auto changed = [&](const char* argument, const auto& change) {
      Scene scene = valid;
      change(scene);
      expectRefused(function, argument, call(&scene));
    };
    changed("scene.vertices", [](Scene& scene) { scene.vertices = nullptr; });
    changed("scene.vertices", [](Scene& scene) { scene.vertex_count = hugeCount; });
    changed("vertex", [](Scene& scene) { scene.vertex_count = 0; });
    changed("scene.triangles", [](Scene& scene) { scene.triangles = nullptr; });
    changed("scene.triangles", [](Scene& scene) { scene.triangle_count = hugeCount; });
    changed("triangle", [](Scene& scene) { scene.triangle_count = 0; });
    changed("scene.meshes", [](Scene& scene) { scene.meshes = nullptr; });
    changed("scene.meshes", [](Scene& scene) { scene.mesh_count = hugeCount; });
    changed("mesh", [](Scene& scene) { scene.mesh_count = 0; });
    const std::uint32_t otherMeshes[] = {0, 1};
    changed("mesh", [&](Scene& scene) { scene.triangle_meshes = otherMeshes; });
    const std::uint32_t corners[] = {0, 1, 2, 0, 1, 0xFFFFFFFF};
    changed("vertex", [&](Scene& scene) { scene.triangles = corners; });
    const std::uint32_t flat[] = {0, 0, 0, 1, 1, 1};
    changed("wall", [&](Scene& scene) { scene.triangles = flat; });
    refuseNumber(function, "scene.vertices[4]", {}, [&](double value) {
      auto vertices = world_.wall.vertices;
      vertices[4] = value;
      Scene scene = valid;
      scene.vertices = vertices.data();
      return call(&scene);
    });
  };
  refuse("bumper_add_scene", [&](const Scene* scene) {
    return bumper_add_scene(world_.responder, scene, nullptr, &made);
  });
  refuse("bumper_update_scene", [&](const Scene* scene) {
    return bumper_update_scene(world_.responder, world_.barrier, scene);
  });
  EXPECT_EQ(made.value, 0U);
}

TEST_F(CArguments, OfBarriersAreRefused) {
  using Options = bumper_barrier_options;
  using Walls = bumper_wall_selection;
  const dGeomID box = dCreateBox(world_.ode.space, 1.0, 1.0, 1.0);
  dGeomSetPosition(box, 500.0, 0.0, 0.5);
  bumper_barrier made{};
  refuseResponder("bumper_add_geom", [&](bumper_responder responder) {
    return bumper_add_geom(responder, box, nullptr, &made);
  });
  expectRefused("bumper_add_geom", "geom",
                bumper_add_geom(world_.responder, nullptr, nullptr, &made));
  expectRefused("bumper_add_geom", "geom",
                bumper_add_geom(world_.responder, world_.car.geom, nullptr, &made));
  expectRefused("bumper_add_geom", "barrier",
                bumper_add_geom(world_.responder, box, nullptr, nullptr));

  const auto refuse = [&](const char* function, const Call<Options>& call) {
    const Options valid = initialised(bumper_init_barrier_options);
    refuseSizes<Options>(function, "options", valid, call);
    refuseSettings(function, "options.response", [&](const Settings* settings) {
      Options options = valid;
      options.response = settings;
      return call(&options);
    });
    const auto withMaterials = [&](const bumper_material_response* materials, std::size_t count) {
      Options options = valid;
      options.materials = materials;
      options.material_count = count;
      return call(&options);
    };
    const bumper_material_response fine[] = {{.material = "wood", .response = &settings_}};
    expectRefused(function, "options.materials", withMaterials(nullptr, 1));
    expectRefused(function, "options.materials", withMaterials(fine, hugeCount));
    expectRefused(function, "wood", withMaterials(fine, 1));
    const bumper_material_response unnamed[] = {{.material = nullptr, .response = &settings_}};
    expectRefused(function, "options.materials[0].material", withMaterials(unnamed, 1));
    refuseSettings(function, "options.materials[0].response", [&](const Settings* settings) {
      const bumper_material_response one[] = {{.material = "wood", .response = settings}};
      return withMaterials(one, 1);
    });
    const bumper_material_response empty[] = {{.material = "wood", .response = nullptr}};
    expectRefused(function, "options.materials[0].response", withMaterials(empty, 1));

    const Walls walls = initialised(bumper_init_wall_selection);
    const Call<Walls> withWalls = [&](const Walls* changed) {
      Options options = valid;
      options.walls = changed;
      return call(&options);
    };
    refuseSizes<Walls>(function, "options.walls", walls, withWalls);
    const auto number = [&](const char* name, double Walls::*member,
                            const std::vector<double>& notAllowed) {
      refuseMember<Walls>(function, std::string("options.walls.") + name, walls, member, notAllowed,
                          withWalls);
    };
    number("max_normal_up", &Walls::max_normal_up, {-0.1, 1.1});
    number("reach_distance", &Walls::reach_distance, {-1.0});
    number("reach_above", &Walls::reach_above, {-1.0});
    number("reach_below", &Walls::reach_below, {-1.0});
    refuseMember<Walls>(function, "options.walls.drop_repeated", walls, &Walls::drop_repeated, 2,
                        withWalls);
    refuseMember<Walls>(function, "options.walls.limit_ground_reach", walls,
                        &Walls::limit_ground_reach, 2, withWalls);
  };
  refuse("bumper_add_scene", [&](const Options* options) {
    return bumper_add_scene(world_.responder, &world_.wall.scene, options, &made);
  });
  refuse("bumper_add_geom", [&](const Options* options) {
    return bumper_add_geom(world_.responder, box, options, &made);
  });
  EXPECT_EQ(made.value, 0U);

  refuseResponder("bumper_update_barrier", [&](bumper_responder responder) {
    return bumper_update_barrier(responder, world_.barrier);
  });
  refuseBarrier("bumper_update_barrier", [&](bumper_barrier barrier) {
    return bumper_update_barrier(world_.responder, barrier);
  });
  refuseResponder("bumper_remove_barrier", [&](bumper_responder responder) {
    return bumper_remove_barrier(responder, world_.barrier);
  });
  refuseBarrier("bumper_remove_barrier", [&](bumper_barrier barrier) {
    return bumper_remove_barrier(world_.responder, barrier);
  });
  dGeomDestroy(box);
}

TEST_F(CArguments, OfSpacesAreRefused) {
  const bumper_responder responder = world_.responder;
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  const dGeomID box = dCreateBox(space, 1.0, 1.0, 1.0);
  dGeomSetPosition(box, 500.0, 0.0, 0.5);
  bumper_barrier barrier{};
  dGeomID geom = nullptr;
  const char* reason = nullptr;
  const auto refuse = [&](const char* function, const auto& call) {
    refuseResponder(function, [&](bumper_responder stale) { return call(stale, space); });
    expectRefused(function, "space", call(responder, nullptr));
    expectRefused(function, "space", call(responder, space));
  };
  refuse("bumper_update_space", bumper_update_space);
  refuse("bumper_remove_space", bumper_remove_space);
  refuse("bumper_left_geom_count", bumper_left_geom_count);
  const auto getBarrier = [&](bumper_responder some, dSpaceID which) {
    return bumper_get_space_barrier(some, which, 0, &barrier);
  };
  const auto getLeft = [&](bumper_responder some, dSpaceID which) {
    return bumper_get_left_geom(some, which, 0, &geom, &reason);
  };
  refuse("bumper_get_space_barrier", getBarrier);
  refuse("bumper_get_left_geom", getLeft);

  const char* add = "bumper_add_space";
  refuseResponder(add,
                  [&](bumper_responder stale) { return bumper_add_space(stale, space, nullptr); });
  expectRefused(add, "space", bumper_add_space(responder, nullptr, nullptr));
  const auto options = initialised(bumper_init_barrier_options);
  refuseSizes<bumper_barrier_options>(
      add, "options", options,
      [&](const bumper_barrier_options* some) { return bumper_add_space(responder, space, some); });
  refuseSettings(add, "options.response", [&](const Settings* settings) {
    bumper_barrier_options some = options;
    some.response = settings;
    return bumper_add_space(responder, space, &some);
  });
  ASSERT_EQ(bumper_add_space(responder, space, &options), 1) << bumper_last_error();
  expectRefused(add, "space", bumper_add_space(responder, space, nullptr));
  for (const std::size_t index : {std::size_t{1}, hugeCount}) {
    expectRefused("bumper_get_space_barrier", "index",
                  bumper_get_space_barrier(responder, space, index, &barrier));
    expectRefused("bumper_get_left_geom", "index",
                  bumper_get_left_geom(responder, space, index, &geom, &reason));
  }
  expectRefused("bumper_get_space_barrier", "barrier",
                bumper_get_space_barrier(responder, space, 0, nullptr));
  dCreatePlane(space, 0.0, 0.0, 1.0, -1.0);
  ASSERT_EQ(bumper_update_space(responder, space), 1) << bumper_last_error();
  ASSERT_EQ(bumper_left_geom_count(responder, space), 1);
  expectRefused("bumper_get_left_geom", "geom",
                bumper_get_left_geom(responder, space, 0, nullptr, &reason));
  expectRefused("bumper_get_left_geom", "reason",
                bumper_get_left_geom(responder, space, 0, &geom, nullptr));
  EXPECT_EQ(barrier.value, 0U);
  EXPECT_EQ(geom, nullptr);
  EXPECT_EQ(bumper_remove_space(responder, space), BUMPER_OK);
  dSpaceDestroy(space);
}

TEST_F(CArguments, OfVehiclesAreRefused) {
  using Options = bumper_vehicle_options;
  const char* call = "bumper_add_vehicle";
  const BoxCar third(world_.ode.world);
  const bumper_vehicle_parameters parameters = inC(third.parameters);
  bumper_vehicle made{};
  refuseResponder(call, [&](bumper_responder responder) {
    return bumper_add_vehicle(responder, third.body, &parameters, nullptr, &made);
  });
  expectRefused(call, "chassis",
                bumper_add_vehicle(world_.responder, nullptr, &parameters, nullptr, &made));
  expectRefused(call, "vehicle",
                bumper_add_vehicle(world_.responder, third.body, &parameters, nullptr, nullptr));
  refuseParameters(call, [&](const bumper_vehicle_parameters* some) {
    return bumper_add_vehicle(world_.responder, third.body, some, nullptr, &made);
  });

  const Options valid = initialised(bumper_init_vehicle_options);
  const Call<Options> with = [&](const Options* options) {
    return bumper_add_vehicle(world_.responder, third.body, &parameters, options, &made);
  };
  refuseSizes<Options>(call, "options", valid, with);
  refuseMember<Options>(call, "options.mover", valid, &Options::mover, 3, with);
  refuseMember<Options>(call, "options.finite_rotation", valid, &Options::finite_rotation, 2, with);
  refuseMember<Options>(call, "options.tilt_limit", valid, &Options::tilt_limit, {0.0, -1.0, 1.6},
                        with);
  refuseDirection<Options>(call, "options.forward", valid, &Options::forward, with);
  refuseDirection<Options>(call, "options.up", valid, &Options::up, with);
  const Call<bumper_band> withBand = [&](const bumper_band* band) {
    Options options = valid;
    options.band = band;
    return with(&options);
  };
  const bumper_band band{.bottom = 0.3, .top = 0.7};
  refuseMember<bumper_band>(call, "options.band.bottom", band, &bumper_band::bottom, {0.7},
                            withBand);
  refuseMember<bumper_band>(call, "options.band.top", band, &bumper_band::top, {0.0, -1.0, 0.3},
                            withBand);
  Options linked = valid;
  linked.linked_body_count = 1;
  expectRefused(call, "options.linked_bodies", with(&linked));
  const dBodyID bodies[] = {nullptr};
  linked.linked_bodies = bodies;
  expectRefused(call, "linked body 0 is null", with(&linked));
  linked.linked_body_count = hugeCount;
  expectRefused(call, "options.linked_bodies", with(&linked));
  EXPECT_EQ(made.value, 0U);

  refuseResponder("bumper_remove_vehicle", [&](bumper_responder responder) {
    return bumper_remove_vehicle(responder, world_.vehicle);
  });
  refuseVehicle("bumper_remove_vehicle", "vehicle", [&](bumper_vehicle vehicle) {
    return bumper_remove_vehicle(world_.responder, vehicle);
  });
}

TEST_F(CArguments, OfMeasuredParametersAreRefused) {
  using Options = bumper_vehicle_options;
  using Parameters = bumper_vehicle_parameters;
  const dBodyID body = world_.car.body;
  auto result = initialised(bumper_init_vehicle_parameters);
  const auto refuse = [&](const char* function, const auto& measure) {
    expectRefused(function, "chassis", measure(nullptr, nullptr, &result));
    refuseFilling<Parameters>(function, "parameters",
                              [&](Parameters* target) { return measure(body, nullptr, target); });
    Options options = initialised(bumper_init_vehicle_options);
    const Call<Options> with = [&](const Options* some) { return measure(body, some, &result); };
    refuseSizes<Options>(function, "options", options, with);
    refuseDirection<Options>(function, "options.forward", options, &Options::forward, with);
    options.linked_body_count = 1;
    expectRefused(function, "options.linked_bodies", with(&options));
    const dBodyID bodies[] = {nullptr};
    options.linked_bodies = bodies;
    expectRefused(function, "null", with(&options));
    options.linked_body_count = hugeCount;
    expectRefused(function, "options.linked_bodies", with(&options));
  };
  refuse("bumper_parameters_from_bodies",
         [](dBodyID chassis, const Options* options, Parameters* target) {
           return bumper_parameters_from_bodies(chassis, options, 2.1, 2.5, 1.8, 0.55, target);
         });
  refuse("bumper_parameters_from_geoms",
         [](dBodyID chassis, const Options* options, Parameters* target) {
           return bumper_parameters_from_geoms(chassis, options, 0.55, target);
         });
  const std::array names{"mass_centre_to_front", "mass_centre_to_rear", "width",
                         "mass_centre_height"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    refuseNumber("bumper_parameters_from_bodies", names[i], {0.0, -1.0}, [&](double value) {
      std::array<double, 4> numbers{2.1, 2.5, 1.8, 0.55};
      numbers[i] = value;
      return bumper_parameters_from_bodies(body, nullptr, numbers[0], numbers[1], numbers[2],
                                           numbers[3], &result);
    });
  }
  refuseNumber(
      "bumper_parameters_from_geoms", "mass_centre_height", {0.0, -1.0},
      [&](double value) { return bumper_parameters_from_geoms(body, nullptr, value, &result); });
  EXPECT_EQ(result.mass, 0.0);

  bumper_band band{};
  const Parameters valid = inC(world_.car.parameters);
  refuseParameters("bumper_default_band", [&](const Parameters* parameters) {
    return bumper_default_band(parameters, &band);
  });
  refuseParameters("bumper_plate_band", [&](const Parameters* parameters) {
    return bumper_plate_band(parameters, &band);
  });
  expectRefused("bumper_default_band", "band", bumper_default_band(&valid, nullptr));
  expectRefused("bumper_plate_band", "band", bumper_plate_band(&valid, nullptr));
  EXPECT_EQ(band.top, 0.0);
}

TEST_F(CArguments, OfPairsAreRefused) {
  using Options = bumper_pair_options;
  const char* call = "bumper_set_pair";
  const Options valid = initialised(bumper_init_pair_options);
  const bumper_vehicle a = world_.vehicle;
  const bumper_vehicle b = world_.otherVehicle;
  refuseResponder(
      call, [&](bumper_responder responder) { return bumper_set_pair(responder, a, b, &valid); });
  refuseVehicle(call, "a", [&](bumper_vehicle stale) {
    return bumper_set_pair(world_.responder, stale, b, &valid);
  });
  refuseVehicle(call, "b", [&](bumper_vehicle stale) {
    return bumper_set_pair(world_.responder, a, stale, &valid);
  });
  expectRefused(call, "same", bumper_set_pair(world_.responder, a, a, &valid));
  const Call<Options> with = [&](const Options* options) {
    return bumper_set_pair(world_.responder, a, b, options);
  };
  expectRefused(call, "options", with(nullptr));
  refuseSizes<Options>(call, "options", valid, with);
  refuseMember<Options>(call, "options.collide", valid, &Options::collide, 2, with);
  Options reserved = valid;
  reserved.reserved = 1;
  expectRefused(call, "options.reserved", with(&reserved));
  refuseSettings(call, "options.response", [&](const Settings* settings) {
    Options options = valid;
    options.response = settings;
    return with(&options);
  });
}

TEST_F(CArguments, OfSavedStatesAreRefused) {
  refuseResponder("bumper_save", [](bumper_responder responder) {
    bumper_state state{};
    return bumper_save(responder, &state);
  });
  expectRefused("bumper_save", "state", bumper_save(world_.responder, nullptr));
  bumper_state state{};
  ASSERT_EQ(bumper_save(world_.responder, &state), BUMPER_OK);
  refuseResponder("bumper_restore",
                  [&](bumper_responder responder) { return bumper_restore(responder, state); });
  refuseState("bumper_restore",
              [&](bumper_state stale) { return bumper_restore(world_.responder, stale); });
  refuseState("bumper_destroy_state", bumper_destroy_state);
  EXPECT_EQ(bumper_destroy_state(state), BUMPER_OK);
}

}  // namespace
}  // namespace bumper::tests
