#include "bumper/scenes/scene_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/walls.h"
#include "temporary_files.h"

namespace bumper {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Files hold single precision: 24 bits of coordinates below 2,048 m.
constexpr double singlePrecision = 2048.0 / (1 << 24);

constexpr double rounding = 1e-12;

Vector3d areaVector(const Scene& scene, const Scene::Triangle& triangle) {
  return 0.5 * (scene.corner(triangle, 1) - scene.corner(triangle, 0))
                   .cross(scene.corner(triangle, 2) - scene.corner(triangle, 0));
}

Eigen::AlignedBox3d box(const Scene& scene) {
  Eigen::AlignedBox3d result;
  for (const Vector3d& vertex : scene.vertices) result.extend(vertex);
  return result;
}

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

// ---- there and back

struct RoundTripFormat {
  std::string ending;
  bool isolate;  ///< the format is not read in process
  bool names;    ///< the format keeps them
};

class RoundTrip : public TemporaryFiles, public ::testing::WithParamInterface<RoundTripFormat> {
 protected:
  void check(const Scene& scene) {
    const std::filesystem::path file = path("scene." + GetParam().ending);
    saveScene(scene, file);
    LoadOptions options{.isolate = GetParam().isolate};
    if (GetParam().ending != "glb") options.up = UpAxis::z;
    LoadReport report;
    const Scene loaded = loadScene(file, options, &report);
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

using SceneFiles = TemporaryFiles;

TEST_F(SceneFiles, CourseSurvivesAGlbFile) {
  const Scene scene = course();
  saveScene(scene, path("course.glb"));
  const Scene loaded = loadScene(path("course.glb"));
  EXPECT_EQ(loaded.triangles.size(), 8780U);
  EXPECT_EQ(selectWalls(loaded).report.walls, 1838U);
  EXPECT_LT((box(loaded).min() - box(scene).min()).norm(), singlePrecision);
  EXPECT_LT((box(loaded).max() - box(scene).max()).norm(), singlePrecision);
}

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

TEST_F(SceneFiles, LoadingTellsHowItGoesOn) {
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
  for (const bool isolate : {false, true}) {
    std::vector<Told> told;
    loadScene(path("course.obj"),
              {.up = UpAxis::z, .isolate = isolate, .progress = [&](LoadStage stage, double share) {
                 told.push_back({stage, share});
               }});
    expectOrderly(told);
    const auto converting = std::count_if(told.begin(), told.end(), [](const Told& each) {
      return each.stage == LoadStage::converting && each.share > 0.0 && each.share < 1.0;
    });
    EXPECT_EQ(converting > 0, !isolate);
  }
}

TEST_F(SceneFiles, SavingSaysWhatIsWrong) {
  EXPECT_THAT([&] { saveScene(testRail(), path("rail.dwg")); },
              ThrowsMessage<Error>(AllOf(HasSubstr("rail.dwg"), HasSubstr(".glb"))));
  EXPECT_THAT([&] { saveScene(testRail(), path("nowhere") / "rail.obj"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("nowhere"), HasSubstr("cannot be written"))));
  EXPECT_THAT([&] { saveScene(Scene{}, path("empty.obj")); },
              ThrowsMessage<Error>(AllOf(HasSubstr("empty.obj"), HasSubstr("no triangle"))));
}

// ---- axes and units

constexpr const char* oneTriangleObj = "v 1 2 3\nv 5 2 3\nv 1 2 10\nf 1 2 3\n";

TEST_F(SceneFiles, TurnTheStatedAxisUpward) {
  const std::filesystem::path file = write("a.obj", oneTriangleObj);
  const auto corners = [&](UpAxis up) {
    const Scene scene = loadScene(file, {.up = up, .scale = 0.5});
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

TEST_F(SceneFiles, MissingUpIsAnErrorWithBothReadings) {
  // A floor of 4 × 6 in x and y, three walls on its edges. With y up, two of them lie flat and the
  // floor stands.
  const std::filesystem::path file =
      write("hall.obj",
            "v 0 0 0\nv 4 0 0\nv 4 6 0\nv 0 6 0\nv 0 0 2.5\nv 4 0 2.5\nv 4 6 2.5\nv 0 6 2.5\n"
            "f 1 2 3 4\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n");
  EXPECT_THAT(
      [&] { loadScene(file); },
      ThrowsMessage<Error>("scene file \"" + file.string() +
                           "\" does not state which axis is up (format: Wavefront Object): set "
                           "LoadOptions::up. It extends 4 x 6 x 2.5 (x, y, z); of 8 triangles, "
                           "by their slope, 4 are walls with y up, 6 with z up"));
  EXPECT_EQ(selectWalls(loadScene(file, {.up = UpAxis::y})).report.walls, 4U);
  EXPECT_EQ(selectWalls(loadScene(file, {.up = UpAxis::z})).report.walls, 6U);
}

TEST_F(SceneFiles, GivenAxisWinsOverTheFiles) {
  saveScene(straightWall({0, 0}, {3, 0}, 1.0), path("wall.glb"));
  EXPECT_EQ(selectWalls(loadScene(path("wall.glb"))).report.walls, 2U);
  // Its y axis is the scene's height: read as z-up, the wall lies on the ground.
  EXPECT_EQ(selectWalls(loadScene(path("wall.glb"), {.up = UpAxis::z})).report.walls, 0U);
}

std::string fbx(int upAxis, int sign, double unit) {
  const auto property = [](const std::string& name, const std::string& type, const std::string& v) {
    return "    P: \"" + name + "\", \"" + type + "\", \"\", \"\"," + v + "\n";
  };
  return "; FBX 7.4.0 project file\n"
         "FBXHeaderExtension:  {\n  FBXHeaderVersion: 1003\n  FBXVersion: 7400\n}\n"
         "GlobalSettings:  {\n  Version: 1000\n  Properties70:  {\n" +
         property("UpAxis", "int", std::to_string(upAxis)) +
         property("UpAxisSign", "int", std::to_string(sign)) +
         property("UnitScaleFactor", "double", std::to_string(unit)) +
         "  }\n}\n"
         "Objects:  {\n"
         "  Geometry: 11, \"Geometry::fence\", \"Mesh\" {\n"
         "    Vertices: *9 {\n      a: 0,0,0,300,0,0,0,0,100\n    }\n"
         "    PolygonVertexIndex: *3 {\n      a: 0,1,-3\n    }\n"
         "    GeometryVersion: 124\n  }\n"
         "  Model: 12, \"Model::fence\", \"Mesh\" {\n    Version: 232\n  }\n}\n"
         "Connections:  {\n  C: \"OO\",12,0\n  C: \"OO\",11,12\n}\n";
}

TEST_F(SceneFiles, FbxStatesAxisAndUnit) {
  LoadReport report;
  const Scene centimetres = loadScene(write("z.fbx", fbx(2, 1, 1.0)), {}, &report);
  EXPECT_EQ(report.up, UpAxis::z);
  EXPECT_EQ(report.metresPerUnit, 0.01);
  EXPECT_LT((box(centimetres).max() - Vector3d(3, 0, 1)).norm(), rounding);
  EXPECT_EQ(centimetres.meshes.at(0).name, "fence");

  const Scene metres = loadScene(write("y.fbx", fbx(1, 1, 100.0)), {.scale = 2.0}, &report);
  EXPECT_EQ(report.up, UpAxis::y);
  EXPECT_EQ(report.metresPerUnit, 2.0);
  EXPECT_LT((box(metres).min() - Vector3d(0, -200, 0)).norm(), rounding);
  EXPECT_LT((box(metres).max() - Vector3d(600, 0, 0)).norm(), rounding);

  EXPECT_THAT([&] { loadScene(write("down.fbx", fbx(1, -1, 1.0))); },
              ThrowsMessage<Error>(AllOf(HasSubstr("down.fbx"), HasSubstr("pointing down"))));
}

TEST_F(SceneFiles, ColladaStatesAxisAndUnit) {
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
  const Scene scene = loadScene(file, {.isolate = true});
  EXPECT_LT((box(scene).max() - Vector3d(3, 0, 1)).norm(), singlePrecision);
  EXPECT_LT((box(scene).min() - Vector3d(0, 0, 0)).norm(), singlePrecision);
}

TEST_F(SceneFiles, OptionsOutOfRangeAreErrors) {
  const std::filesystem::path file = write("a.obj", oneTriangleObj);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT([&] { loadScene(file, {.up = UpAxis::z, .scale = bad}); },
                ThrowsMessage<Error>(HasSubstr("LoadOptions::scale")));
    EXPECT_THAT([&] { loadScene(file, {.up = UpAxis::z, .timeout = bad}); },
                ThrowsMessage<Error>(HasSubstr("LoadOptions::timeout")));
  }
  EXPECT_THAT([&] { loadScene(file, {.up = UpAxis::z, .memoryLimit = 1000}); },
              ThrowsMessage<Error>(HasSubstr("LoadOptions::memoryLimit is 1000 bytes")));
}

// ---- node transforms

TEST_F(SceneFiles, NodeTransformsAreAppliedAndMirroringKeepsTheOutsideOut) {
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
  const Scene scene = loadScene(file);
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
  EXPECT_LT((box(scene).min() - Vector3d(-2, 0, 0)).norm(), 1e-6);
  EXPECT_LT((box(scene).max() - Vector3d(10, 2, 1)).norm(), 1e-6);
}

// ---- polygons, welding, what is dropped

std::string polygonObj(const std::vector<Vector3d>& corners) {
  std::string text;
  std::string face = "f";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    text += "v " + std::to_string(corners[i].x()) + ' ' + std::to_string(corners[i].y()) + ' ' +
            std::to_string(corners[i].z()) + '\n';
    face += ' ' + std::to_string(i + 1);
  }
  return text + face + '\n';
}

TEST_F(SceneFiles, ConcavePolygonsAreCoveredOnceAndNotBeyond) {
  // A comb: its area is that of the shoelace formula, and no piece of it is turned over.
  std::vector<Vector3d> comb{{0, 0, 0}, {0, 0, 1}};
  for (int tooth = 7; tooth >= 0; --tooth) {
    comb.insert(comb.begin() + 1, {{2.0 * tooth, 0, 5}, {2.0 * tooth + 1.0, 0, 5}});
    comb.insert(comb.begin() + 3, {{2.0 * tooth + 1.0, 0, 1}, {2.0 * tooth + 2.0, 0, 1}});
  }
  comb.back() = {16, 0, 0};
  double expected = 0.0;
  for (std::size_t i = 0; i < comb.size(); ++i) {
    const Vector3d& a = comb[i];
    const Vector3d& b = comb[(i + 1) % comb.size()];
    expected += 0.5 * (a.x() * b.z() - b.x() * a.z());
  }
  ASSERT_NEAR(std::abs(expected), 8.0 * 4.0 + 16.0, rounding) << "of the comb itself";
  for (const bool reversed : {false, true}) {
    if (reversed) std::reverse(comb.begin(), comb.end());
    const Scene scene = loadScene(write("comb.obj", polygonObj(comb)), {.up = UpAxis::z});
    double area = 0.0;
    double signedArea = 0.0;
    for (const Scene::Triangle& triangle : scene.triangles) {
      // Seen along y: (x, z) counter-clockwise is the area vector pointing to -y.
      signedArea -= areaVector(scene, triangle).y();
      area += areaVector(scene, triangle).norm();
    }
    EXPECT_NEAR(area, std::abs(expected), 1e-5);
    EXPECT_NEAR(signedArea, reversed ? -expected : expected, 1e-5);
  }
}

TEST_F(SceneFiles, HugeConcavePolygonIsAnErrorHugeConvexIsNot) {
  std::vector<Vector3d> round;
  for (int i = 0; i < 1500; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / 1500.0;
    round.emplace_back(10.0 * std::cos(angle), 10.0 * std::sin(angle), 0.0);
  }
  EXPECT_EQ(loadScene(write("round.obj", polygonObj(round)), {.up = UpAxis::z}).triangles.size(),
            1498U);
  for (std::size_t i = 0; i < round.size(); i += 2) round[i] *= 0.9;
  EXPECT_THAT([&] { loadScene(write("star.obj", polygonObj(round)), {.up = UpAxis::z}); },
              ThrowsMessage<Error>(AllOf(HasSubstr("star.obj"), HasSubstr("1500 corners"))));
}

TEST_F(SceneFiles, ReportSaysWhatWasDropped) {
  const std::filesystem::path file =
      write("mixed.obj",
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0 0\nv 0 0 0\n"
            "f 1 2 3 4\n"     // two triangles
            "f 3 1 2\n"       // the first of them again
            "f 3 2 6\n"       // and from below, by another vertex in the same place
            "f 1 5 2\n"       // flat
            "f 1 6 2\n"       // two corners in one place
            "f 2 3 4\n"       // overlaps the quad, but is another triangle
            "l 1 2\nl 2 3\n"  // lines
            "p 4\n");
  LoadReport report;
  const Scene scene = loadScene(file, {.up = UpAxis::z}, &report);
  EXPECT_EQ(scene.triangles.size(), 3U);
  EXPECT_EQ(report.triangles, 3U);
  EXPECT_EQ(report.droppedDuplicate, 2U);
  EXPECT_EQ(report.droppedDegenerate, 2U);
  EXPECT_EQ(report.droppedPointsAndLines, 3U);
  EXPECT_EQ(scene.vertices.size() - 1, 4U) << "four places, and the one of a triangle dropped";
  EXPECT_GT(report.weldedVertices, 0U);
}

TEST_F(SceneFiles, CornersAreWeldedOnlyWhereTheyFallTogether) {
  // Two triangles that share an edge in the file's mind: 4 µm apart is the same, 1 mm is not.
  const auto load = [&](const std::string& gap) {
    return loadScene(write("gap.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nv " + gap + " 0 0\nv " + gap +
                                          " 0 1\nv -1 0 0\nf 1 2 3\nf 4 5 6\n"),
                     {.up = UpAxis::z});
  };
  EXPECT_EQ(load("-0.000004").vertices.size(), 4U);
  EXPECT_EQ(load("-0.001").vertices.size(), 6U);
}

}  // namespace
}  // namespace bumper
