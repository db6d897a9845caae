#include "bumper/scenes/clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bumper/scenes/paper_scenes.h"

namespace bumper {
namespace {

using Eigen::Vector2d;

constexpr double rounding = 1e-12;  // m, a few units in the last place of coordinates of 10 m

TEST(Clearance, IsTheDistanceToTheFaceOrTheEndOfAWall) {
  const Walls walls = selectWalls(straightWall({0, 0}, {10, 0}, 1.0, 7, 2));
  EXPECT_NEAR(clearance(walls.walls, {4.2, 3.0}), 3.0, rounding);
  EXPECT_NEAR(clearance(walls.walls, {4.2, -3.0}), 3.0, rounding);
  EXPECT_NEAR(clearance(walls.walls, {13.0, 4.0}), 5.0, rounding);
  EXPECT_NEAR(clearance(walls.walls, {-5.0, -12.0}), 13.0, rounding);
  EXPECT_NEAR(clearance(walls.walls, {3.0, 0.0}), 0.0, rounding);
}

TEST(Clearance, TakesTheNearestOfSeveralWalls) {
  Walls walls = selectWalls(straightWall({0, 0}, {10, 0}, 1.0));
  const Walls other = selectWalls(straightWall({0, 8}, {10, 8}, 1.0));
  walls.walls.insert(walls.walls.end(), other.walls.begin(), other.walls.end());
  EXPECT_NEAR(clearance(walls.walls, {5.0, 5.0}), 3.0, rounding);
}

TEST(Clearance, IsZeroUnderAWallThatLeans) {
  Scene scene = straightWall({0, 0}, {10, 0}, 1.0);
  for (Eigen::Vector3d& vertex : scene.vertices) vertex.y() += 0.2 * vertex.z();
  const Walls walls = selectWalls(scene);
  EXPECT_EQ(clearance(walls.walls, {5.0, 0.05}), 0.0);
  EXPECT_NEAR(clearance(walls.walls, {5.0, 1.2}), 1.0, rounding);
}

TEST(Clearance, IsInfiniteWithoutWalls) {
  EXPECT_EQ(clearance(std::vector<Wall>{}, {0, 0}), std::numeric_limits<double>::infinity());
}

TEST(Clearance, OfTheTestRailsStart) {
  // The side wall's near end is 60 m from the corner (67.197, 1.713) along the wall; from the
  // origin no part of it is nearer.
  const Vector2d end = Vector2d(67.197, 1.713) - 60.0 * Vector2d(0.99452, 0.10453).normalized();
  EXPECT_NEAR(clearance(selectWalls(testRail()).walls, {0, 0}), end.norm(), 2e-3);
}

}  // namespace
}  // namespace bumper
