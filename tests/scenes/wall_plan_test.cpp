#include "bumper/scenes/wall_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "bumper/scenes/clearance.h"
#include "bumper/scenes/paper_scenes.h"
#include "scene_building.h"

namespace bumper {
namespace {

using Vector2 = Eigen::Vector2d;

// The triangle in plan, clipped side by side to the strip: its least place along the strip, or the
// strip's end if nothing is left. Looks at one wall and knows no lines.
double beginsAt(const Wall& wall, const PlanStrip& strip) {
  std::vector<Vector2> polygon;
  for (const Eigen::Vector3d& corner : wall.corners) {
    const Vector2 away = corner.head<2>() - strip.origin;
    polygon.emplace_back(strip.direction.dot(away),
                         strip.direction.x() * away.y() - strip.direction.y() * away.x());
  }
  const auto clip = [&polygon](auto over) {
    std::vector<Vector2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2& a = polygon[i];
      const Vector2& b = polygon[(i + 1) % polygon.size()];
      if (over(a) <= 0.0) kept.push_back(a);
      if ((over(a) <= 0.0) != (over(b) <= 0.0)) {
        kept.emplace_back(a + over(a) / (over(a) - over(b)) * (b - a));
      }
    }
    polygon = kept;
  };
  clip([&](const Vector2& p) { return strip.start - p.x(); });
  clip([&](const Vector2& p) { return p.x() - strip.end; });
  clip([&](const Vector2& p) { return p.y() - strip.halfWidth; });
  clip([&](const Vector2& p) { return -p.y() - strip.halfWidth; });
  double least = strip.end;
  for (const Vector2& point : polygon) least = std::min(least, point.x());
  return least;
}

double beginsAt(const std::vector<Wall>& walls, const PlanStrip& strip) {
  const double radius =
      std::hypot(std::max(std::abs(strip.start), std::abs(strip.end)), strip.halfWidth);
  double least = strip.end;
  for (const Wall& wall : walls) {
    // No side of a wall in these scenes is longer.
    constexpr double longestSide = 200.0;
    const Vector2 away = wall.corners[0].head<2>() - strip.origin;
    if (away.norm() <= radius + longestSide) least = std::min(least, beginsAt(wall, strip));
  }
  return least;
}

struct Tally {
  int free = 0;
  int shortened = 0;
  int blocked = 0;
};

// Strips at random around the walls. `slack` is by how much the answer may be on the safe side.
Tally compare(const Scene& scene, double slack, unsigned seed) {
  const Walls walls = selectWalls(scene);
  const WallPlan plan(walls.walls);
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> which(0, walls.walls.size() - 1);
  std::uniform_real_distribution<double> aside(-15.0, 15.0);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  std::uniform_real_distribution<double> length(0.0, 40.0);
  std::uniform_real_distribution<double> width(0.0, 4.0);
  Tally tally;
  for (int i = 0; i < 1000; ++i) {
    PlanStrip strip;
    strip.origin =
        walls.walls[which(random)].corners[0].head<2>() + Vector2(aside(random), aside(random));
    const double heading = angle(random);
    strip.direction = {std::cos(heading), std::sin(heading)};
    strip.start = -5.0;
    strip.end = strip.start + length(random);
    strip.halfWidth = width(random);
    const double answer = plan.freeUntil(strip);
    const double exact = beginsAt(walls.walls, strip);
    EXPECT_LE(answer, exact) << i;
    // What is a little wider and begins a little earlier would have been told of.
    PlanStrip wider = strip;
    wider.start -= slack;
    wider.halfWidth += slack;
    EXPECT_GE(std::max(answer, strip.start),
              std::min(strip.end, beginsAt(walls.walls, wider) - slack))
        << i;
    if (answer == strip.end) {
      ++tally.free;
    } else if (answer >= strip.start) {
      ++tally.shortened;
    } else {
      ++tally.blocked;
    }
    if (testing::Test::HasFailure()) break;
  }
  return tally;
}

void expectAllKinds(const Tally& tally) {
  EXPECT_GT(tally.free, 50);
  EXPECT_GT(tally.shortened, 50);
  EXPECT_GT(tally.blocked, 50);
}

TEST(WallPlan, StripsBesideTheTestRail) { expectAllKinds(compare(testRail(), 0.16, 1)); }

TEST(WallPlan, StripsBesideTheCourse) { expectAllKinds(compare(course(), 0.16, 2)); }

TEST(WallPlan, StripsBesideAFineCourse) {
  const Scene fine =
      course({.innerPanels = 4000, .outerPanels = 5000, .groundAlong = 50, .groundAcross = 1});
  expectAllKinds(compare(fine, 0.16, 3));
}

TEST(WallPlan, StripsBesideAWallThatLeansAndLiesAcross) {
  Scene scene = straightWall({-31.7, 12.1}, {44.2, 71.3}, 2.0, 3, 2);
  for (Eigen::Vector3d& vertex : scene.vertices) vertex.x() += 0.2 * vertex.z();
  expectAllKinds(compare(scene, 0.6, 4));
}

TEST(WallPlan, StripsFarFromTheOrigin) {
  Scene scene = testRail();
  for (Eigen::Vector3d& vertex : scene.vertices) vertex += Eigen::Vector3d(1e5, -1e5, 0.0);
  expectAllKinds(compare(scene, 0.16, 5));
}

TEST(WallPlan, StripsBetweenWallsThatStandAlone) {
  Scene scene = straightWall({0, 0}, {0, 3}, 1.0);
  for (int i = 1; i < 40; ++i) {
    const double x = 7.3 * (i % 7);
    const int row = i / 7;
    const double y = 5.9 * row;
    tests::append(scene, straightWall({x, y}, {x + 2.0, y + 0.3 * i}, 1.0));
  }
  expectAllKinds(compare(scene, 0.16, 6));
}

TEST(WallPlan, TrianglesInAnyOrderAndOfAnySlope) {
  // Triangles that have nothing to do with each other, some as flat as a wall may be.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-60.0, 60.0);
  std::normal_distribution<double> arm(0.0, 2.0);
  Scene scene;
  scene.meshes.push_back({.name = "all", .material = "", .colour = {0.5F, 0.5F, 0.5F}});
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d centre(place(random), place(random), 0.0);
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (int k = 0; k < 3; ++k) {
      scene.vertices.emplace_back(centre +
                                  Eigen::Vector3d(arm(random), arm(random), 3.0 * arm(random)));
    }
    scene.triangles.push_back({.corners = {first, first + 1, first + 2}, .mesh = 0});
  }
  const std::vector<Wall> walls = selectWalls(scene).walls;
  ASSERT_GT(walls.size(), 50U);
  const WallPlan plan(walls);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  for (int i = 0; i < 3000; ++i) {
    const double heading = angle(random);
    const PlanStrip strip{.origin = {place(random), place(random)},
                          .direction = {std::cos(heading), std::sin(heading)},
                          .start = -3.0,
                          .end = 20.0,
                          .halfWidth = 1.5};
    ASSERT_LE(plan.freeUntil(strip), beginsAt(walls, strip)) << i;
  }
}

TEST(WallPlan, StraightWallIsAFewLines) {
  const WallPlan plan(selectWalls(straightWall({0, 0}, {60, 30}, 1.0, 200, 3)).walls);
  // Three rows of 200 panels, each as lines of 32 m at most.
  EXPECT_LE(plan.lineCount(), 9U);
}

TEST(WallPlan, MemoryIsSmallBesideTheWalls) {
  const std::vector<Wall> walls =
      selectWalls(
          course(
              {.innerPanels = 10000, .outerPanels = 10000, .groundAlong = 50, .groundAcross = 1}))
          .walls;
  // Two bytes a wall where ODE's mesh takes more than 60.
  EXPECT_LT(WallPlan(walls).memory(), 2 * walls.size());
}

TEST(WallPlan, WithoutWallsAllIsFree) {
  const PlanStrip strip{.start = -1.0, .end = 7.0, .halfWidth = 2.0};
  EXPECT_EQ(WallPlan().freeUntil(strip), 7.0);
  EXPECT_EQ(WallPlan(std::vector<Wall>{}).freeUntil(strip), 7.0);
}

TEST(WallPlan, FarOutsideAllIsFree) {
  const WallPlan plan(selectWalls(straightWall({0, 5}, {100, 5}, 1.0)).walls);
  EXPECT_EQ(plan.freeUntil({.origin = {50.0, -500.0}, .end = 30.0, .halfWidth = 3.0}), 30.0);
  EXPECT_EQ(plan.freeUntil({.origin = {900.0, 5.0}, .end = 30.0, .halfWidth = 3.0}), 30.0);
}

TEST(WallPlan, KnowsNothingOfAPlaceThatIsNotFinite) {
  const WallPlan plan(selectWalls(testRail()).walls);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_LT(plan.freeUntil({.origin = {nan, 0.0}, .end = 1.0, .halfWidth = 1.0}), 0.0);
  EXPECT_LT(plan.freeUntil({.origin = {30.0, nan}, .end = 1.0, .halfWidth = 1.0}), 0.0);
}

}  // namespace
}  // namespace bumper
