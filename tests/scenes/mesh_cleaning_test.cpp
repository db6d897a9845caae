// What loadScene() makes of a file's polygons: cut into triangles, welded, the useless ones
// dropped.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bumper/response/error.h"
#include "bumper/scenes/scene_files.h"
#include "scene_measures.h"
#include "temporary_files.h"

namespace bumper::tests {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double rounding = 1e-12;

using MeshCleaning = TemporaryFiles;

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

TEST_F(MeshCleaning, ConcavePolygonsAreCoveredOnceAndNotBeyond) {
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
    const Scene scene = loadTrustedScene(write("comb.obj", polygonObj(comb)), {.up = UpAxis::z});
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

TEST_F(MeshCleaning, HugeConcavePolygonIsAnErrorHugeConvexIsNot) {
  std::vector<Vector3d> round;
  for (int i = 0; i < 1500; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / 1500.0;
    round.emplace_back(10.0 * std::cos(angle), 10.0 * std::sin(angle), 0.0);
  }
  EXPECT_EQ(
      loadTrustedScene(write("round.obj", polygonObj(round)), {.up = UpAxis::z}).triangles.size(),
      1498U);
  for (std::size_t i = 0; i < round.size(); i += 2) round[i] *= 0.9;
  EXPECT_THAT([&] { loadTrustedScene(write("star.obj", polygonObj(round)), {.up = UpAxis::z}); },
              ThrowsMessage<Error>(AllOf(HasSubstr("star.obj"), HasSubstr("1500 corners"))));
}

TEST_F(MeshCleaning, ReportSaysWhatWasDropped) {
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
  const Scene scene = loadTrustedScene(file, {.up = UpAxis::z}, &report);
  EXPECT_EQ(scene.triangles.size(), 3U);
  EXPECT_EQ(report.triangles, 3U);
  EXPECT_EQ(report.droppedDuplicate, 2U);
  EXPECT_EQ(report.droppedDegenerate, 2U);
  EXPECT_EQ(report.droppedPointsAndLines, 3U);
  EXPECT_EQ(scene.vertices.size() - 1, 4U) << "four places, and the one of a triangle dropped";
  EXPECT_GT(report.weldedVertices, 0U);
}

TEST_F(MeshCleaning, CornersAreWeldedOnlyWhereTheyFallTogether) {
  // Two triangles that share an edge in the file's mind: 4 µm apart is the same, 1 mm is not.
  const auto load = [&](const std::string& gap) {
    return loadTrustedScene(write("gap.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nv " + gap + " 0 0\nv " +
                                                 gap + " 0 1\nv -1 0 0\nf 1 2 3\nf 4 5 6\n"),
                            {.up = UpAxis::z});
  };
  EXPECT_EQ(load("-0.000004").vertices.size(), 4U);
  EXPECT_EQ(load("-0.001").vertices.size(), 6U);
}

}  // namespace
}  // namespace bumper::tests
