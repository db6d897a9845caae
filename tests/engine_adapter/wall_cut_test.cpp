// Where the outline is cut: against the analytic intersection of a rectangle with a line, and
// beside it what ODE's own contacts say of the same poses.

#include <gtest/gtest.h>

#include <algorithm>
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

constexpr double degree = std::numbers::pi / 180.0;

struct Pose {
  double heading;  // against the wall, rad
  double depth;    // of the deepest corner, m
};

std::vector<Pose> poses() {
  std::vector<Pose> result;
  for (const double heading : {1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0,
                               85.0, 88.0, 89.0, 90.0}) {
    for (const double depth : {0.001, 0.003, 0.01, 0.03, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6}) {
      result.push_back({heading * degree, depth});
    }
  }
  return result;
}

// The wall stands along a direction that no axis of the world has, so that nothing is exact by
// luck. The car comes from its left.
struct TestWall {
  double yaw = 0.37;
  Eigen::Vector2d along{std::cos(0.37), std::sin(0.37)};
  Eigen::Vector2d normal{-std::sin(0.37), std::cos(0.37)};
  Eigen::Vector2d start{12.3, -4.5};
  double length = 60.0;

  [[nodiscard]] Scene scene(std::size_t panels, std::size_t rows) const {
    return straightWall(start, start + length * along, 1.0, panels, rows);
  }
};

std::array<Eigen::Vector2d, 4> cornersOf(const VehicleParameters& car, const Eigen::Vector2d& place,
                                         double yaw) {
  const Eigen::Vector2d forward(std::cos(yaw), std::sin(yaw));
  const Eigen::Vector2d left(-forward.y(), forward.x());
  const double side = 0.5 * car.width;
  return {place + car.massCentreToFront * forward + side * left,
          place - car.massCentreToRear * forward + side * left,
          place - car.massCentreToRear * forward - side * left,
          place + car.massCentreToFront * forward - side * left};
}

// The mass centre that puts the deepest corner `depth` behind the wall, 31.4159 m along it.
Eigen::Vector2d placeFor(const TestWall& wall, const VehicleParameters& car, const Pose& pose) {
  const double yaw = wall.yaw - pose.heading;
  double lowest = 1e9;
  for (const Eigen::Vector2d& corner : cornersOf(car, Eigen::Vector2d::Zero(), yaw)) {
    lowest = std::min(lowest, corner.dot(wall.normal));
  }
  return wall.start + 31.4159 * wall.along + (-pose.depth - lowest) * wall.normal;
}

// The middle of the part of the wall's line inside the rectangle: each edge of the rectangle
// against the line, by the parameter along the line.
Eigen::Vector2d middleOfInterference(const TestWall& wall,
                                     const std::array<Eigen::Vector2d, 4>& corners) {
  double first = 1e9;
  double last = -1e9;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d a = corners[k] - wall.start;
    const Eigen::Vector2d b = corners[(k + 1) % 4] - wall.start;
    const double ya = a.dot(wall.normal);
    const double yb = b.dot(wall.normal);
    if ((ya > 0.0) == (yb > 0.0)) continue;
    const double place = (a.dot(wall.along) * yb - b.dot(wall.along) * ya) / (yb - ya);
    first = std::min(first, place);
    last = std::max(last, place);
  }
  return wall.start + 0.5 * (first + last) * wall.along;
}

Eigen::Matrix3d turned(double yaw) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

class WallCut : public ::testing::TestWithParam<std::pair<std::size_t, std::size_t>> {};

TEST_P(WallCut, PointAndNormalAreExact) {
  const auto [panels, rows] = GetParam();
  const TestWall wall;
  OdeWorld ode;
  ResponderOptions options;
  options.response.method = Method::paper;  // the contact point is the overlap's own midpoint
  Responder responder(ode.world, options);
  const BarrierId barrier = responder.addBarrier(wall.scene(panels, rows));
  EXPECT_EQ(responder.report(barrier).walls, 2 * panels * rows);
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);

  double worstPoint = 0.0;
  double worstNormal = 0.0;
  for (const Pose& pose : poses()) {
    const double yaw = wall.yaw - pose.heading;
    const Eigen::Vector2d place = placeFor(wall, car.parameters, pose);
    car.place({place.x(), place.y(), car.parameters.massCentreHeight}, turned(yaw));
    const Eigen::Vector2d velocity = 5.0 * wall.along - 8.0 * wall.normal;
    car.move({velocity.x(), velocity.y(), 0.0}, Eigen::Vector3d::Zero());
    const auto events = responder.step(0.005);
    ASSERT_EQ(events.size(), 1U) << pose.heading / degree << "°, " << pose.depth << " m";
    const Eigen::Vector2d exact = middleOfInterference(wall, cornersOf(car.parameters, place, yaw));
    worstPoint = std::max(worstPoint, (events[0].contact.head<2>() - exact).norm());
    worstNormal = std::max(
        worstNormal,
        (events[0].normal - Eigen::Vector3d(wall.normal.x(), wall.normal.y(), 0.0)).norm());
    dBodySetForce(car.body, 0.0, 0.0, 0.0);
    dBodySetTorque(car.body, 0.0, 0.0, 0.0);
  }
  EXPECT_LE(worstPoint, 1e-9);
  EXPECT_LE(worstNormal, 1e-12);
  RecordProperty("worst_point_m", std::to_string(worstPoint));
}

INSTANTIATE_TEST_SUITE_P(Meshes, WallCut,
                         ::testing::Values(std::pair<std::size_t, std::size_t>{1, 1},
                                           std::pair<std::size_t, std::size_t>{153, 4}),
                         [](const auto& each) {
                           return std::to_string(2 * each.param.first * each.param.second);
                         });

// Why Bumper does not take ODE's contact normals: the same wall in 1,224 triangles, the same poses.
TEST(OdeContacts, NormalsAreNotTheWalls) {
  const TestWall wall;
  OdeWorld ode;
  const OdeMesh mesh(ode.space, wall.scene(153, 4));
  BoxCar car(ode.world, ode.space);
  int off = 0;
  double worst = 0.0;
  for (const Pose& pose : poses()) {
    const double yaw = wall.yaw - pose.heading;
    const Eigen::Vector2d place = placeFor(wall, car.parameters, pose);
    car.place({place.x(), place.y(), car.parameters.massCentreHeight}, turned(yaw));
    constexpr int capacity = 64;
    dContactGeom contacts[capacity];
    const int count = dCollide(car.geom, mesh.geom, capacity, contacts, sizeof(dContactGeom));
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (int i = 0; i < count; ++i) {
      mean += contacts[i].depth * Eigen::Map<const Eigen::Vector3d>(contacts[i].normal);
    }
    const double cosine = mean.normalized().head<2>().dot(wall.normal);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) / degree;
    if (count == 0 || angle >= 1.0) ++off;
    if (count > 0) worst = std::max(worst, angle);
  }
  RecordProperty("poses", static_cast<int>(poses().size()));
  RecordProperty("poses_off_by_a_degree", off);
  RecordProperty("worst_deg", std::to_string(worst));
  std::cout << "ODE's mean contact normal is off by 1° or more in " << off << " of "
            << poses().size() << " poses, at worst by " << worst << "°\n";
  EXPECT_GT(off, 10);
}

// On a banked road the yaw plane leans with the car, and the normal lies in it.
TEST(WallCut, NormalLiesInTheLeaningYawPlane) {
  const TestWall wall;
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(wall.scene(20, 3));
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  const Eigen::Matrix3d axes =
      turned(wall.yaw - 0.4) *
      Eigen::AngleAxisd(8.0 * degree, Eigen::Vector3d(0.6, 0.8, 0.0)).toRotationMatrix();
  const Eigen::Vector2d place = placeFor(wall, car.parameters, {.heading = 0.4, .depth = 0.1});
  car.place({place.x(), place.y(), 0.55}, axes);
  car.move(12.0 * axes.col(0), Eigen::Vector3d::Zero());
  const auto events = responder.step(0.005);
  ASSERT_GE(events.size(), 1U);
  const Eigen::Vector3d up = axes.col(2);
  const Eigen::Vector3d wallNormal(wall.normal.x(), wall.normal.y(), 0.0);
  const Eigen::Vector3d expected = (wallNormal - wallNormal.dot(up) * up).normalized();
  EXPECT_LE((events[0].normal - expected).norm(), 1e-12);
}

}  // namespace
}  // namespace bumper::tests
