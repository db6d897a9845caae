// Cars against walls as people build them: every one holds, in random sizes, directions and poses.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "ode_world.h"
#include "roadside.h"
#include "wall_cut.h"

namespace bumper::tests {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double h = 0.005;

struct Drive {
  double heading = 20.0 * degree;  // towards the rail, which is at y >= 4
  double yaw = 0.0;                // of the whole scene
  double pitch = 0.0;
  double height = 0.0;  // of the ground
};

/// How far the car's mass centre gets across, m.
double farthestAcross(const Scene& scene, const Drive& drive) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(scene, {.space = ode.space});
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(drive.yaw, Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d axes = turned * (Eigen::AngleAxisd(drive.heading, Vector3d::UnitZ()) *
                                         Eigen::AngleAxisd(drive.pitch, Vector3d::UnitY()))
                                            .toRotationMatrix();
  const Vector3d start(0.0, 0.0, drive.height + car.parameters.massCentreHeight);
  car.place(turned * start, axes);
  const Vector3d ahead(std::cos(drive.heading), std::sin(drive.heading), 0.0);
  car.move(turned * (15.0 * ahead), Vector3d::Zero());
  double across = 0.0;
  for (int i = 0; i < 300; ++i) {
    responder.step(h);
    dWorldQuickStep(ode.world, h);
    const Vector3d place(Eigen::Map<const Vector3d>(dBodyGetPosition(car.body)));
    across = std::max(across, (turned.transpose() * place).y());
  }
  return across;
}

class BuiltWallsHold : public ::testing::Test {
 protected:
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  int number(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  /// Where the car stops is the rail's side, less half its width at least.
  void expectHeld(Roadside& road, double pitch = 0.0, double height = 0.0) {
    const double yaw = uniform(-std::numbers::pi, std::numbers::pi);
    road.turn(yaw);
    for (const double heading : {20.0, 60.0}) {
      EXPECT_LT(farthestAcross(
                    road.scene,
                    {.heading = heading * degree, .yaw = yaw, .pitch = pitch, .height = height}),
                3.2);
    }
  }

 private:
  std::mt19937_64 random_{3};
};

TEST_F(BuiltWallsHold, OnABridgeOfPlanks) {
  for (int i = 0; i < 6; ++i) {
    Roadside road;
    road.addFloor({-200, -200}, {200, 200}, 0.0);
    road.addPlanks({-20, -4.5}, {60, 4.5}, 8.0, uniform(0.1, 2.0), uniform(0.0, 0.1));
    road.addRail(4.0, 8.0, -20, 60);
    expectHeld(road, 0.0, 8.0);
  }
}

TEST_F(BuiltWallsHold, UnderARoof) {
  Roadside road;
  road.addRail(4.0, 0.0, -20, 60);
  road.addFloor({-30, -20}, {70, 20}, 6.0);
  expectHeld(road);
}

// The third tube of each fence lies across the band's end.
TEST_F(BuiltWallsHold, FencesOfTube) {
  for (int i = 0; i < 16; ++i) {
    const int sides = number(5, 32);
    const double radius = uniform(0.02, 0.15);
    const double turn = uniform(0.0, 6.3);
    Roadside road;
    road.addFloor({-200, -200}, {200, 200}, 0.0);
    for (const double z : {0.4, 0.75}) {
      road.addTube({-20, 4.0 + radius, z}, {60, 4.0 + radius, z}, radius, sides, turn);
    }
    SCOPED_TRACE(testing::Message() << sides << " sides, radius " << radius << ", " << turn);
    expectHeld(road, uniform(-3.0, 3.0) * degree);
  }
}

TEST_F(BuiltWallsHold, ZigzagBeams) {
  for (int i = 0; i < 8; ++i) {
    const double lean = uniform(30.0, 60.0) * degree;
    const double depth = uniform(0.04, 0.1);
    Roadside road;
    road.addFloor({-200, -200}, {200, 200}, 0.0);
    std::vector<Vector2d> section{{4.0, 0.4}};
    for (int k = 0; k < 4; ++k) {
      section.emplace_back(4.0 + (k % 2 == 0 ? depth : 0.0),
                           section.back().y() + depth / std::tan(lean));
    }
    road.addBeam(section, -20, 60, number(1, 40));
    expectHeld(road, uniform(-3.0, 3.0) * degree);
  }
}

TEST_F(BuiltWallsHold, LeaningPostsAndAHedge) {
  for (int i = 0; i < 8; ++i) {
    const double lean = uniform(0.0, 45.0) * degree;
    Roadside posts;
    posts.addFloor({-200, -200}, {200, 200}, 0.0);
    for (double x = -20.0; x < 60.0; x += 1.0) {
      posts.addTube({x, 4.0 + 0.8 * std::tan(lean), 0.0}, {x, 4.0, 0.8 + 0.15}, 0.06, number(4, 9),
                    uniform(0.0, 6.3));
    }
    expectHeld(posts);
    Roadside hedge;
    hedge.addFloor({-200, -200}, {200, 200}, 0.0);
    hedge.addBeam({{4.0, 0.0}, {4.0 + std::tan(lean), 1.0}}, -20, 60, 20);
    expectHeld(hedge);
  }
}

// A rail's sides are where they are, not where their planes would meet the band.
TEST_F(BuiltWallsHold, ALeaningStripIsCutAtItsOwnPlace) {
  const VehicleParameters parameters = {.mass = 1500.0,
                                        .yawInertia = 2600.0,
                                        .massCentreToFront = 2.1,
                                        .massCentreToRear = 2.5,
                                        .width = 1.8,
                                        .massCentreHeight = 0.55};
  const Envelope envelope(parameters, {.bottom = 0.3, .top = 0.75});
  int cut = 0;
  for (int i = 0; i < 500; ++i) {
    const double lean = uniform(20.0, 63.0) * degree;
    const double width = uniform(0.02, 0.2);
    const double slope = uniform(-0.15, 0.15);
    const Vector3d along = Vector3d(1.0, 0.0, slope).normalized();
    const Vector3d up =
        along.cross(Vector3d(0.0, std::cos(lean), -std::sin(lean)).normalized()).normalized();
    const Vector3d from = Vector3d(-20.0, 3.0, 0.5 - 20.0 * slope);
    Wall wall;
    wall.corners = {from, from + 60.0 * along, from + 60.0 * along + width * up};
    wall.normal =
        (wall.corners[1] - wall.corners[0]).cross(wall.corners[2] - wall.corners[0]).normalized();
    VehicleState state;
    state.massCentre = {uniform(-1.0, 1.0), 0.0, 0.55};
    state.axes = (Eigen::AngleAxisd(uniform(-3.0, 3.0), Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(uniform(-0.1, 0.1), Vector3d::UnitY()) *
                  Eigen::AngleAxisd(uniform(-0.1, 0.1), Vector3d::UnitX()))
                     .toRotationMatrix();
    const std::optional<Segment> segment = cutFace(WallFace(wall), state, envelope);
    double sideways = 0.0;
    bool any = false;
    for (int k = 0; k <= 4000; ++k) {
      for (const double share : {0.0, 0.5, 1.0}) {
        const double way = k / 4000.0;
        const Vector3d point = from + way * 60.0 * along + share * way * width * up;
        const Vector3d seen = state.axes.transpose() * (point - state.massCentre);
        if (seen.z() < envelope.low() || seen.z() > envelope.high()) continue;
        any = true;
        ASSERT_TRUE(segment);
        sideways =
            std::max(sideways, std::abs(segment->normal.dot(seen.head<2>() - segment->start)));
      }
    }
    if (!any) continue;
    ++cut;
    EXPECT_LE(sideways, width + 1e-9) << lean / degree << ' ' << width << ' ' << slope;
  }
  EXPECT_GT(cut, 300);
}

}  // namespace
}  // namespace bumper::tests
