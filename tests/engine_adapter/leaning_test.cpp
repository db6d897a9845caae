// A car whose engine pushes it against a wall: the pushing comes through wheel joints and ground
// contacts, of which nothing is known when a step is answered.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "hinge2_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Lean {
  double heading;  // deg against the wall
  double start;    // m from the wall
  double step;     // s
  double most;     // m of penetration
};

void PrintTo(const Lean& lean, std::ostream* out) {
  *out << lean.heading << "° at " << 1e3 * lean.step << " ms";
}

Scene wallOnGround() {
  Scene scene = straightWall({-300.0, 0.0}, {300.0, 0.0}, 1.0, 60, 1);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(
      scene.vertices.end(),
      {{-300.0, -20.0, 0.0}, {300.0, -20.0, 0.0}, {300.0, 20.0, 0.0}, {-300.0, 20.0, 0.0}});
  scene.triangles.push_back({.corners = {first, first + 1, first + 2}, .mesh = 0});
  scene.triangles.push_back({.corners = {first, first + 2, first + 3}, .mesh = 0});
  return scene;
}

class Leaning : public ::testing::TestWithParam<Lean> {};

TEST_P(Leaning, DoesNotSinkIn) {
  const Lean lean = GetParam();
  OdeWorld ode(9.81);
  const OdeMesh mesh(ode.space, wallOnGround());
  Responder responder(ode.world);
  responder.addBarrier(mesh.geom);
  Hinge2Car car(ode.world, ode.space, {0.0, lean.start}, 0.0, -lean.heading * degree, 0.0);
  responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});

  std::size_t events = 0;
  double deepest = 0.0;
  bool touched = false;
  const int steps = static_cast<int>(20.0 / lean.step);
  for (int i = 0; i < steps; ++i) {
    car.drive(8.0, 200.0);
    ode.step(lean.step, &responder, [&] { events += responder.step(lean.step).size(); });
    const dReal* r = dBodyGetRotation(car.chassis);
    const double reach =
        std::abs(r[4]) * Hinge2Car::front + std::abs(r[5]) * 0.5 * Hinge2Car::width;
    const double depth = reach - dBodyGetPosition(car.chassis)[1];
    touched = touched || depth > 0.0;
    deepest = std::max(deepest, depth);
  }
  EXPECT_TRUE(touched);
  EXPECT_LE(deepest, lean.most);
  EXPECT_LE(events, 10U);
}

// One step's way at the speed of arrival, then no more: without foresight the car sinks in by 8 to
// 30 mm in every second.
INSTANTIATE_TEST_SUITE_P(Steps, Leaning,
                         ::testing::Values(Lean{10.0, 1.35, 0.005, 0.002},
                                           Lean{90.0, 2.2, 0.005, 0.005},
                                           Lean{90.0, 2.2, 0.02, 0.02}),
                         [](const auto& each) {
                           return std::to_string(std::lround(each.param.heading)) + "deg" +
                                  std::to_string(std::lround(1e3 * each.param.step)) + "ms";
                         });

}  // namespace
}  // namespace bumper::tests
