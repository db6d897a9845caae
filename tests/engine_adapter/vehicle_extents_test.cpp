// What a vehicle's geoms take up, against closed forms and against points on their surfaces.

#include "vehicle_extents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "bumper/engine_adapter/vehicle.h"
#include "bumper/response/error.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;

// A body anywhere, whose mass centre is the vehicle's; geoms are placed in its axes.
class Body {
 public:
  Body() : body(dBodyCreate(ode.world)) {
    const Eigen::Quaterniond q(
        Eigen::AngleAxisd(2.0, Eigen::Vector3d(0.2, -0.3, 1.0).normalized()));
    const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
    dBodySetQuaternion(body, turn);
    dBodySetPosition(body, 20.0, -30.0, 4.0);
  }
  void put(dGeomID geom, const Eigen::Vector3d& place,
           const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) const {
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, place.x(), place.y(), place.z());
    const dQuaternion q = {turn.w(), turn.x(), turn.y(), turn.z()};
    dGeomSetOffsetQuaternion(geom, q);
  }
  [[nodiscard]] VehicleExtents extents(const Heights& heights = {}) const {
    const VehicleBodies bodies({body});
    return extentsOf(bodies.all(), bodies.readPose(), heights).value();
  }

  OdeWorld ode;
  dBodyID body;
};

void expectExtents(const VehicleExtents& actual, const VehicleExtents& expected, double tolerance) {
  EXPECT_NEAR(actual.front, expected.front, tolerance);
  EXPECT_NEAR(actual.rear, expected.rear, tolerance);
  EXPECT_NEAR(actual.left, expected.left, tolerance);
  EXPECT_NEAR(actual.right, expected.right, tolerance);
  EXPECT_NEAR(actual.lowest, expected.lowest, tolerance);
  EXPECT_NEAR(actual.highest, expected.highest, tolerance);
}

TEST(VehicleExtents, OfABox) {
  const Body car;
  car.put(dCreateBox(car.ode.space, 4.0, 1.8, 0.6), {-0.2, 0.1, 0.3});
  expectExtents(
      car.extents(),
      {.front = 1.8, .rear = 2.2, .left = 1.0, .right = 0.8, .lowest = 0.0, .highest = 0.6}, 1e-12);
  expectExtents(
      car.extents({.low = 0.1, .high = 0.2}),
      {.front = 1.8, .rear = 2.2, .left = 1.0, .right = 0.8, .lowest = 0.1, .highest = 0.2}, 1e-12);
  const VehicleBodies bodies({car.body});
  EXPECT_FALSE(extentsOf(bodies.all(), bodies.readPose(), {.low = 0.7, .high = 0.9}).has_value());
}

// A wheel whose hub lies 0.2 m below the band: half a chord of its disc is seen.
TEST(VehicleExtents, OfAWheelAboveItsHub) {
  const Body car;
  const double radius = 0.33;
  car.put(dCreateCylinder(car.ode.space, radius, 0.2), {1.3, 0.8, -0.4},
          Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * pi, Eigen::Vector3d::UnitX())));
  expectExtents(car.extents(),
                {.front = 1.3 + radius,
                 .rear = -1.3 + radius,
                 .left = 0.9,
                 .right = -0.7,
                 .lowest = -0.4 - radius,
                 .highest = -0.4 + radius},
                1e-12);
  const double chord = std::sqrt(radius * radius - 0.2 * 0.2);
  expectExtents(car.extents({.low = -0.2, .high = 0.5}),
                {.front = 1.3 + chord,
                 .rear = -1.3 + chord,
                 .left = 0.9,
                 .right = -0.7,
                 .lowest = -0.2,
                 .highest = -0.4 + radius},
                1e-9);
}

TEST(VehicleExtents, OfASphereBetweenHeights) {
  const Body car;
  car.put(dCreateSphere(car.ode.space, 0.5), {1.0, 0.0, 0.0});
  const double round = std::sqrt(0.25 - 0.09);
  expectExtents(car.extents({.low = 0.3, .high = 0.4}),
                {.front = 1.0 + round,
                 .rear = -1.0 + round,
                 .left = round,
                 .right = round,
                 .lowest = 0.3,
                 .highest = 0.4},
                1e-9);
}

// The four ways out are the largest coordinates of points all over the surface, however it lies and
// wherever it is cut: never less than any of them, and as much as the best but for their spacing.
class OfAnything : public ::testing::Test {
 public:
  using Surface = std::function<Eigen::Vector3d(double, double)>;  // of two numbers in [0, 1]

  static void check(const std::function<dGeomID(dSpaceID)>& make, const Surface& surface) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int trial = 0; trial < 6; ++trial) {
      const Body car;
      const Eigen::Vector3d place(any(random), any(random), 0.3 * any(random));
      const Eigen::Quaterniond turn =
          Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
      car.put(make(car.ode.space), place, turn);
      const Heights heights{.low = place.z() - 0.15, .high = place.z() + 0.1 * trial};
      for (const bool cut : {false, true}) {
        VehicleExtents points;
        constexpr int many = 500;
        for (int i = 0; i <= many; ++i) {
          for (int k = 0; k <= many; ++k) {
            const Eigen::Vector3d p = place + turn * surface(static_cast<double>(i) / many,
                                                             static_cast<double>(k) / many);
            if (cut && (p.z() < heights.low || p.z() > heights.high)) continue;
            points.front = std::max(points.front, p.x());
            points.rear = std::max(points.rear, -p.x());
            points.left = std::max(points.left, p.y());
            points.right = std::max(points.right, -p.y());
          }
        }
        const VehicleExtents found = car.extents(cut ? heights : Heights{});
        for (const auto side : {&VehicleExtents::front, &VehicleExtents::rear,
                                &VehicleExtents::left, &VehicleExtents::right}) {
          EXPECT_GE(found.*side, points.*side - 1e-6) << trial << cut;
          EXPECT_LE(found.*side, points.*side + 0.006) << trial << cut;
        }
      }
    }
  }
};

TEST_F(OfAnything, Capsule) {
  check([](dSpaceID space) { return dCreateCapsule(space, 0.3, 0.8); },
        [](double u, double v) {
          // Down one cap, the side, and the other cap.
          const double way = 3.0 * u;
          const double turn = 0.5 * pi * (std::min(way, 1.0) + std::max(way - 2.0, 0.0));
          const double radius = 0.3 * std::sin(turn);
          const double along = 0.3 * std::cos(turn) + 0.8 * std::clamp(1.5 - way, -0.5, 0.5);
          return Eigen::Vector3d(radius * std::cos(2.0 * pi * v), radius * std::sin(2.0 * pi * v),
                                 along);
        });
}

TEST_F(OfAnything, Cylinder) {
  check([](dSpaceID space) { return dCreateCylinder(space, 0.35, 0.6); },
        [](double u, double v) {
          // Up the axis, along a cap, down the side, and back along the other cap.
          const double way = 3.0 * u;
          const double radius = 0.35 * std::min({1.0, way, 3.0 - way});
          const double along = 0.6 * std::clamp(1.5 - way, -0.5, 0.5);
          return Eigen::Vector3d(radius * std::cos(2.0 * pi * v), radius * std::sin(2.0 * pi * v),
                                 along);
        });
}

// A tetrahedron, as ODE's convex and as a trimesh of its four faces.
const dReal corners[] = {0.6, 0.0, -0.3, -0.4, 0.5, -0.3, -0.4, -0.5, -0.2, 0.0, 0.1, 0.6};
const unsigned polygons[] = {3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3, 3, 2, 1, 0};
const dTriIndex faces[] = {0, 1, 3, 1, 2, 3, 2, 0, 3, 2, 1, 0};

Eigen::Vector3d corner(std::size_t k) { return Eigen::Map<const Eigen::Vector3d>(corners + 3 * k); }

// All four faces one after the other.
Eigen::Vector3d onTetrahedron(double u, double v) {
  const auto face = static_cast<std::size_t>(std::min(3.0, std::floor(4.0 * v)));
  const double w = 4.0 * v - static_cast<double>(face);
  const Eigen::Vector3d a = corner(faces[3 * face]);
  const Eigen::Vector3d b = corner(faces[3 * face + 1]);
  const Eigen::Vector3d c = corner(faces[3 * face + 2]);
  return (1.0 - w) * ((1.0 - u) * a + u * b) + w * c;
}

TEST_F(OfAnything, Convex) {
  // Its planes are asked for nothing here.
  static const dReal planes[16] = {1.0, 0, 0, 1.0, 1.0, 0, 0, 1.0, 1.0, 0, 0, 1.0, 1.0, 0, 0, 1.0};
  check([](dSpaceID space) { return dCreateConvex(space, planes, 4, corners, 4, polygons); },
        &onTetrahedron);
}

TEST_F(OfAnything, Trimesh) {
  const dTriMeshDataID data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(data, corners, 3 * sizeof(double), 4, faces, 12,
                              3 * sizeof(dTriIndex));
  check([&](dSpaceID space) { return dCreateTriMesh(space, data, nullptr, nullptr, nullptr); },
        &onTetrahedron);
  dGeomTriMeshDataDestroy(data);
}

// More corners than fit into the first list of contacts.
TEST(VehicleExtents, OfAConvexOfManyCorners) {
  const Body car;
  std::vector<dReal> ring;
  for (int i = 0; i < 3000; ++i) {
    const double angle = 2.0 * pi * i / 3000.0;
    ring.insert(ring.end(), {std::cos(angle), 0.5 * std::sin(angle), i % 2 == 0 ? 0.2 : -0.2});
  }
  static const dReal plane[] = {0.0, 0.0, 1.0, 0.2};
  static const unsigned polygon[] = {3, 0, 2, 4};
  car.put(dCreateConvex(car.ode.space, plane, 1, ring.data(), 3000, polygon), {0.0, 0.0, 0.0});
  expectExtents(
      car.extents(),
      {.front = 1.0, .rear = 1.0, .left = 0.5, .right = 0.5, .lowest = -0.2, .highest = 0.2}, 1e-5);
  dGeomDestroy(dBodyGetFirstGeom(car.body));
}

TEST(VehicleExtents, WhatHitsNothingIsLeftOut) {
  const Body car;
  const dGeomID sensor = dCreateSphere(car.ode.space, 9.0);
  dGeomSetCategoryBits(sensor, 0);
  dGeomSetCollideBits(sensor, 0);
  car.put(sensor, {0.0, 0.0, 0.0});
  car.put(dCreateRay(car.ode.space, 50.0), {0.0, 0.0, 0.0});
  const VehicleBodies bodies({car.body});
  EXPECT_FALSE(extentsOf(bodies.all(), bodies.readPose()).has_value());
  car.put(dCreateSphere(car.ode.space, 1.0), {0.0, 0.0, 0.0});
  EXPECT_NEAR(car.extents().front, 1.0, 1e-12);
}

TEST(ParametersFromGeoms, EncloseWheelsAndChassis) {
  OdeWorld ode;
  const dBodyID chassis = dBodyCreate(ode.world);
  const dBodyID wheel = dBodyCreate(ode.world);
  dMass mass;
  dMassSetBoxTotal(&mass, 900.0, 4.0, 1.6, 0.5);
  dBodySetMass(chassis, &mass);
  dMassSetSphereTotal(&mass, 100.0, 0.3);
  dBodySetMass(wheel, &mass);
  dGeomSetBody(dCreateBox(ode.space, 4.0, 1.6, 0.5), chassis);
  dGeomSetBody(dCreateSphere(ode.space, 0.3), wheel);
  dBodySetPosition(chassis, 10.0, 0.0, 1.0);
  dBodySetPosition(wheel, 11.0, 0.8, 1.0);
  const dBodyID wheels[] = {wheel};
  const VehicleParameters found = parametersFromGeoms(chassis, wheels, 0.5);
  // The common mass centre is at (10.1, 0.08).
  EXPECT_NEAR(found.mass, 1000.0, 1e-9);
  EXPECT_NEAR(found.massCentreToFront, 1.9, 1e-12);
  EXPECT_NEAR(found.massCentreToRear, 2.1, 1e-12);
  EXPECT_NEAR(found.width, 2.0 * (1.1 - 0.08), 1e-12);
  EXPECT_EQ(found.massCentreHeight, 0.5);
  EXPECT_EQ(found.yawInertia, parametersFromBodies(chassis, wheels, 1.0, 1.0, 1.0, 0.5).yawInertia);
}

TEST(ParametersFromGeoms, NameWhatIsWrong) {
  OdeWorld ode;
  const dBodyID body = dBodyCreate(ode.world);
  const auto message = [&] {
    try {
      (void)parametersFromGeoms(body, {}, 0.5);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(), ::testing::HasSubstr("have no geom"));
  const dGeomID ray = dCreateRay(ode.space, 1.0);
  dGeomSetBody(ray, body);
  EXPECT_THAT(message(), ::testing::HasSubstr("a ray"));
  const dGeomID ahead = dCreateSphere(ode.space, 0.5);
  dGeomSetBody(ahead, body);
  dGeomSetOffsetPosition(ahead, 0.75, 0.0, 0.0);
  EXPECT_THAT(message(), ::testing::HasSubstr("0.25 m before the mass centre at the rear"));
  const dBodyID none[] = {nullptr};
  EXPECT_THROW((void)parametersFromGeoms(body, none, 0.5), Error);
}

}  // namespace
}  // namespace bumper::tests
