// ODE's own shapes as barriers, and settings by material.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

/// Drives at 15 m/s along x, with the mass centre at the given y and heading, until the first
/// impact.
ImpactEvent firstImpact(OdeWorld& ode, Responder& responder, double y, double heading = 0.0) {
  BoxCar car(ode.world);
  const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  car.place({-10.0, y, 0.55}, axes);
  car.move({15.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
  ImpactEvent found;
  for (int i = 0; i < 300 && found.vehicle.empty(); ++i) {
    for (const ImpactEvent& event : responder.step(h)) {
      if (found.vehicle.empty()) found = event;
    }
    dWorldQuickStep(ode.world, h);
  }
  responder.removeVehicle(vehicle);
  return found;
}

TEST(GeomBarriers, ABoxIsHitOnItsSides) {
  OdeWorld ode;
  const dGeomID box = dCreateBox(ode.space, 2.0, 6.0, 1.2);
  dGeomSetPosition(box, 1.0, 0.0, 0.6);
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(box, {.name = "block"});
  EXPECT_EQ(responder.geom(barrier), box);
  const ImpactEvent hit = firstImpact(ode, responder, 0.3);
  EXPECT_EQ(hit.barrier, "block");
  EXPECT_EQ(hit.triangle, -1);
  EXPECT_NEAR(hit.time, (10.0 - 2.1) / 15.0, 1e-9);
  EXPECT_NEAR((hit.normal - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
  // With one half of the front only: the contact lies in the middle of what overlaps.
  const ImpactEvent part = firstImpact(ode, responder, 3.0);
  EXPECT_NEAR(part.arm.x(), 2.1 - 0.0025 * 15.0, 1e-9);
  EXPECT_NEAR(part.arm.y(), -0.45, 1e-9);
}

TEST(GeomBarriers, APlaneIsAWallWithoutEnd) {
  OdeWorld ode;
  // Turned by 30°: the front left corner meets it.
  const double angle = 30.0 * std::numbers::pi / 180.0;
  const Eigen::Vector2d normal(-std::cos(angle), std::sin(angle));
  const dGeomID plane = dCreatePlane(ode.space, normal.x(), normal.y(), 0.0, 0.0);
  Responder responder(ode.world);
  responder.addBarrier(plane);
  for (const double y : {0.0, 3e3, -2e3}) {
    const double far = -normal.y() / normal.x() * y;  // where the plane is at this y
    BoxCar car(ode.world);
    const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
    car.place({far - 10.0, y, 0.55}, Eigen::Matrix3d::Identity());
    car.move({15.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
    double time = 0.0;
    const double start = responder.time();
    for (int i = 0; i < 300 && time == 0.0; ++i) {
      const auto events = responder.step(h);
      if (!events.empty()) {
        time = events[0].time - start;
        EXPECT_NEAR((events[0].normal.head<2>() - normal).norm(), 0.0, 1e-9);
      }
      dWorldQuickStep(ode.world, h);
    }
    // The corner that is further along −normal.
    const double reach = std::abs(normal.x()) * 2.1 + normal.y() * 0.9;
    EXPECT_NEAR(time, (10.0 - reach / std::abs(normal.x())) / 15.0, 1e-9) << y;
    responder.removeVehicle(vehicle);
  }
}

TEST(GeomBarriers, APostIsRound) {
  OdeWorld ode;
  constexpr double radius = 0.25;
  const dGeomID post = dCreateCylinder(ode.space, radius, 2.0);
  dGeomSetPosition(post, 0.0, 0.0, 1.0);
  Responder responder(ode.world);
  responder.addBarrier(post);
  // Within the front's width the side is hit, 0.1 m beside it the corner.
  const ImpactEvent side = firstImpact(ode, responder, 0.5);
  EXPECT_NEAR(side.time, (10.0 - 2.1 - radius) / 15.0, 1e-9);
  EXPECT_NEAR((side.normal - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(side.arm.y(), -0.5, 1e-9);
  const double start = responder.time();
  const ImpactEvent corner = firstImpact(ode, responder, 1.0);
  const double along = std::sqrt(radius * radius - 0.1 * 0.1);
  EXPECT_NEAR(corner.time - start, (10.0 - 2.1 - along) / 15.0, 1e-9);
  EXPECT_NEAR((corner.normal - Eigen::Vector3d(-along, 0.1, 0.0) / radius).norm(), 0.0, 1e-9);
  EXPECT_TRUE(firstImpact(ode, responder, 1.2).vehicle.empty());
}

TEST(GeomBarriers, AConvexIsItsShape) {
  OdeWorld ode;
  // A wedge that points at the car: two faces at ±45°.
  std::vector<dReal> planes = {-std::sqrt(0.5),
                               std::sqrt(0.5),
                               0.0,
                               0.0,
                               -std::sqrt(0.5),
                               -std::sqrt(0.5),
                               0.0,
                               0.0,
                               1.0,
                               0.0,
                               0.0,
                               2.0,
                               0.0,
                               0.0,
                               1.0,
                               1.0,
                               0.0,
                               0.0,
                               -1.0,
                               0.0};
  std::vector<dReal> points = {0, 0, 0, 2, 2, 0, 2, -2, 0, 0, 0, 1, 2, 2, 1, 2, -2, 1};
  std::vector<unsigned> polygons = {4, 0, 3, 4, 1, 4, 0, 2, 5, 3, 4, 1,
                                    4, 5, 2, 3, 3, 5, 4, 3, 0, 1, 2};
  const dGeomID convex =
      dCreateConvex(ode.space, planes.data(), 5, points.data(), 6, polygons.data());
  Scene shape = straightWall({0.0, 0.0}, {2.0, 2.0}, 1.0);
  const Scene other = straightWall({2.0, -2.0}, {0.0, 0.0}, 1.0);
  const auto first = static_cast<std::uint32_t>(shape.vertices.size());
  shape.vertices.insert(shape.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (Scene::Triangle triangle : other.triangles) {
    for (std::uint32_t& corner : triangle.corners) corner += first;
    shape.triangles.push_back(triangle);
  }
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(shape, {.geom = convex});
  EXPECT_EQ(responder.geom(barrier), convex);
  // The edge of the wedge meets the front: the front's normal.
  const ImpactEvent edge = firstImpact(ode, responder, 0.2);
  EXPECT_NEAR(edge.time, (10.0 - 2.1) / 15.0, 1e-9);
  EXPECT_NEAR((edge.normal - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
  // The corner meets a face.
  const ImpactEvent face = firstImpact(ode, responder, 1.5);
  EXPECT_NEAR((face.normal.head<2>() - Eigen::Vector2d(-std::sqrt(0.5), std::sqrt(0.5))).norm(),
              0.0, 1e-9);
  responder.removeBarrier(barrier);
  dGeomDestroy(convex);
}

// Contacts with the top of a block are ground for what drives on it, its sides are Bumper's.
TEST(GeomBarriers, ABlocksTopIsNotClaimed) {
  OdeWorld ode;
  const dGeomID block = dCreateBox(ode.space, 4.0, 4.0, 1.0);
  dGeomSetPosition(block, 0.0, 0.0, 0.5);
  Responder responder(ode.world);
  responder.addBarrier(block);
  BoxCar car(ode.world, ode.space);
  responder.addVehicle(car.body, car.parameters);
  std::array<dContact, 16> contacts{};
  const auto kept = [&](const Eigen::Vector3d& place) {
    car.place(place, Eigen::Matrix3d::Identity());
    EXPECT_FALSE(responder.claims(car.geom, block));
    const int count = dCollide(car.geom, block, 16, &contacts[0].geom, sizeof(dContact));
    EXPECT_GT(count, 0);
    return responder.keepUnclaimed(car.geom, block, contacts.data(), count);
  };
  EXPECT_GT(kept({0.0, 0.0, 1.34}), 0);
  EXPECT_EQ(kept({-2.0 - 2.1 + 0.05, 0.0, 0.55}), 0);
}

TEST(GeomBarriers, EachMaterialAnswersForItself) {
  OdeWorld ode;
  Scene scene = straightWall({0.0, -20.0}, {0.0, 20.0}, 1.0, 4, 1);
  scene.meshes[0].material = "concrete";
  scene.meshes.push_back({.name = "end", .material = "rubber", .colour = {0.1F, 0.1F, 0.1F}});
  // The upper half of the wall, y > 0.
  for (Scene::Triangle& triangle : scene.triangles) {
    double middle = 0.0;
    for (const std::uint32_t corner : triangle.corners) middle += scene.vertices[corner].y() / 3.0;
    if (middle > 0.0) triangle.mesh = 1;
  }
  ResponseSettings rubber;
  rubber.restitution = AngleCurve::constant(0.25);
  Responder responder(ode.world);
  responder.addBarrier(scene, {.materials = {{"rubber", rubber}}});
  const ImpactEvent hard = firstImpact(ode, responder, -5.0);
  EXPECT_EQ(hard.material, "concrete");
  EXPECT_NEAR(hard.restitution, 0.05, 1e-12);
  const ImpactEvent soft = firstImpact(ode, responder, 5.0);
  EXPECT_EQ(soft.material, "rubber");
  EXPECT_EQ(soft.restitution, 0.25);
}

}  // namespace
}  // namespace bumper::tests
