// The same wall, however it comes: in one piece or many, slightly bent, as two barriers, far away.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double h = 0.005;
constexpr double sixtyMph = 26.8224;

// Yaw rate and speed away from the wall after a head-on hit at 60 mph; the wall stands along y at
// `at.x()`, and the car's middle is at `at.y()`.
struct HeadOn {
  double yawRate;  // rad/s
  double rebound;  // m/s
};

HeadOn hit(OdeWorld& ode, Responder& responder, const Eigen::Vector2d& at, double heading = 0.0) {
  BoxCar car(ode.world);
  const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  car.place({at.x() - 2.15, at.y(), 0.55}, axes);
  car.move(sixtyMph * axes.col(0), Eigen::Vector3d::Zero());
  EXPECT_FALSE(responder.step(h).empty());
  dWorldQuickStep(ode.world, h);
  const HeadOn result{responder.yawRate(vehicle), -responder.velocity(vehicle).x()};
  responder.removeVehicle(vehicle);
  return result;
}

Scene flatWall(std::size_t panels, std::size_t rows) {
  return straightWall({0.0, -20.0}, {0.0, 20.0}, 1.0, panels, rows);
}

HeadOn reference() {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(flatWall(1, 1));
  return hit(ode, responder, {0.0, 0.3});
}

TEST(SameWall, AFlatWallGivesNoYaw) {
  const HeadOn flush = reference();
  EXPECT_NEAR(flush.yawRate, 0.0, 1e-9);
  EXPECT_NEAR(flush.rebound, 0.05 * sixtyMph, 1e-9);
}

TEST(SameWall, InManyPieces) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(flatWall(153, 4));
  const HeadOn flush = hit(ode, responder, {0.0, 0.3});
  EXPECT_NEAR(flush.yawRate, 0.0, 1e-9);
  EXPECT_NEAR(flush.rebound, reference().rebound, 1e-9);
}

TEST(SameWall, AsTwoBarriers) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(straightWall({0.0, -20.0}, {0.0, 0.1}, 1.0, 5, 1));
  responder.addBarrier(straightWall({0.0, 0.1}, {0.0, 20.0}, 1.0, 5, 1));
  const HeadOn flush = hit(ode, responder, {0.0, 0.3});
  EXPECT_NEAR(flush.yawRate, 0.0, 1e-9);
  EXPECT_NEAR(flush.rebound, reference().rebound, 1e-9);
}

// An application's mesh has ODE's single precision: 0.1 mm at 3 km.
TEST(SameWall, FarFromTheOriginAsTheApplicationsMesh) {
  for (const double away : {300.0, 1000.0, 3000.0}) {
    OdeWorld ode;
    Scene scene = flatWall(40, 4);
    for (Eigen::Vector3d& vertex : scene.vertices) vertex += Eigen::Vector3d(away, 0.7 * away, 0.0);
    const OdeMesh mesh(ode.space, scene);
    Responder responder(ode.world);
    responder.addBarrier(mesh.geom);
    const HeadOn flush = hit(ode, responder, {away, 0.7 * away + 0.3});
    EXPECT_LT(std::abs(flush.yawRate), 2.0 * degree) << away;
    EXPECT_NEAR(flush.rebound, reference().rebound, 0.05) << away;
  }
}

// Two panels with a bend between them, at the car's middle or off it: no jump as the bend grows.
// The car is 0.2° off flush: a side that is exactly flush leaves a line of interference all at
// once.
TEST(SameWall, SlightlyBent) {
  for (const double joint : {0.3, 0.5, -0.2}) {
    for (const double sign : {1.0, -1.0}) {
      double last = 0.0;
      for (int i = 0; i <= 300; ++i) {
        const double bend = sign * 0.01 * i * degree;
        OdeWorld ode;
        Responder responder(ode.world);
        responder.addBarrier(straightWall({0.0, -20.0}, {0.0, joint}, 1.0, 5, 1));
        const Eigen::Vector2d end(20.0 * std::sin(bend), joint + 20.0 * std::cos(bend));
        responder.addBarrier(straightWall({0.0, joint}, end, 1.0, 5, 1));
        const double yawRate = hit(ode, responder, {0.0, 0.3}, 0.2 * degree).yawRate / degree;
        // Without hitting the panels as one the sign was rounding's: jumps of 200 to 480 °/s. What
        // is left is where the panel that is touched first changes.
        EXPECT_LE(std::abs(yawRate - last), 45.0) << joint << " m, " << sign * 0.01 * i << "°";
        last = yawRate;
      }
    }
  }
}

// A wall that leans is met where it stands out furthest within the band.
TEST(SameWall, LeaningIsMetAtItsForemostLine) {
  for (const double lean : {-0.25, 0.25}) {
    OdeWorld ode;
    Scene scene = flatWall(5, 1);
    for (Eigen::Vector3d& vertex : scene.vertices) vertex.x() += lean * vertex.z();
    Responder responder(ode.world);
    responder.addBarrier(scene);
    BoxCar car(ode.world);
    responder.addVehicle(car.body, car.parameters);
    // The band reaches from 0.275 to 0.75 m.
    const double foremost = lean * (lean < 0.0 ? 0.75 : 0.275);
    car.move({5.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
    car.place({foremost - 2.1 - 0.02, 0.0, 0.55}, Eigen::Matrix3d::Identity());
    const auto events = responder.step(h);
    ASSERT_EQ(events.size(), 1U) << lean;
    EXPECT_NEAR(events[0].time, 0.02 / 5.0, 1e-12) << lean;
  }
}

// The smaller root of Eq. 32: through the first wall with the energy asked for, and on to the next.
TEST(SameWall, BreakThrough) {
  OdeWorld ode;
  Responder responder(ode.world);
  ResponseSettings breaks;
  breaks.law = Law::energy;
  breaks.energyRoot = EnergyRoot::break_through;
  breaks.energyRemaining = AngleCurve::constant(0.6);
  responder.addBarrier(flatWall(10, 2), {.name = "fence", .response = breaks});
  responder.addBarrier(straightWall({20.0, -20.0}, {20.0, 20.0}, 1.0, 3, 1), {.name = "wall"});
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  car.place({-6.0, 0.3, 0.55}, Eigen::Matrix3d::Identity());
  car.move({sixtyMph, 0.0, 0.0}, Eigen::Vector3d::Zero());
  std::vector<std::string> hits;
  double ratio = 0.0;
  for (int i = 0; i < 400; ++i) {
    for (const ImpactEvent& event : responder.step(h)) {
      hits.emplace_back(event.barrier);
      if (event.barrier == "fence") ratio = event.energyRatio;
    }
    dWorldQuickStep(ode.world, h);
  }
  EXPECT_EQ(hits, (std::vector<std::string>{"fence", "wall"}));
  EXPECT_NEAR(ratio, 0.6, 1e-12);
  EXPECT_LT(car.velocity().x(), 0.0);
}

// A panel's triangles are hit as one; the event tells the one at the contact.
TEST(SameWall, TheTriangleThatIsTold) {
  const Scene scene = flatWall(2, 1);
  std::set<int> told;
  for (double y = -19.0; y <= 19.0; y += 1.9) {
    OdeWorld ode;
    Responder responder(ode.world);
    responder.addBarrier(scene);
    BoxCar car(ode.world);
    responder.addVehicle(car.body, car.parameters);
    // Nose on, but for the angle that makes the contact a corner's.
    const Eigen::Matrix3d axes =
        Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    car.place({-2.4, y, 0.55}, axes);
    car.move(sixtyMph * Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero());
    std::vector<ImpactEvent> hits;
    for (int i = 0; i < 5 && hits.empty(); ++i) {
      for (const ImpactEvent& event : responder.step(h)) hits.push_back(event);
      dWorldQuickStep(ode.world, h);
    }
    ASSERT_FALSE(hits.empty()) << y;
    const ImpactEvent& hit = hits.front();
    told.insert(hit.triangle);
    const Scene::Triangle& triangle = scene.triangles.at(static_cast<std::size_t>(hit.triangle));
    // On one side of all three sides, seen along the wall's normal.
    double least = 1.0;
    double most = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d from = scene.corner(triangle, k);
      const Eigen::Vector3d side = scene.corner(triangle, (k + 1) % 3) - from;
      const double turn = side.cross(Eigen::Vector3d(hit.contact - from)).x();
      least = std::min(least, turn);
      most = std::max(most, turn);
    }
    EXPECT_TRUE(least >= -1e-9 || most <= 1e-9) << y << ": triangle " << hit.triangle;
  }
  EXPECT_EQ(told.size(), 4U);
}

}  // namespace
}  // namespace bumper::tests
