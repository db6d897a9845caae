#include "bumper/scenes/wall_parts.h"

#include <gtest/gtest.h>

#include "bumper/scenes/paper_scenes.h"
#include "scene_building.h"

namespace bumper::tests {
namespace {

std::vector<WallPart> partsOf(const Scene& scene) { return wallParts(scene, selectWalls(scene)); }

TEST(WallParts, FacesCapsAndGround) {
  Scene scene = straightWall({0.0, 0.0}, {10.0, 0.0}, 1.0);  // triangles 0 and 1
  addTriangle(scene, {0, 0, 1}, {10, 0, 1}, {10, -0.3, 1});  // 2: its top
  addTriangle(scene, {0, 0, 0}, {10, 0, 0}, {10, 5, 0});     // 3: ground at its foot
  addTriangle(scene, {0, 0, 1}, {0, -9, 1}, {-9, -9, 1});    // 4: ground behind it
  addTriangle(scene, {50, 0, 1}, {60, 0, 1}, {60, 5, 1});    // 5: elsewhere, as high
  const std::vector<WallPart> parts = partsOf(scene);
  ASSERT_EQ(parts.size(), 6U);
  using Kind = WallPart::Kind;
  const Kind expected[] = {Kind::face, Kind::face, Kind::cap, Kind::none, Kind::cap, Kind::none};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(parts[i].kind, expected[i]) << i;
    if (expected[i] == Kind::none) continue;
    EXPECT_EQ(parts[i].foot, 0.0) << i;
    EXPECT_EQ(parts[i].top, 1.0) << i;
  }
}

TEST(WallParts, ASecondSkinIsAFace) {
  Scene scene = straightWall({0.0, 0.0}, {10.0, 0.0}, 1.0);
  const std::vector<Scene::Triangle> once = scene.triangles;
  for (Scene::Triangle triangle : once) {
    std::swap(triangle.corners[0], triangle.corners[1]);  // facing the other way
    scene.triangles.push_back(triangle);
  }
  ASSERT_EQ(selectWalls(scene).walls.size(), 2U);
  for (const WallPart& part : partsOf(scene)) EXPECT_EQ(part.kind, WallPart::Kind::face);
}

// Two of the slab's four long edges are upper ones; its top is made of 17 quads in either wall.
TEST(WallParts, TheTestRailsTops) {
  const Scene scene = testRail();
  std::size_t caps = 0;
  const std::vector<WallPart> parts = partsOf(scene);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].kind != WallPart::Kind::cap) continue;
    ++caps;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_DOUBLE_EQ(scene.corner(scene.triangles[i], k).z(), 0.9);
    }
  }
  EXPECT_EQ(caps, 2U * 17U * 2U);
}

}  // namespace
}  // namespace bumper::tests
