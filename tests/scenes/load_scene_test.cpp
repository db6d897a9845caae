// Options, progress and node transforms of loadScene().

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "scene_measures.h"
#include "temporary_files.h"

namespace bumper::tests {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using LoadScene = TemporaryFiles;

struct Told {
  LoadStage stage;
  double share;
};

/// Every stage begins with 0, ends with 1 and never goes back.
void expectOrderly(const std::vector<Told>& told) {
  ASSERT_GE(told.size(), 8U);
  EXPECT_EQ(told.front().stage, LoadStage::reading);
  EXPECT_EQ(told.front().share, 0.0);
  EXPECT_EQ(told.back().stage, LoadStage::dropping);
  EXPECT_EQ(told.back().share, 1.0);
  for (std::size_t i = 1; i < told.size(); ++i) {
    if (told[i].stage == told[i - 1].stage) {
      EXPECT_GE(told[i].share, told[i - 1].share);
      continue;
    }
    EXPECT_EQ(static_cast<int>(told[i].stage), static_cast<int>(told[i - 1].stage) + 1);
    EXPECT_EQ(told[i - 1].share, 1.0);
    EXPECT_EQ(told[i].share, 0.0);
  }
}

TEST_F(LoadScene, LoadingTellsHowItGoesOn) {
  Scene scene = course();
  // Many meshes, so that there is something to tell of them.
  scene.meshes.clear();
  for (int i = 0; i < 100; ++i) {
    scene.meshes.push_back({.name = "part " + std::to_string(i), .material = "", .colour = {}});
  }
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    scene.triangles[i].mesh = static_cast<std::uint32_t>(i % 100);
  }
  saveScene(scene, path("course.obj"));
  for (const auto load : {loadTrustedScene, loadScene}) {
    std::vector<Told> told;
    load(path("course.obj"),
         {.up = UpAxis::z,
          .progress =
              [&](LoadStage stage, double share) {
                told.push_back({stage, share});
              }},
         nullptr);
    expectOrderly(told);
    const auto converting = std::count_if(told.begin(), told.end(), [](const Told& each) {
      return each.stage == LoadStage::converting && each.share > 0.0 && each.share < 1.0;
    });
    EXPECT_EQ(converting > 0, load == loadTrustedScene);
  }
}

TEST_F(LoadScene, OptionsOutOfRangeAreErrors) {
  const std::filesystem::path file = write("a.obj", "v 1 2 3\nv 5 2 3\nv 1 2 10\nf 1 2 3\n");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT([&] { loadTrustedScene(file, {.up = UpAxis::z, .scale = bad}); },
                ThrowsMessage<Error>(HasSubstr("LoadOptions::scale")));
    EXPECT_THAT([&] { loadTrustedScene(file, {.up = UpAxis::z, .timeout = bad}); },
                ThrowsMessage<Error>(HasSubstr("LoadOptions::timeout")));
  }
  EXPECT_THAT([&] { loadTrustedScene(file, {.up = UpAxis::z, .memoryLimit = 1000}); },
              ThrowsMessage<Error>(HasSubstr("LoadOptions::memoryLimit is 1000 bytes")));
}

TEST_F(LoadScene, NodeTransformsAreAppliedAndMirroringKeepsTheOutsideOut) {
  // Three floats each: (0,0,0) (2,0,0) (0,1,0), as bytes in base 64. Two nodes use the same mesh:
  // one within another, moved and turned by 90° about y; one mirrored.
  const std::filesystem::path file = write("nodes.gltf", R"({
"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}],
"nodes": [
 {"name": "yard", "translation": [10, 0, 0], "children": [1]},
 {"name": "turned", "rotation": [0, 0.70710678118654752, 0, 0.70710678118654752], "mesh": 0},
 {"name": "mirrored", "scale": [-1, 1, 1], "mesh": 0}],
"meshes": [{"name": "m", "primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
 "min": [0, 0, 0], "max": [2, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36,
 "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  const Scene scene = loadTrustedScene(file);
  ASSERT_EQ(scene.triangles.size(), 2U);
  ASSERT_EQ(scene.meshes.size(), 2U);
  const auto triangle = [&](const std::string& name) {
    for (const Scene::Triangle& candidate : scene.triangles) {
      if (scene.meshes[candidate.mesh].name == name) return candidate;
    }
    ADD_FAILURE() << name << " is missing";
    return Scene::Triangle{};
  };
  // In the file's axes (y up) the triangle faces +z. Turned, it faces +x; mirrored in x, +z still.
  // A scene's (x, y, z) is the file's (x, -z, y).
  EXPECT_LT((areaVector(scene, triangle("turned")) - Vector3d(1, 0, 0)).norm(), 1e-6);
  EXPECT_LT((areaVector(scene, triangle("mirrored")) - Vector3d(0, -1, 0)).norm(), 1e-6);
  EXPECT_LT((boxOf(scene).min() - Vector3d(-2, 0, 0)).norm(), 1e-6);
  EXPECT_LT((boxOf(scene).max() - Vector3d(10, 2, 1)).norm(), 1e-6);
}

}  // namespace
}  // namespace bumper::tests
