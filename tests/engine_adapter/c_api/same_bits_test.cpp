// The same drive through the C interface, by a program in C99, and through the C++ one.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/presets.h"
#include "c_drive.h"
#include "hinge2_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;
constexpr int steps = 500;

// All that is told of a drive, numbers as their bits.
struct Told {
  std::vector<std::uint64_t> numbers;
  std::vector<std::string> words;

  void add(double value) { numbers.push_back(std::bit_cast<std::uint64_t>(value)); }
  template <typename Vector>
  void add(const Vector& vector, int count) {
    for (int i = 0; i < count; ++i) add(vector[i]);
  }
  bool operator==(const Told&) const = default;
};

void tell(Told& told, const bumper_motion& motion) {
  told.add(motion.position, 3);
  told.add(motion.orientation, 4);
  told.add(motion.velocity, 3);
  told.add(motion.yaw_rate);
}

void tell(Told& told, const Responder& responder, VehicleId vehicle) {
  told.add(responder.position(vehicle), 3);
  const Eigen::Quaterniond q = responder.orientation(vehicle);
  told.add(std::array{q.w(), q.x(), q.y(), q.z()}, 4);
  told.add(responder.velocity(vehicle), 3);
  told.add(responder.yawRate(vehicle));
}

void tell(Told& told, const bumper_event& e) {
  for (const char* word :
       {e.vehicle, e.barrier, e.other_vehicle, e.material, bumper_phase_word(e.phase),
        bumper_law_word(e.law), bumper_outcome_word(e.outcome), bumper_regime_word(e.regime)}) {
    told.words.emplace_back(word);
  }
  told.add(e.triangle);
  told.add(e.contact, 3);
  told.add(e.normal, 3);
  told.add(e.arm, 2);
  told.add(e.other_arm, 2);
  told.add(e.other_velocity_before, 3);
  told.add(e.other_velocity_after, 3);
  told.add(e.velocity_after, 3);
  for (const double number : {e.time,
                              e.other_yaw_rate_before,
                              e.other_yaw_rate_after,
                              e.angle_contact_velocity,
                              e.angle_centre_velocity,
                              e.angle_heading,
                              e.approach_speed,
                              e.restitution,
                              e.friction,
                              e.impulse_normal,
                              e.impulse_tangent,
                              e.impulse_ratio,
                              e.critical_impulse_ratio,
                              e.delta_v,
                              e.yaw_rate_before,
                              e.yaw_rate_after,
                              e.speed_before,
                              e.speed_after,
                              e.energy_asked,
                              e.energy_ratio,
                              e.energy_lost,
                              e.duration}) {
    told.add(number);
  }
}

void tell(Told& told, const ImpactEvent& e) {
  for (const std::string_view word :
       {e.vehicle, e.barrier, e.otherVehicle, e.material, toString(e.phase), toString(e.law),
        toString(e.outcome), toString(e.regime)}) {
    told.words.emplace_back(word);
  }
  told.add(e.triangle);
  told.add(e.contact, 3);
  told.add(e.normal, 3);
  told.add(e.arm, 2);
  told.add(e.otherArm, 2);
  told.add(e.otherVelocityBefore, 3);
  told.add(e.otherVelocityAfter, 3);
  told.add(e.velocityAfter, 3);
  for (const double number : {e.time,
                              e.otherYawRateBefore,
                              e.otherYawRateAfter,
                              e.angles.contactVelocity,
                              e.angles.centreVelocity,
                              e.angles.heading,
                              e.approachSpeed,
                              e.restitution,
                              e.friction,
                              e.impulseNormal,
                              e.impulseTangent,
                              e.impulseRatio,
                              e.criticalImpulseRatio,
                              e.deltaV,
                              e.yawRateBefore,
                              e.yawRateAfter,
                              e.speedBefore,
                              e.speedAfter,
                              e.energyAsked,
                              e.energyRatio,
                              e.energyLost,
                              e.duration}) {
    told.add(number);
  }
}

// A rail along the road, a wall at its end, and a post: one car scrapes along all, the other one
// runs into it.
struct Road {
  Road() {
    dGeomSetPosition(post, 34.0, 2.2, 0.5);
    scene.name = "walls";
    scene.meshes = {{.name = "rail", .material = "steel"}, {.name = "end", .material = "concrete"}};
    scene.vertices = {{0, 3, 0}, {0, 3, 1}, {45, 3, 0}, {45, 3, 1}, {45, -10, 0}, {45, -10, 1}};
    scene.triangles = {{.corners = {0, 2, 3}, .mesh = 0},
                       {.corners = {0, 3, 1}, .mesh = 0},
                       {.corners = {2, 4, 5}, .mesh = 1},
                       {.corners = {2, 5, 3}, .mesh = 1}};
  }
  ~Road() {
    dGeomDestroy(post);
    dGeomDestroy(ground);
  }
  Road(const Road&) = delete;
  Road& operator=(const Road&) = delete;
  Road(Road&&) = delete;
  Road& operator=(Road&&) = delete;

  OdeWorld ode{9.81};
  dGeomID ground = dCreatePlane(ode.space, 0, 0, 1, 0);
  dGeomID post = dCreateBox(ode.space, 0.3, 0.3, 1.0);
  std::array<std::unique_ptr<Hinge2Car>, c_drive_cars> cars{
      std::make_unique<Hinge2Car>(ode.world, ode.space, Eigen::Vector2d{6.0, 0.0}, 0.0, 0.15, 18.0),
      std::make_unique<Hinge2Car>(ode.world, ode.space, Eigen::Vector2d{-2.0, -1.0}, 0.0, 0.1,
                                  25.0)};
  Scene scene;
};

Told inCpp() {
  Road road;
  Responder responder(road.ode.world,
                      {.response = modernCarSettings(),
                       .vehicleResponse = {.restitutionKind = RestitutionKind::kudlich_slibar}});
  ResponseSettings steel;
  steel.restitution = AngleCurve::table({{0.1, 0.25}, {0.8, 0.1}});
  steel.friction = AngleCurve::cosine(0.2, 0.0);
  responder.addBarrier(road.scene, {.space = road.ode.space, .materials = {{"steel", steel}}});
  responder.addBarrier(road.post, {.name = "post", .response = macmillanSettings()});
  std::array<VehicleId, c_drive_cars> vehicles;
  const std::array names{"first", "second"};
  for (std::size_t i = 0; i < c_drive_cars; ++i) {
    const Hinge2Car& car = *road.cars[i];
    vehicles[i] = responder.addVehicle(car.chassis, car.parameters(),
                                       {.name = names[i], .linkedBodies = car.wheels});
  }
  Told told;
  for (int step = 0; step < steps; ++step) {
    road.ode.step(h, &responder, [&] {
      for (const ImpactEvent& event : responder.step(h)) tell(told, event);
    });
    for (const VehicleId vehicle : vehicles) tell(told, responder, vehicle);
  }
  return told;
}

Told inC() {
  const Road road;
  std::vector<double> vertices;
  for (const Eigen::Vector3d& v : road.scene.vertices) {
    vertices.insert(vertices.end(), {v.x(), v.y(), v.z()});
  }
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> meshes;
  for (const Scene::Triangle& t : road.scene.triangles) {
    triangles.insert(triangles.end(), t.corners.begin(), t.corners.end());
    meshes.push_back(t.mesh);
  }
  c_drive_setup setup{};
  setup.world = road.ode.world;
  setup.space = road.ode.space;
  setup.joints = road.ode.joints;
  setup.post = road.post;
  setup.vertices = vertices.data();
  setup.vertex_count = road.scene.vertices.size();
  setup.triangles = triangles.data();
  setup.triangle_meshes = meshes.data();
  setup.triangle_count = road.scene.triangles.size();
  setup.h = h;
  setup.steps = steps;
  for (std::size_t i = 0; i < c_drive_cars; ++i) {
    const Hinge2Car& car = *road.cars[i];
    const VehicleParameters parameters = car.parameters();
    setup.chassis[i] = car.chassis;
    for (std::size_t k = 0; k < c_drive_wheels; ++k) setup.wheels[i][k] = car.wheels[k];
    setup.outline[i][0] = parameters.massCentreToFront;
    setup.outline[i][1] = parameters.massCentreToRear;
    setup.outline[i][2] = parameters.width;
    setup.outline[i][3] = parameters.massCentreHeight;
  }
  Told told;
  const c_drive_listener listener{
      .data = &told,
      .motion = [](void* data,
                   const bumper_motion* motion) { tell(*static_cast<Told*>(data), *motion); },
      .event = [](void* data,
                  const bumper_event* event) { tell(*static_cast<Told*>(data), *event); }};
  EXPECT_EQ(c_drive(&setup, &listener), BUMPER_OK) << bumper_last_error();
  return told;
}

bool isAmong(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

TEST(CInterface, GivesTheSameBitsAsCpp) {
  const Told cpp = inCpp();
  const Told c = inC();
  EXPECT_EQ(c.words, cpp.words);
  EXPECT_TRUE(c == cpp);
  // Something happened with everything.
  for (const char* word : {"walls", "post", "first", "second", "steel", "contact_begin"}) {
    EXPECT_TRUE(isAmong(word, cpp.words)) << word;
  }
}

}  // namespace
}  // namespace bumper::tests
