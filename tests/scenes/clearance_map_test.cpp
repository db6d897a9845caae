#include "bumper/scenes/clearance_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "bumper/scenes/clearance.h"
#include "bumper/scenes/paper_scenes.h"

namespace bumper {
namespace {

// Beside clearance(), which looks at every wall.
void expectBounds(const Scene& scene, double around, unsigned seed) {
  const Walls walls = selectWalls(scene);
  const ClearanceMap map(walls.walls);
  Eigen::Vector2d low = walls.walls.front().corners[0].head<2>();
  Eigen::Vector2d high = low;
  for (const Wall& wall : walls.walls) {
    for (const Eigen::Vector3d& corner : wall.corners) {
      low = low.cwiseMin(corner.head<2>());
      high = high.cwiseMax(corner.head<2>());
    }
  }
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(low.x() - around, high.x() + around);
  std::uniform_real_distribution<double> y(low.y() - around, high.y() + around);
  int useful = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector2d point(x(random), y(random));
    const double exact = clearance(walls.walls, point);
    const double bound = map.atLeast(point.x(), point.y());
    ASSERT_LE(bound, exact) << point.transpose();
    const bool inside =
        (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
    if (inside) {
      const double cell = map.cellSize();
      const double good = exact < 4.0 * cell ? exact - 1.6 * cell : 0.7 * exact - 2.0 * cell;
      ASSERT_GE(bound, std::min(good, 6.0 * cell)) << point.transpose();
    }
    if (bound > 0.0) ++useful;
  }
  EXPECT_GT(useful, 500);
}

TEST(ClearanceMap, IsABoundBesideTheTestRail) { expectBounds(testRail(), 30.0, 1); }

TEST(ClearanceMap, IsABoundBesideTheCourse) { expectBounds(course(), 50.0, 2); }

TEST(ClearanceMap, IsABoundForAWallThatLeansAndLiesAcross) {
  Scene scene = straightWall({-31.7, 12.1}, {44.2, 71.3}, 2.0, 3, 2);
  for (Eigen::Vector3d& vertex : scene.vertices) vertex.x() += 0.2 * vertex.z();
  expectBounds(scene, 40.0, 3);
}

TEST(ClearanceMap, IsABoundInARow) {
  // Walls at all distances from one another: which one counts changes from cell to cell.
  Scene scene = straightWall({0, 0}, {0, 3}, 1.0);
  for (int i = 1; i < 12; ++i) {
    const double x = 7.3 * i;
    const double y = 5.9 * (i % 3);
    const Scene wall = straightWall({x, y}, {x + 2.0, y + 3.0}, 1.0);
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), wall.vertices.begin(), wall.vertices.end());
    for (Scene::Triangle triangle : wall.triangles) {
      for (std::uint32_t& corner : triangle.corners) corner += first;
      scene.triangles.push_back(triangle);
    }
  }
  expectBounds(scene, 30.0, 5);
}

TEST(ClearanceMap, FarFromTheOrigin) {
  Scene scene = testRail();
  for (Eigen::Vector3d& vertex : scene.vertices) vertex += Eigen::Vector3d(1e5, -1e5, 0.0);
  expectBounds(scene, 30.0, 4);
}

TEST(ClearanceMap, OfOneWallAlongAnAxis) {
  const ClearanceMap map(selectWalls(straightWall({0, 5}, {100, 5}, 1.0)).walls);
  EXPECT_NEAR(map.atLeast(50.0, -5.0), 10.0, 1e-5);
  EXPECT_EQ(map.atLeast(50.0, 5.0), 0.0);
}

TEST(ClearanceMap, MemoryIsBounded) {
  // 20 km of wall across: cells grow instead of becoming 400 million, and only what is near the
  // wall is kept: 28,000 m long and less than 6 tiles of 160 m wide, at one byte for 10 m x 10 m.
  const ClearanceMap map(selectWalls(straightWall({0, 0}, {2e4, 2e4}, 1.0, 100, 1)).walls);
  EXPECT_NEAR(map.cellSize(), 10.0, 0.01);
  EXPECT_LT(map.memory(), 500'000U);
}

TEST(ClearanceMap, IsInfiniteWithoutWalls) {
  EXPECT_EQ(ClearanceMap().atLeast(0, 0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(ClearanceMap(std::vector<Wall>{}).atLeast(0, 0),
            std::numeric_limits<double>::infinity());
}

TEST(ClearanceMap, KnowsNothingOfAPlaceThatIsNotFinite) {
  const ClearanceMap map(selectWalls(testRail()).walls);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(map.atLeast(nan, 0.0), 0.0);
  EXPECT_EQ(map.atLeast(30.0, nan), 0.0);
}

}  // namespace
}  // namespace bumper
