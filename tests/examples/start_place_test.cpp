// Where a car is put down: on the ground that a driver would call so, and on no roof.

#include "start_place.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace bumper::examples {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

enum class Facing { up, down };

std::uint32_t addCorners(Scene& scene, const std::array<Vector3d, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), corners.begin(), corners.end());
  return first;
}

void addQuad(Scene& scene, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
             std::uint32_t mesh = 0) {
  scene.triangles.push_back({{a, b, c}, mesh});
  scene.triangles.push_back({{a, c, d}, mesh});
}

/// A level square around a place.
void addLevel(Scene& scene, const Vector3d& centre, double halfWidth, Facing facing = Facing::up,
              std::uint32_t mesh = 0) {
  const double h = halfWidth;
  const std::uint32_t first =
      addCorners(scene, {centre + Vector3d(-h, -h, 0), centre + Vector3d(h, -h, 0),
                         centre + Vector3d(h, h, 0), centre + Vector3d(-h, h, 0)});
  if (facing == Facing::up) {
    addQuad(scene, first, first + 1, first + 2, first + 3, mesh);
  } else {
    addQuad(scene, first, first + 3, first + 2, first + 1, mesh);
  }
}

void addWall(Scene& scene, const Vector3d& from, const Vector3d& to, double height) {
  const Vector3d up = height * Vector3d::UnitZ();
  const std::uint32_t first = addCorners(scene, {from, to, to + up, from + up});
  addQuad(scene, first, first + 1, first + 2, first + 3);
}

Scene emptyScene() {
  Scene scene;
  scene.meshes.resize(2);
  return scene;
}

/// Floor, roof and two walls, 30 m wide.
Scene hall(Facing floor, Facing roof) {
  Scene scene = emptyScene();
  addLevel(scene, {0, 0, 0}, 15.0, floor);
  addLevel(scene, {0, 0, 5}, 15.0, roof);
  addWall(scene, {-15, -15, 0}, {15, -15, 0}, 5.0);
  addWall(scene, {-15, 15, 0}, {15, 15, 0}, 5.0);
  return scene;
}

const std::vector<bool> noScenery{false, false};

TEST(StartPlaces, StandOnTheFloorOfAHallHoweverItIsWound) {
  for (const Facing floor : {Facing::up, Facing::down}) {
    for (const Facing roof : {Facing::up, Facing::down}) {
      const Scene scene = hall(floor, roof);
      const StartPlaces places(scene, noScenery);
      EXPECT_EQ(places.lowestGround({3, 4}), 0.0);
      // On the seam of two triangles, and in a corner.
      EXPECT_EQ(places.lowestGround({0, 0}), 0.0);
      EXPECT_EQ(places.lowestGround({15, 15}), 0.0);
      EXPECT_EQ(places.middle(), Vector2d(0, 0));
      EXPECT_EQ(places.lowestGround({16, 0}), std::nullopt);
    }
  }
}

TEST(StartPlaces, AreAtTheStoreyThatAHeightNames) {
  const Scene scene = hall(Facing::up, Facing::up);
  const StartPlaces places(scene, noScenery);
  for (const double floor : {-10.0, 0.0, 0.55, 4.4}) {
    EXPECT_EQ(places.groundNear({3, 4}, floor), 0.0) << floor;
  }
  for (const double roof : {4.6, 5.0, 100.0}) {
    EXPECT_EQ(places.groundNear({3, 4}, roof), 5.0) << roof;
  }
  EXPECT_EQ(places.groundNear({16, 0}, 0.0), std::nullopt);
}

TEST(StartPlaces, HaveRoomForACar) {
  // A slab on the ground, a deck too low to drive under, a bridge.
  for (const auto& [above, expected] : {std::pair(0.3, 0.3), {1.5, 1.5}, {4.5, 0.0}}) {
    Scene scene = emptyScene();
    addLevel(scene, {0, 0, 0}, 50.0);
    addLevel(scene, {0, 0, above}, 5.0);
    const StartPlaces places(scene, noScenery);
    EXPECT_EQ(places.lowestGround({1, 2}), expected);
    EXPECT_EQ(places.lowestGround({20, 2}), 0.0);
  }
}

TEST(StartPlaces, AreNotInsideTheLand) {
  // Land as a closed solid, 20 m thick, and a wall upon it.
  Scene scene = emptyScene();
  addLevel(scene, {0, 0, -20}, 50.0, Facing::down);
  addLevel(scene, {0, 0, 0}, 50.0, Facing::up);
  addWall(scene, {-50, -50, -20}, {50, -50, -20}, 20.0);
  addWall(scene, {10, -10, 0}, {10, 10, 0}, 1.0);
  EXPECT_EQ(StartPlaces(scene, noScenery).lowestGround({1, 2}), 0.0);
}

TEST(StartPlaces, FollowSlopes) {
  Scene scene = emptyScene();
  const std::uint32_t first = addCorners(
      scene, {Vector3d(0, 0, 0), Vector3d(10, 0, 5), Vector3d(10, 10, 5), Vector3d(0, 10, 0)});
  addQuad(scene, first, first + 1, first + 2, first + 3);
  EXPECT_NEAR(StartPlaces(scene, noScenery).lowestGround({3, 8}).value(), 1.5, 1e-12);
}

TEST(StartPlaces, PassOverScenery) {
  Scene scene = emptyScene();
  addLevel(scene, {0, 0, 0}, 50.0);
  addLevel(scene, {0, 0, -30}, 100.0, Facing::up, 1);
  EXPECT_EQ(StartPlaces(scene, noScenery).lowestGround({1, 2}), -30.0);
  EXPECT_EQ(StartPlaces(scene, {false, true}).lowestGround({1, 2}), 0.0);
  EXPECT_EQ(StartPlaces(scene, {false, true}).lowestGround({60, 2}), std::nullopt);
}

TEST(StartPlaces, OfTheMiddleAreBesideABlock) {
  // Land around a block in the scene's middle, which has a top and no floor.
  Scene scene = emptyScene();
  const std::uint32_t inner = addCorners(scene, {Vector3d(-10, -10, 0), Vector3d(10, -10, 0),
                                                 Vector3d(10, 10, 0), Vector3d(-10, 10, 0)});
  const std::uint32_t outer = addCorners(scene, {Vector3d(-60, -60, 0), Vector3d(60, -60, 0),
                                                 Vector3d(60, 60, 0), Vector3d(-60, 60, 0)});
  for (std::uint32_t k = 0; k < 4; ++k) {
    addQuad(scene, outer + k, outer + (k + 1) % 4, inner + (k + 1) % 4, inner + k);
  }
  addLevel(scene, {0, 0, 8}, 10.0);
  const StartPlaces places(scene, noScenery);
  EXPECT_EQ(places.lowestGround({0, 0}), 8.0);
  const std::optional<Vector2d> middle = places.middle();
  ASSERT_TRUE(middle);
  EXPECT_GT(middle->cwiseAbs().maxCoeff(), 10.0);
  EXPECT_EQ(places.lowestGround(*middle), 0.0);
}

TEST(StartPlaces, OfTheMiddleAreLevelIfTheyMay) {
  // A bank of 30° in the middle, and level land at its foot.
  Scene scene = emptyScene();
  const std::uint32_t first = addCorners(scene, {Vector3d(-20, -9, 0), Vector3d(20, -9, 0),
                                                 Vector3d(20, 9, 10), Vector3d(-20, 9, 10)});
  addQuad(scene, first, first + 1, first + 2, first + 3);
  EXPECT_EQ(StartPlaces(scene, noScenery).middle(), Vector2d(0, 0));
  scene.vertices.emplace_back(20, -18, 0);
  scene.vertices.emplace_back(-20, -18, 0);
  addQuad(scene, first, first + 5, first + 4, first + 1);
  scene.vertices.emplace_back(0, 18, 10);
  scene.triangles.push_back({{first + 2, first + 6, first + 3}, 0});
  const StartPlaces places(scene, noScenery);
  const Vector2d middle = places.middle().value();
  EXPECT_GT(std::abs(middle.y()), 9.0);
}

TEST(StartPlaces, OfTheMiddleNeedGround) {
  Scene scene = emptyScene();
  addWall(scene, {0, 0, 0}, {10, 0, 0}, 1.0);
  EXPECT_EQ(StartPlaces(scene, noScenery).middle(), std::nullopt);
}

}  // namespace
}  // namespace bumper::examples
