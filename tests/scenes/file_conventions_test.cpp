// Which way is up in a file, and how long its unit is.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "bumper/scenes/walls.h"
#include "fbx_file.h"
#include "scene_measures.h"
#include "temporary_files.h"

namespace bumper::tests {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double rounding = 1e-12;

using FileConventions = TemporaryFiles;

constexpr const char* oneTriangleObj = "v 1 2 3\nv 5 2 3\nv 1 2 10\nf 1 2 3\n";

TEST_F(FileConventions, TurnTheStatedAxisUpward) {
  const std::filesystem::path file = write("a.obj", oneTriangleObj);
  const auto corners = [&](UpAxis up) {
    const Scene scene = loadTrustedScene(file, {.up = up, .scale = 0.5});
    return std::array{scene.corner(scene.triangles.at(0), 0),
                      scene.corner(scene.triangles.at(0), 1),
                      scene.corner(scene.triangles.at(0), 2)};
  };
  EXPECT_EQ(corners(UpAxis::z),
            (std::array<Vector3d, 3>{{{0.5, 1, 1.5}, {2.5, 1, 1.5}, {0.5, 1, 5}}}));
  EXPECT_EQ(corners(UpAxis::y),
            (std::array<Vector3d, 3>{{{0.5, -1.5, 1}, {2.5, -1.5, 1}, {0.5, -5, 1}}}));
  EXPECT_EQ(corners(UpAxis::x),
            (std::array<Vector3d, 3>{{{1, 1.5, 0.5}, {1, 1.5, 2.5}, {1, 5, 0.5}}}));
}

TEST_F(FileConventions, MissingUpIsAnErrorWithBothReadings) {
  // A floor of 4 × 6 in x and y, three walls on its edges. With y up, two of them lie flat and the
  // floor stands.
  const std::filesystem::path file =
      write("hall.obj",
            "v 0 0 0\nv 4 0 0\nv 4 6 0\nv 0 6 0\nv 0 0 2.5\nv 4 0 2.5\nv 4 6 2.5\nv 0 6 2.5\n"
            "f 1 2 3 4\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n");
  EXPECT_THAT(
      [&] { loadTrustedScene(file); },
      ThrowsMessage<Error>("scene file \"" + file.string() +
                           "\" does not state which axis is up (format: Wavefront Object): set "
                           "LoadOptions::up. It extends 4 x 6 x 2.5 (x, y, z); of 8 triangles, "
                           "by their slope, 4 are walls with y up, 6 with z up"));
  EXPECT_EQ(selectWalls(loadTrustedScene(file, {.up = UpAxis::y})).report.walls, 4U);
  EXPECT_EQ(selectWalls(loadTrustedScene(file, {.up = UpAxis::z})).report.walls, 6U);
}

TEST_F(FileConventions, GivenAxisWinsOverTheFiles) {
  saveScene(straightWall({0, 0}, {3, 0}, 1.0), path("wall.glb"));
  EXPECT_EQ(selectWalls(loadTrustedScene(path("wall.glb"))).report.walls, 2U);
  // Its y axis is the scene's height: read as z-up, the wall lies on the ground.
  EXPECT_EQ(selectWalls(loadTrustedScene(path("wall.glb"), {.up = UpAxis::z})).report.walls, 0U);
}

TEST_F(FileConventions, FbxStatesAxisAndUnit) {
  LoadReport report;
  const Scene centimetres = loadTrustedScene(write("z.fbx", fbxFile({.up = 2})), {}, &report);
  EXPECT_EQ(report.up, UpAxis::z);
  EXPECT_EQ(report.metresPerUnit, 0.01);
  EXPECT_LT((boxOf(centimetres).max() - Vector3d(3, 0, 1)).norm(), rounding);
  EXPECT_EQ(centimetres.meshes.at(0).name, "fence");

  const Scene metres =
      loadTrustedScene(write("y.fbx", fbxFile({.unit = 100.0})), {.scale = 2.0}, &report);
  EXPECT_EQ(report.up, UpAxis::y);
  EXPECT_EQ(report.metresPerUnit, 2.0);
  EXPECT_LT((boxOf(metres).min() - Vector3d(0, -200, 0)).norm(), rounding);
  EXPECT_LT((boxOf(metres).max() - Vector3d(600, 0, 0)).norm(), rounding);

  EXPECT_THAT([&] { loadTrustedScene(write("down.fbx", fbxFile({.upSign = -1}))); },
              ThrowsMessage<Error>(AllOf(HasSubstr("down.fbx"), HasSubstr("pointing down"))));
}

TEST_F(FileConventions, ColladaStatesAxisAndUnit) {
  const std::filesystem::path file = write("fence.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.01" name="centimeter"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 300 0 0 0 0 100</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)");
  const Scene scene = loadScene(file);
  EXPECT_LT((boxOf(scene).max() - Vector3d(3, 0, 1)).norm(), singlePrecision);
  EXPECT_LT((boxOf(scene).min() - Vector3d(0, 0, 0)).norm(), singlePrecision);
}

}  // namespace
}  // namespace bumper::tests
