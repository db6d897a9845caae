#include "bumper/scenes/walls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "scene_building.h"

namespace bumper {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using tests::addTriangle;

constexpr double degree = std::numbers::pi / 180.0;

/// A triangle that leans from the vertical by an angle.
Scene leaning(double angle) {
  Scene scene;
  addTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, std::sin(angle), std::cos(angle)});
  return scene;
}

/// The same of a hillside: it goes on.
Scene hillside(double angle) {
  Scene scene = leaning(angle);
  for (Vector3d& vertex : scene.vertices) vertex *= 10.0;
  return scene;
}

TEST(WallSelection, KeepsWhatLeansLessThanTheLimit) {
  // |n_up| = sin(lean): 0.3 is 17.46°.
  for (const double lean : {0.0, 10.0, 17.4, -17.4, 180.0 - 17.4, 180.0}) {
    EXPECT_EQ(selectWalls(leaning(lean * degree)).report.walls, 1U) << lean;
  }
  for (const double lean : {17.5, -17.5, 45.0, 90.0, -90.0, 180.0 - 17.5}) {
    EXPECT_EQ(selectWalls(hillside(lean * degree)).report.walls, 0U) << lean;
    EXPECT_EQ(selectWalls(hillside(lean * degree)).report.droppedFlat, 1U) << lean;
  }
}

TEST(WallSelection, LimitIsASetting) {
  EXPECT_EQ(selectWalls(leaning(44.0 * degree), {.maxNormalUp = 0.7}).report.walls, 1U);
  EXPECT_EQ(selectWalls(leaning(46.0 * degree), {.maxNormalUp = 0.7}).report.walls, 0U);
  EXPECT_EQ(selectWalls(leaning(90.0 * degree), {.maxNormalUp = 1.0}).report.walls, 1U);
  EXPECT_EQ(selectWalls(leaning(0.0), {.maxNormalUp = 0.0}).report.walls, 1U);
  EXPECT_EQ(selectWalls(testRail(), {.maxNormalUp = 0.0}).report.walls, 144U);
}

TEST(WallSelection, RejectsALimitThatIsNone) {
  for (const double bad : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT([&] { selectWalls(leaning(0.0), {.maxNormalUp = bad}); },
                ThrowsMessage<Error>(HasSubstr("WallSelection::maxNormalUp")));
  }
}

TEST(WallSelection, SceneryIsNoWall) {
  Scene scene = testRail();
  EXPECT_EQ(selectWalls(scene, {.scenery = "wall"}).report.walls, 144U);  // part of a name
  const WallReport report = selectWalls(scene, {.scenery = "end_.*|tree"}).report;
  EXPECT_EQ(report.walls, 72U);
  EXPECT_EQ(report.droppedScenery, 72U);
  EXPECT_EQ(report.walls + report.dropped(), scene.triangles.size());
  EXPECT_EQ(selectWalls(scene, {.scenery = "concrete"}).report.walls, 0U);
  EXPECT_THAT([&] { selectWalls(scene, {.scenery = "*tree"}); },
              ThrowsMessage<Error>(HasSubstr("\"*tree\" is no regular expression")));
}

TEST(WallSelection, RejectsAnInvalidScene) {
  EXPECT_THAT([] { selectWalls(Scene{}); }, ThrowsMessage<Error>(HasSubstr("no triangle")));
}

TEST(WallSelection, CopiesCornersAndNormalInTheScenesOrder) {
  const Scene scene = testRail();
  const Walls walls = selectWalls(scene);
  // Front, back and ends of two walls.
  ASSERT_EQ(walls.walls.size(), 2U * (17U * 2U * 2U + 4U));
  int previous = -1;
  for (const Wall& wall : walls.walls) {
    EXPECT_GT(wall.triangle, previous);
    previous = wall.triangle;
    const Scene::Triangle& triangle = scene.triangles.at(static_cast<std::size_t>(wall.triangle));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(wall.corners.at(k), scene.corner(triangle, k));
    }
    EXPECT_NEAR(wall.normal.norm(), 1.0, 1e-15);
    EXPECT_NEAR(wall.normal.dot(wall.corners[1] - wall.corners[0]), 0.0, 1e-12);
    EXPECT_NEAR(wall.normal.dot(wall.corners[2] - wall.corners[0]), 0.0, 1e-12);
  }
}

TEST(WallSelection, NormalFollowsTheWinding) {
  Scene scene;
  addTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  EXPECT_EQ(selectWalls(scene).walls.at(0).normal, Vector3d(0, -1, 0));
  std::swap(scene.triangles[0].corners[0], scene.triangles[0].corners[1]);
  EXPECT_EQ(selectWalls(scene).walls.at(0).normal, Vector3d(0, 1, 0));
}

TEST(WallSelection, DropsDuplicatesOfEitherWindingAndKeepsTheFirst) {
  Scene scene;
  const Vector3d a(0, 0, 0);
  const Vector3d b(1, 0, 0);
  const Vector3d c(0, 0, 1);
  addTriangle(scene, a, b, c);
  addTriangle(scene, b, c, a);                          // turned round
  addTriangle(scene, c, b, a);                          // the other side
  addTriangle(scene, a, b, c + Vector3d(0, 0, 1e-6));   // within the weld distance
  addTriangle(scene, a, b, c + Vector3d(0, 0, 1e-3));   // another triangle
  addTriangle(scene, a, b, Vector3d(0, -1e-4, 0) + c);  // likewise
  const Walls walls = selectWalls(scene);
  EXPECT_EQ(walls.report.walls, 3U);
  EXPECT_EQ(walls.report.droppedDuplicate, 3U);
  EXPECT_EQ(walls.walls.at(0).triangle, 0);
  EXPECT_EQ(walls.walls.at(1).triangle, 4);
  EXPECT_EQ(walls.walls.at(2).triangle, 5);
}

TEST(WallSelection, DropsTrianglesWithoutArea) {
  Scene scene;
  addTriangle(scene, {0, 0, 0}, {0, 0, 0}, {0, 0, 1});
  addTriangle(scene, {5, 5, 5}, {5, 5, 5}, {5, 5, 5});
  addTriangle(scene, {0, 0, 0}, {0.1, 0, 0.1}, {0.3, 0, 0.3});
  addTriangle(scene, {0, 0, 0}, {1e-4, 0, 0}, {0, 0, 1});  // thin, and a wall
  const WallReport report = selectWalls(scene).report;
  EXPECT_EQ(report.droppedDegenerate, 3U);
  EXPECT_EQ(report.walls, 1U);
}

TEST(WallSelection, ReportAccountsForEveryTriangle) {
  Scene scene = course();
  scene.triangles.insert(scene.triangles.end(), scene.triangles.begin(),
                         scene.triangles.begin() + 100);
  scene.triangles.push_back({{0, 0, 1}, 0});
  const WallReport report = selectWalls(scene).report;
  EXPECT_EQ(report.droppedDuplicate, 100U);
  EXPECT_EQ(report.droppedDegenerate, 1U);
  EXPECT_EQ(report.walls + report.droppedFlat + report.droppedDegenerate + report.droppedDuplicate,
            scene.triangles.size());
}

TEST(WallSelection, OfSceneWithoutWallsIsEmpty) {
  const Walls walls = selectWalls(leaning(90.0 * degree));
  EXPECT_TRUE(walls.walls.empty());
  EXPECT_EQ(walls.report.lowestFoot, 0.0);
  EXPECT_EQ(walls.report.highestTop, 0.0);
}

}  // namespace
}  // namespace bumper
