// Wall::foot and Wall::top: how tall is the wall that a triangle is a part of?

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/walls.h"
#include "scene_building.h"

namespace bumper {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using tests::append;

constexpr double rounding = 1e-9;

Scene raised(Scene scene, double height) {
  for (Vector3d& vertex : scene.vertices) vertex.z() += height;
  return scene;
}

/// Every triangle with three vertices of its own.
Scene shattered(const Scene& scene) {
  Scene result;
  result.meshes = scene.meshes;
  for (const Scene::Triangle& triangle : scene.triangles) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (std::size_t k = 0; k < 3; ++k) result.vertices.push_back(scene.corner(triangle, k));
    result.triangles.push_back({{first, first + 1, first + 2}, triangle.mesh});
  }
  return result;
}

double lowest(const Wall& wall) {
  return std::min({wall.corners[0].z(), wall.corners[1].z(), wall.corners[2].z()});
}

double highest(const Wall& wall) {
  return std::max({wall.corners[0].z(), wall.corners[1].z(), wall.corners[2].z()});
}

void expectAll(const Scene& scene, double foot, double top) {
  const Walls walls = selectWalls(scene);
  ASSERT_FALSE(walls.walls.empty());
  for (const Wall& wall : walls.walls) {
    EXPECT_NEAR(wall.foot, foot, rounding) << "triangle " << wall.triangle;
    EXPECT_NEAR(wall.top, top, rounding) << "triangle " << wall.triangle;
  }
  EXPECT_NEAR(walls.report.lowestFoot, foot, rounding);
  EXPECT_NEAR(walls.report.highestTop, top, rounding);
}

TEST(WallExtents, OfAWallInOnePieceAreItsOwn) {
  expectAll(raised(straightWall({3, 1}, {7, -4}, 0.9), 0.2), 0.2, 1.1);
}

TEST(WallExtents, OfAWallMeshedInRowsAreThoseOfAllRows) {
  expectAll(straightWall({3, 1}, {7, -4}, 1.2, 1, 12), 0.0, 1.2);
  expectAll(straightWall({3, 1}, {70, -40}, 1.2, 31, 5), 0.0, 1.2);
}

TEST(WallExtents, DoNotDependOnSharedVertices) {
  expectAll(shattered(straightWall({3, 1}, {70, -40}, 1.2, 31, 5)), 0.0, 1.2);
}

TEST(WallExtents, DoNotDependOnWinding) {
  Scene scene = straightWall({3, 1}, {70, -40}, 1.2, 31, 5);
  for (std::size_t i = 0; i < scene.triangles.size(); i += 3) {
    std::swap(scene.triangles[i].corners[0], scene.triangles[i].corners[1]);
  }
  expectAll(scene, 0.0, 1.2);
}

TEST(WallExtents, DoNotJoinWallsThatStandFarAboveOneAnother) {
  const Scene low = straightWall({0, 0}, {20, 0}, 0.8, 5, 3);
  Scene scene = low;
  append(scene, raised(low, 4.0));
  const Walls walls = selectWalls(scene);
  ASSERT_EQ(walls.walls.size(), 60U);
  for (const Wall& wall : walls.walls) {
    const double foot = wall.triangle < 30 ? 0.0 : 4.0;
    EXPECT_NEAR(wall.foot, foot, rounding);
    EXPECT_NEAR(wall.top, foot + 0.8, rounding);
  }
}

TEST(WallExtents, DoNotJoinWallAndParapetThatHangTogetherAtATower) {
  // A tower 4.8 m tall at the end of a low wall and of a parapet above it, all of one surface.
  Scene scene = straightWall({0, 0}, {20, 0}, 0.8, 5, 1);
  append(scene, raised(straightWall({0, 0}, {20, 0}, 0.8, 5, 1), 4.0));
  append(scene, straightWall({20, 0}, {21, 0}, 4.8, 1, 6));
  for (const Wall& wall : selectWalls(scene).walls) {
    const bool isTower = wall.triangle >= 20;
    const double foot = wall.triangle >= 10 && !isTower ? 4.0 : 0.0;
    EXPECT_NEAR(wall.foot, foot, rounding) << wall.triangle;
    EXPECT_NEAR(wall.top, isTower ? 4.8 : foot + 0.8, rounding) << wall.triangle;
  }
}

TEST(WallExtents, OfALintelAreNotThoseOfItsPosts) {
  Scene scene = straightWall({0, 0}, {1, 0}, 5.0, 1, 5);
  append(scene, straightWall({9, 0}, {10, 0}, 5.0, 1, 5));
  append(scene, raised(straightWall({1, 0}, {9, 0}, 1.0, 4, 1), 4.0));
  for (const Wall& wall : selectWalls(scene).walls) {
    EXPECT_NEAR(wall.foot, wall.triangle < 20 ? 0.0 : 4.0, rounding) << wall.triangle;
    EXPECT_NEAR(wall.top, 5.0, rounding) << wall.triangle;
  }
}

TEST(WallExtents, ChangeWhereTheWallsHeightDoes) {
  Scene scene = straightWall({0, 0}, {10, 0}, 0.6, 4, 2);
  append(scene, straightWall({10, 0}, {20, 0}, 3.0, 4, 10));
  for (const Wall& wall : selectWalls(scene).walls) {
    EXPECT_NEAR(wall.foot, 0.0, rounding);
    EXPECT_NEAR(wall.top, wall.triangle < 16 ? 0.6 : 3.0, rounding) << wall.triangle;
  }
}

double hills(double x) { return 6.0 * std::sin(x / 40.0) + 2.0 * std::sin(x / 13.0); }

class WallOnHills : public ::testing::TestWithParam<std::size_t> {};

TEST_P(WallOnHills, HasTheHeightsOfEachPanel) {
  constexpr std::size_t panels = 60;
  constexpr double length = 300.0;
  Scene scene = straightWall({0, 0}, {length, 0}, 0.9, panels, GetParam());
  for (Vector3d& vertex : scene.vertices) vertex.z() += hills(vertex.x());
  for (const Wall& wall : selectWalls(scene).walls) {
    const double middle = (wall.corners[0].x() + wall.corners[1].x() + wall.corners[2].x()) / 3.0;
    const double width = length / panels;
    const double from = hills(std::floor(middle / width) * width);
    const double to = hills(std::ceil(middle / width) * width);
    EXPECT_NEAR(wall.foot, std::min(from, to), rounding);
    EXPECT_NEAR(wall.top, std::max(from, to) + 0.9, rounding);
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, WallOnHills, ::testing::Values(1, 2, 7));

TEST(WallExtents, OfAClosedRoundWallMeetAllTheWayRound) {
  Scene scene = straightWall({0, 0}, {1, 0}, 2.5, 200, 4);
  for (Vector3d& vertex : scene.vertices) {
    const double angle = 2.0 * std::numbers::pi * vertex.x();
    vertex = {30.0 * std::cos(angle), 30.0 * std::sin(angle), vertex.z()};
  }
  expectAll(scene, 0.0, 2.5);
}

TEST(WallExtents, JoinRowsThatLeanDifferently) {
  // A concrete step barrier: 80° below, upright above.
  Scene scene = straightWall({0, 0}, {50, 0}, 1.0, 20, 2);
  for (Vector3d& vertex : scene.vertices) {
    vertex.y() += std::min(vertex.z(), 0.5) / std::tan(80.0 * std::numbers::pi / 180.0);
  }
  expectAll(scene, 0.0, 1.0);
}

TEST(WallExtents, JoinRowsOfDifferentPanels) {
  // One long panel on top of ten short ones: only the ends' corners are shared.
  Scene scene = straightWall({0, 0}, {20, 0}, 0.5, 10, 1);
  append(scene, raised(straightWall({0, 0}, {20, 0}, 0.5, 1, 1), 0.5));
  expectAll(scene, 0.0, 1.0);
}

TEST(WallExtents, OfALongPanelOverShortOnesFollowTheSlope) {
  // The whole wall climbs 1 in 10: what stands over a short panel is the long one's part there.
  Scene scene = straightWall({0, 0}, {20, 0}, 0.5, 10, 1);
  append(scene, raised(straightWall({0, 0}, {20, 0}, 0.5, 1, 1), 0.5));
  for (Vector3d& vertex : scene.vertices) vertex.z() += 0.1 * vertex.x();
  for (const Wall& wall : selectWalls(scene).walls) {
    if (wall.triangle >= 20) {
      EXPECT_NEAR(wall.foot, 0.0, rounding);
      EXPECT_NEAR(wall.top, 3.0, rounding);
    } else {
      const int panel = wall.triangle / 2;
      const double start = 2.0 * panel;
      EXPECT_NEAR(wall.foot, 0.1 * start, rounding);
      EXPECT_NEAR(wall.top, 0.1 * (start + 2.0) + 1.0, rounding);
    }
  }
}

TEST(WallExtents, OfSlabsAreTheirHeight) { expectAll(testRail(), 0.0, 0.9); }

TEST(WallExtents, OfIrregularMeshesReachFromFootToTop) {
  // A wall without rows or columns: inner vertices are moved about in its plane.
  std::mt19937 random(20031);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  Scene scene = straightWall({0, 0}, {60, 0}, 20.0, 60, 20);
  for (Vector3d& vertex : scene.vertices) {
    if (vertex.x() > 0.5 && vertex.x() < 59.5) vertex.x() += shift(random);
    if (vertex.z() > 0.5 && vertex.z() < 19.5) vertex.z() += shift(random);
  }
  const Walls walls = selectWalls(scene);
  ASSERT_EQ(walls.walls.size(), 2400U);
  for (const Wall& wall : walls.walls) {
    EXPECT_NEAR(wall.foot, 0.0, rounding);
    EXPECT_NEAR(wall.top, 20.0, rounding);
  }
}

TEST(WallExtents, AlwaysContainTheTriangle) {
  std::mt19937 random(20032);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  Scene scene;
  scene.meshes.resize(1);
  for (int i = 0; i < 60; ++i)
    scene.vertices.emplace_back(place(random), place(random), place(random));
  std::uniform_int_distribution<std::uint32_t> vertex(0, 59);
  for (int i = 0; i < 5000; ++i) {
    scene.triangles.push_back({{vertex(random), vertex(random), vertex(random)}, 0});
  }
  const Walls walls = selectWalls(scene, {.maxNormalUp = 1.0});
  ASSERT_GT(walls.walls.size(), 4000U);
  for (const Wall& wall : walls.walls) {
    EXPECT_LE(wall.foot, lowest(wall));
    EXPECT_GE(wall.top, highest(wall));
    EXPECT_GE(wall.foot, -5.0);
    EXPECT_LE(wall.top, 5.0);
  }
}

}  // namespace
}  // namespace bumper
