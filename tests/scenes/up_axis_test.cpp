// A file may state one axis and be built along another: read that way, its ground is a wall.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "scene_building.h"
#include "temporary_files.h"

namespace bumper::tests {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class UpAxes : public TemporaryFiles {
 protected:
  [[nodiscard]] std::vector<std::string> warningsOf(const Scene& scene, UpAxis up) const {
    saveScene(scene, path("scene.obj"));
    LoadReport report;
    loadTrustedScene(path("scene.obj"), {.up = up}, &report);
    EXPECT_EQ(report.up, up);
    return report.warnings;
  }

  void expectOnlyZ(const Scene& scene) const {
    EXPECT_THAT(warningsOf(scene, UpAxis::z), IsEmpty());
    for (const UpAxis wrong : {UpAxis::x, UpAxis::y}) {
      EXPECT_THAT(warningsOf(scene, wrong),
                  ElementsAre(AllOf(HasSubstr("scene.obj"), HasSubstr("as if z were"))));
    }
  }
};

void addRectangle(Scene& scene, const Vector3d& corner, const Vector3d& u, const Vector3d& v) {
  addTriangle(scene, corner, corner + u, corner + u + v);
  addTriangle(scene, corner, corner + u + v, corner + v);
}

/// A floor with walls around it, and what else there is above it.
Scene room(const Vector3d& size, bool roofed, bool closed = true) {
  const Vector3d x(size.x(), 0, 0);
  const Vector3d y(0, size.y(), 0);
  const Vector3d z(0, 0, size.z());
  Scene scene;
  addRectangle(scene, {0, 0, 0}, x, y);
  addRectangle(scene, {0, 0, 0}, x, z);
  addRectangle(scene, y, x, z);
  if (closed) addRectangle(scene, {0, 0, 0}, y, z);
  if (closed) addRectangle(scene, x, y, z);
  if (roofed) addRectangle(scene, z, x, y);
  return scene;
}

TEST_F(UpAxes, OfRoomsAreSeen) {
  expectOnlyZ(room({30, 30, 5}, true));
  expectOnlyZ(room({30, 30, 5}, false));
  expectOnlyZ(room({400, 250, 1}, false));
  expectOnlyZ(course());
}

TEST_F(UpAxes, AreNotDoubtedWhereTheyMayBeRight) {
  // A tunnel, a street between houses, a tower: taller than wide, and as they should be.
  EXPECT_THAT(warningsOf(room({200, 8, 6}, true, false), UpAxis::z), IsEmpty());
  EXPECT_THAT(warningsOf(room({200, 12, 30}, false, false), UpAxis::z), IsEmpty());
  EXPECT_THAT(warningsOf(room({20, 20, 80}, true), UpAxis::z), IsEmpty());
  // Walls alone, thin and thick.
  EXPECT_THAT(warningsOf(straightWall({0, 0}, {60, 0}, 4.0), UpAxis::z), IsEmpty());
  EXPECT_THAT(warningsOf(testRail(), UpAxis::z), IsEmpty());
  EXPECT_THAT(warningsOf(room({60, 0.3, 0.9}, true), UpAxis::z), IsEmpty());
  // Ground alone.
  EXPECT_THAT(warningsOf(room({100, 100, 1e-3}, false), UpAxis::z), IsEmpty());
}

TEST_F(UpAxes, ThatAFileStatesAreNotTakenOnTrust) {
  const Scene hall = room({30, 30, 5}, true);
  LoadReport report;
  saveScene(hall, path("hall.glb"));
  for (const auto load : {loadTrustedScene, loadScene}) {
    load(path("hall.glb"), {}, &report);
    EXPECT_THAT(report.warnings, IsEmpty());
  }
  // As a converter writes it that does not turn: y stays y, and is up by the standard.
  Scene lying = hall;
  for (Vector3d& vertex : lying.vertices) vertex = {vertex.x(), -vertex.z(), vertex.y()};
  saveScene(lying, path("lying.glb"));
  for (const auto load : {loadTrustedScene, loadScene}) {
    load(path("lying.glb"), {}, &report);
    EXPECT_EQ(report.up, UpAxis::y);
    EXPECT_THAT(report.warnings,
                ElementsAre("scene file \"" + path("lying.glb").string() +
                            "\" was read with y up, but looks as if z were: it is then 5 m tall "
                            "instead of 30 m, with 1.8e+03 m² of level ground instead of 300 m²; "
                            "see LoadOptions::up"));
  }
  loadTrustedScene(path("lying.glb"), {.up = UpAxis::z}, &report);
  EXPECT_THAT(report.warnings, IsEmpty());
}

}  // namespace
}  // namespace bumper::tests
