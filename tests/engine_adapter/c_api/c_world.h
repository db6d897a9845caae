#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "box_car.h"
#include "bumper/engine_adapter/c_api.h"
#include "ode_world.h"

namespace bumper::tests {

/// A struct of the interface with its defaults.
template <typename Struct>
Struct initialised(int (*initialise)(Struct*, std::size_t)) {
  Struct result;
  EXPECT_EQ(initialise(&result, sizeof result), BUMPER_OK) << bumper_last_error();
  return result;
}

/// A wall across x at `x`, of one material.
struct CWall {
  explicit CWall(double x) {
    vertices = {x, -20, 0, x, 20, 0, x, 20, 1, x, -20, 1};
    scene.name = "wall";
    scene.vertices = vertices.data();
    scene.vertex_count = 4;
    scene.triangles = triangles.data();
    scene.triangle_count = 2;
    scene.meshes = &mesh;
    scene.mesh_count = 1;
  }
  CWall(const CWall&) = delete;
  CWall& operator=(const CWall&) = delete;
  CWall(CWall&&) = delete;
  CWall& operator=(CWall&&) = delete;
  ~CWall() = default;

  std::array<double, 12> vertices{};
  std::array<std::uint32_t, 6> triangles{0, 2, 1, 0, 3, 2};
  bumper_scene_mesh mesh{.name = "mesh", .material = "steel"};
  bumper_scene scene = initialised(bumper_init_scene);
};

inline bumper_vehicle_parameters inC(const VehicleParameters& parameters) {
  auto result = initialised(bumper_init_vehicle_parameters);
  result.mass = parameters.mass;
  result.yaw_inertia = parameters.yawInertia;
  result.mass_centre_to_front = parameters.massCentreToFront;
  result.mass_centre_to_rear = parameters.massCentreToRear;
  result.width = parameters.width;
  result.mass_centre_height = parameters.massCentreHeight;
  return result;
}

/// Two cars that run one behind the other into a wall, all registered through C.
struct CWorld {
  CWorld() {
    const bumper_vehicle_parameters parameters = inC(car.parameters);
    EXPECT_EQ(bumper_create_responder(ode.world, nullptr, &responder), BUMPER_OK);
    EXPECT_EQ(bumper_add_scene(responder, &wall.scene, nullptr, &barrier), BUMPER_OK);
    EXPECT_EQ(bumper_add_vehicle(responder, car.body, &parameters, nullptr, &vehicle), BUMPER_OK);
    EXPECT_EQ(bumper_add_vehicle(responder, other.body, &parameters, nullptr, &otherVehicle),
              BUMPER_OK);
    spare.place({0.0, 500.0, 0.55}, Eigen::Matrix3d::Identity());
    start();
  }
  ~CWorld() { EXPECT_EQ(bumper_destroy_responder(responder), BUMPER_OK) << bumper_last_error(); }
  CWorld(const CWorld&) = delete;
  CWorld& operator=(const CWorld&) = delete;
  CWorld(CWorld&&) = delete;
  CWorld& operator=(CWorld&&) = delete;

  void start() {
    for (BoxCar* each : {&car, &other}) {
      const bool isFirst = each == &car;
      each->place({isFirst ? 0.0 : -6.0, isFirst ? 0.0 : 0.4, 0.55}, Eigen::Matrix3d::Identity());
      each->move({isFirst ? 20.0 : 25.0, 0.0, 0.0}, {0.0, 0.0, 0.2});
    }
  }

  /// Gives the number of events.
  int step(double h = 0.005) {
    const int events = bumper_step(responder, h);
    dWorldQuickStep(ode.world, h);
    return events;
  }

  /// Until something is hit.
  void stepToImpact() {
    int events = 0;
    for (int i = 0; i < 400 && events == 0; ++i) events = step();
    ASSERT_GT(events, 0);
  }

  OdeWorld ode;
  BoxCar car{ode.world, ode.space};
  BoxCar other{ode.world, ode.space};
  BoxCar spare{ode.world};  ///< no vehicle yet
  CWall wall{8.0};
  bumper_responder responder{};
  bumper_barrier barrier{};
  bumper_vehicle vehicle{};
  bumper_vehicle otherVehicle{};
};

}  // namespace bumper::tests
