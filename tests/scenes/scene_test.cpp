#include "bumper/scenes/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "bumper/response/error.h"

namespace bumper {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Scene oneTriangle() {
  Scene scene;
  scene.name = "yard";
  scene.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  scene.triangles = {{{0, 1, 2}, 0}};
  scene.meshes.resize(1);
  return scene;
}

TEST(ScenesComponent, ShowsNoHeadersOfSceneFiles) {
#if __has_include("bumper/scenes/scene_files.h")
  FAIL() << "scene_files.h is for those who link bumper::scene_files";
#endif
}

TEST(SceneValidation, AcceptsATriangle) { EXPECT_NO_THROW(validate(oneTriangle())); }

TEST(SceneValidation, NamesTheSceneAndTheDefect) {
  Scene scene = oneTriangle();
  scene.triangles.clear();
  EXPECT_THAT([&] { validate(scene); },
              ThrowsMessage<Error>(AllOf(HasSubstr("yard"), HasSubstr("no triangle"))));

  scene = oneTriangle();
  scene.triangles[0].corners[1] = 3;
  EXPECT_THAT([&] { validate(scene); },
              ThrowsMessage<Error>(AllOf(HasSubstr("triangle 0"), HasSubstr("vertex 3"))));

  scene = oneTriangle();
  scene.triangles[0].mesh = 1;
  EXPECT_THAT([&] { validate(scene); },
              ThrowsMessage<Error>(AllOf(HasSubstr("triangle 0"), HasSubstr("mesh 1"))));

  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    scene = oneTriangle();
    scene.vertices[2].y() = bad;
    EXPECT_THAT([&] { validate(scene); },
                ThrowsMessage<Error>(AllOf(HasSubstr("vertex 2"), HasSubstr("finite"))));
  }
}

}  // namespace
}  // namespace bumper
