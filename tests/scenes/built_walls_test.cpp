// Walls as people build them, in random sizes and directions: what stops a car is kept, and what it
// drives over is none.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "bumper/scenes/walls.h"
#include "roadside.h"

namespace bumper {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using tests::Roadside;

constexpr double degree = std::numbers::pi / 180.0;
constexpr int rounds = 60;

class BuiltWalls : public ::testing::Test {
 protected:
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  int number(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  double anyTurn() { return uniform(-std::numbers::pi, std::numbers::pi); }

 private:
  std::mt19937_64 random_{7};
};

std::size_t railTriangles(const Scene& scene) {
  return static_cast<std::size_t>(
      std::count_if(scene.triangles.begin(), scene.triangles.end(),
                    [](const auto& each) { return each.mesh == Roadside::rail; }));
}

std::size_t railsKept(const Scene& scene) {
  const Walls kept = selectWalls(scene);
  return static_cast<std::size_t>(
      std::count_if(kept.walls.begin(), kept.walls.end(), [&](const Wall& wall) {
        return scene.triangles[static_cast<std::size_t>(wall.triangle)].mesh == Roadside::rail;
      }));
}

void expectAllKept(const Scene& scene) { EXPECT_EQ(railsKept(scene), railTriangles(scene)); }

TEST_F(BuiltWalls, PlanksWithJointsAreGround) {
  for (int i = 0; i < rounds; ++i) {
    const double width = uniform(0.1, 2.0);
    const double joint = uniform(0.0, std::min(0.1, width));
    const double deck = uniform(5.0, 12.0);
    SCOPED_TRACE(testing::Message() << width << ' ' << joint << ' ' << deck);
    Roadside bridge;
    bridge.addFloor({-100, -100}, {100, 100}, 0.0);
    bridge.addPlanks({-15, -4}, {15, 4}, deck, width, joint);
    for (const double y : {-3.9, 3.9}) bridge.addRail(y, deck, -15, 15);
    // A beam of the bridge's, further below than a car reaches from the deck and higher than from
    // the ground.
    const std::size_t rails = railTriangles(bridge.scene);
    bridge.addBeam({{0.0, deck + 8.0}, {0.0, deck + 9.0}}, -5, 5);
    bridge.turn(anyTurn());
    EXPECT_EQ(railsKept(bridge.scene), rails);
  }
}

TEST_F(BuiltWalls, PlanksAlongTheBridgeAreGroundAsWell) {
  for (int i = 0; i < rounds; ++i) {
    const double width = uniform(0.1, 0.9);
    const double joint = uniform(0.0, std::min(0.1, width));
    Roadside bridge;
    bridge.addFloor({-100, -100}, {100, 100}, 0.0);
    bridge.addPlanks({-4, -15}, {4, 15}, 8.0, width, joint);
    for (Vector3d& vertex : bridge.scene.vertices) vertex = {vertex.y(), -vertex.x(), vertex.z()};
    bridge.addRail(3.9, 8.0, -15, 15);
    bridge.turn(anyTurn());
    SCOPED_TRACE(testing::Message() << width << ' ' << joint);
    expectAllKept(bridge.scene);
  }
}

TEST_F(BuiltWalls, ARoofIsNoGroundForWhatIsUnderIt) {
  for (int i = 0; i < rounds; ++i) {
    Roadside hall;
    hall.addRail(uniform(-3.0, 3.0), 0.0, -15, 15);
    for (int roofs = number(1, 3); roofs > 0; --roofs) {
      hall.addFloor({-30, -20}, {30, 20}, uniform(2.5, 20.0));
    }
    if (i % 2 == 0) hall.addFloor({200, -50}, {300, 50}, uniform(-5.0, 5.0));
    hall.turn(anyTurn());
    expectAllKept(hall.scene);
  }
}

TEST_F(BuiltWalls, AHouseWithoutFloorStandsOnGroundThatIsElsewhere) {
  for (int i = 0; i < rounds; ++i) {
    Roadside house;
    const double ledge = uniform(2.2, 4.0);
    const double depth = uniform(0.1, 2.5);
    const double eaves = ledge + uniform(3.0, 9.0);
    house.addBeam({{0.0, 0.0}, {0.0, ledge}, {depth, ledge}, {depth, eaves}, {12.0, eaves}}, -15,
                  15);
    house.turn(anyTurn());
    const Walls walls = selectWalls(house.scene);
    // The base and the wall above the ledge: two triangles each.
    EXPECT_EQ(walls.report.walls, 4U) << ledge << ' ' << depth << ' ' << eaves;
    EXPECT_EQ(walls.report.lowestFoot, 0.0);
  }
}

/// From a point to the nearest of a triangle's, by sampling its edges and its inside, m.
double distance(const Vector3d& point, const Wall& wall) {
  const Vector3d& a = wall.corners[0];
  const Vector3d inPlane = point - wall.normal.dot(point - a) * wall.normal;
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& from = wall.corners[k];
    const Vector3d side = wall.corners[(k + 1) % 3] - from;
    inside = inside && wall.normal.dot(side.cross(inPlane - from)) >= 0.0;
    const double share = std::clamp((point - from).dot(side) / side.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (point - from - share * side).norm());
  }
  return inside ? (point - inPlane).norm() : nearest;
}

TEST_F(BuiltWalls, TubesOfAnyNumberOfSidesAreWalls) {
  for (int i = 0; i < 4 * rounds; ++i) {
    const int sides = number(5, 32);
    const double radius = uniform(0.02, 0.15);
    const double turn = i % 3 == 0 ? 0.0 : i % 3 == 1 ? std::numbers::pi / sides : anyTurn();
    const Vector3d from(-15, 0, 0.5);
    const Vector3d to(15, 0, 0.5 + uniform(-1.5, 1.5));
    Roadside fence;
    fence.addFloor({-100, -100}, {100, 100}, 0.0);
    fence.addTube(from, to, radius, sides, turn);
    const std::vector<Vector3d> section = tests::tubeSection(from, to, radius, sides, turn);
    const std::vector<Wall> walls = selectWalls(fence.scene).walls;
    // The foremost points of the tube, on either side and over its middle heights.
    for (const double side : {-1.0, 1.0}) {
      for (const double height : {-0.45, -0.2, 0.0, 0.2, 0.45}) {
        double out = -1.0;
        for (std::size_t k = 0; k < section.size(); ++k) {
          const Vector3d& a = section[k];
          const Vector3d& b = section[(k + 1) % section.size()];
          const double share = (height * radius - a.z()) / (b.z() - a.z());
          if (share >= 0.0 && share <= 1.0) {
            out = std::max(out, side * (a.y() + share * (b.y() - a.y())));
          }
        }
        const Vector3d middle = 0.5 * (from + to);
        const Vector3d point(middle.x(), side * out, middle.z() + height * radius);
        double nearest = 1.0;
        for (const Wall& wall : walls) nearest = std::min(nearest, distance(point, wall));
        EXPECT_LT(nearest, 0.02 * radius)
            << sides << " sides, radius " << radius << ", turned " << turn << ", at " << height;
      }
    }
  }
}

TEST_F(BuiltWalls, ZigzagBeamsAre) {
  for (int i = 0; i < rounds; ++i) {
    const double lean = uniform(30.0, 60.0) * degree;
    const double depth = uniform(0.03, 0.12);
    Roadside rail;
    rail.addFloor({-100, -100}, {100, 100}, 0.0);
    std::vector<Vector2d> section{{0.0, 0.4}};
    const int folds = number(2, 6);
    for (int k = 0; k < folds; ++k) {
      section.emplace_back(k % 2 == 0 ? depth : 0.0, section.back().y() + depth / std::tan(lean));
    }
    rail.addBeam(section, -15, 15, number(1, 20));
    rail.turn(anyTurn());
    SCOPED_TRACE(testing::Message() << lean / degree << ' ' << depth << ' ' << folds);
    expectAllKept(rail.scene);
  }
}

TEST_F(BuiltWalls, LeaningPostsAndBoardsAre) {
  for (int i = 0; i < rounds; ++i) {
    const double lean = uniform(0.0, 45.0) * degree;
    const double way = anyTurn();
    const Vector3d top(std::sin(lean) * std::cos(way), std::sin(lean) * std::sin(way),
                       std::cos(lean));
    Roadside posts;
    posts.addFloor({-100, -100}, {100, 100}, 0.0);
    posts.addTube({0, 0, 0}, uniform(0.8, 1.6) * top, uniform(0.03, 0.15), number(4, 12),
                  anyTurn());
    const Vector3d wide = uniform(0.2, 2.0) * Vector3d(-std::sin(way), std::cos(way), 0.0);
    posts.addQuad(Roadside::rail, {5, 5, 0}, Vector3d(5, 5, 0) + wide,
                  Vector3d(5, 5, 0) + wide + top, Vector3d(5, 5, 0) + top);
    SCOPED_TRACE(testing::Message() << lean / degree << ' ' << way / degree);
    expectAllKept(posts.scene);
  }
}

TEST_F(BuiltWalls, HedgesAre) {
  for (int i = 0; i < rounds; ++i) {
    const double height = uniform(0.6, 1.6);
    const double slope = height * std::tan(uniform(18.0, 44.0) * degree);
    const double top = uniform(0.0, 1.2);
    Roadside hedge;
    hedge.addFloor({-100, -100}, {100, 100}, 0.0);
    for (const double side : {-1.0, 1.0}) {
      hedge.addBeam({{side * (0.5 * top + slope), 0.0}, {side * 0.5 * top, height}}, -15, 15, 4);
    }
    const std::size_t sides = railTriangles(hedge.scene);
    if (top > 0.1) hedge.addBeam({{-0.5 * top, height}, {0.5 * top, height}}, -15, 15, 4);
    hedge.turn(anyTurn());
    EXPECT_EQ(railsKept(hedge.scene), sides) << height << ' ' << slope << ' ' << top;
  }
}

/// A heightfield.
template <typename Height>
Scene terrain(int cells, double mesh, const Height& height) {
  Roadside land;
  const auto corner = [&](int i, int k) { return Vector3d(mesh * i, mesh * k, height(i, k)); };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      land.addQuad(Roadside::ground, corner(i, k), corner(i + 1, k), corner(i + 1, k + 1),
                   corner(i, k + 1));
    }
  }
  return land.scene;
}

TEST_F(BuiltWalls, HillsAreNone) {
  for (int i = 0; i < 20; ++i) {
    const double mesh = uniform(0.3, 4.0);
    const double wave = uniform(8.0, 60.0);
    // The steepest is 60°: no car climbs it, but it is a hillside.
    const double height = std::tan(uniform(10.0, 60.0) * degree) * wave / (2.0 * std::numbers::pi);
    const double phase = anyTurn();
    EXPECT_EQ(selectWalls(terrain(40, mesh,
                                  [&](int x, int y) {
                                    return height *
                                           std::sin(phase + 2.0 * std::numbers::pi * mesh *
                                                                (x + 0.5 * y) / wave / 1.118);
                                  }))
                  .report.walls,
              0U);
  }
}

TEST_F(BuiltWalls, RoughLandIsNone) {
  for (int i = 0; i < 20; ++i) {
    const double mesh = uniform(0.2, 2.0);
    std::vector<double> heights;
    for (int k = 0; k < 41 * 41; ++k) heights.push_back(uniform(0.0, 0.6 * mesh));
    EXPECT_EQ(selectWalls(terrain(40, mesh,
                                  [&](int x, int y) {
                                    return heights[static_cast<std::size_t>(41 * x + y)];
                                  }))
                  .report.walls,
              0U);
  }
}

TEST_F(BuiltWalls, RampsAndKerbsAreNone) {
  for (int i = 0; i < rounds; ++i) {
    const double slope = uniform(5.0, 36.0) * degree;
    const double length = uniform(1.0, 6.0);
    const double width = uniform(1.8, 4.0);
    const double rise = length * std::tan(slope);
    Roadside ramp;
    ramp.addFloor({-100, -100}, {100, 100}, 0.0);
    ramp.addQuad(Roadside::ground, {0, 0, 0}, {width, 0, 0}, {width, length, rise},
                 {0, length, rise});
    if (i % 2 == 0) {
      ramp.addQuad(Roadside::ground, {0, 0, 0}, {width, 0, 0}, {width, length, 0}, {0, length, 0});
    }
    // A kerb with a bevel.
    const double kerb = uniform(0.05, 0.15);
    const double bevel = kerb * std::tan(uniform(30.0, 60.0) * degree);
    ramp.addQuad(Roadside::ground, {-50, -5, 0}, {50, -5, 0}, {50, -5 - bevel, kerb},
                 {-50, -5 - bevel, kerb});
    ramp.addFloor({-50, -8.0}, {50, -5 - bevel}, kerb);
    ramp.turn(anyTurn());
    EXPECT_EQ(selectWalls(ramp.scene).report.walls, 0U)
        << slope / degree << ' ' << length << ' ' << width;
  }
}

}  // namespace
}  // namespace bumper
