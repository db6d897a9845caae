// What saveScene() writes, loadScene() reads back.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "bumper/scenes/walls.h"
#include "scene_measures.h"
#include "temporary_files.h"
#include "temporary_folder.h"

namespace bumper::tests {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::namesIn;
using ::testing::ThrowsMessage;

void expectSameTriangles(const Scene& actual, const Scene& expected) {
  ASSERT_EQ(actual.triangles.size(), expected.triangles.size());
  for (std::size_t i = 0; i < expected.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT((actual.corner(actual.triangles[i], k) - expected.corner(expected.triangles[i], k))
                    .norm(),
                singlePrecision)
          << "triangle " << i << ", corner " << k;
    }
  }
}

struct RoundTripFormat {
  std::string ending;
  bool isolate;  ///< read in a process of its own
  bool names;    ///< the format keeps them
};

class RoundTrip : public TemporaryFiles, public ::testing::WithParamInterface<RoundTripFormat> {
 protected:
  void check(const Scene& scene) {
    const std::filesystem::path file = path("scene." + GetParam().ending);
    saveScene(scene, file);
    LoadOptions options;
    if (GetParam().ending != "glb") options.up = UpAxis::z;
    LoadReport report;
    const auto load = GetParam().isolate ? loadScene : loadTrustedScene;
    const Scene loaded = load(file, options, &report);
    EXPECT_NO_THROW(validate(loaded));
    expectSameTriangles(loaded, scene);
    EXPECT_EQ(loaded.name, "scene");
    EXPECT_EQ(report.triangles, scene.triangles.size());
    EXPECT_EQ(report.droppedDegenerate + report.droppedDuplicate + report.droppedPointsAndLines,
              0U);
    EXPECT_EQ(report.metresPerUnit, 1.0);
    EXPECT_EQ(selectWalls(loaded).walls.size(), selectWalls(scene).walls.size());
    if (GetParam().names) {
      checkMeshes(loaded, scene);
    } else {
      EXPECT_EQ(loaded.meshes.size(), 1U);
    }
  }

 private:
  static void checkMeshes(const Scene& loaded, const Scene& scene) {
    ASSERT_EQ(loaded.meshes.size(), scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
      EXPECT_EQ(loaded.meshes[i].name, scene.meshes[i].name);
      EXPECT_EQ(loaded.meshes[i].material, scene.meshes[i].material);
      EXPECT_LT((loaded.meshes[i].colour - scene.meshes[i].colour).norm(), 1e-3F);
    }
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
      EXPECT_EQ(loaded.triangles[i].mesh, scene.triangles[i].mesh);
    }
  }
};

TEST_P(RoundTrip, KeepsTheTestRail) { check(testRail()); }

TEST_P(RoundTrip, KeepsAWallInRows) { check(straightWall({-3, 4}, {50, 60}, 1.5, 9, 3)); }

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         ::testing::Values(RoundTripFormat{"obj", false, true},
                                           RoundTripFormat{"stl", false, false},
                                           RoundTripFormat{"ply", true, false},
                                           RoundTripFormat{"glb", false, true}),
                         [](const auto& format) { return format.param.ending; });

using SavedScenes = TemporaryFiles;

TEST_F(SavedScenes, CourseSurvivesAGlbFile) {
  const Scene scene = course();
  saveScene(scene, path("course.glb"));
  const Scene loaded = loadTrustedScene(path("course.glb"));
  EXPECT_EQ(loaded.triangles.size(), 8780U);
  EXPECT_EQ(selectWalls(loaded).report.walls, 1838U);
  EXPECT_LT((boxOf(loaded).min() - boxOf(scene).min()).norm(), singlePrecision);
  EXPECT_LT((boxOf(loaded).max() - boxOf(scene).max()).norm(), singlePrecision);
}

TEST_F(SavedScenes, SavingSaysWhatIsWrong) {
  EXPECT_THAT([&] { saveScene(testRail(), path("rail.dwg")); },
              ThrowsMessage<Error>(AllOf(HasSubstr("rail.dwg"), HasSubstr(".glb"))));
  EXPECT_THAT([&] { saveScene(testRail(), path("nowhere") / "rail.obj"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("nowhere"), HasSubstr("cannot be written"))));
  EXPECT_THAT([&] { saveScene(Scene{}, path("empty.obj")); },
              ThrowsMessage<Error>(AllOf(HasSubstr("empty.obj"), HasSubstr("no triangle"))));
}

class SaveScene : public TemporaryFiles {};

TEST_F(SaveScene, theFullDiskIsAnErrorAndTheOldFileStays) {
  for (const char* ending : {".obj", ".stl", ".ply", ".glb"}) {
    const std::filesystem::path file = path(std::string("full") + ending);
    create_symlink("/dev/full", file);
    EXPECT_THAT([&] { saveScene(course(), file); },
                ThrowsMessage<Error>(AllOf(HasSubstr(file.string()), HasSubstr("No space left"))))
        << ending;
    EXPECT_TRUE(is_symlink(file)) << ending;
  }
}

TEST_F(SaveScene, namesWithDotsAndBytesOfAnyKindAreWritten) {
  const std::filesystem::path folder = path("inside");
  std::filesystem::create_directory(folder);
  saveScene(course(), folder / "a.b c\xE9.obj");
  EXPECT_THAT(namesIn(folder), ::testing::ElementsAre("a.b c\xE9.mtl", "a.b c\xE9.obj"));
  std::ifstream text(folder / "a.b c\xE9.obj");
  const std::string all(std::istreambuf_iterator<char>(text), {});
  EXPECT_THAT(all, HasSubstr("mtllib a.b c\xE9.mtl\n"));
}

}  // namespace
}  // namespace bumper::tests
