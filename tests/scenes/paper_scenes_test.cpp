#include "bumper/scenes/paper_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "bumper/response/error.h"
#include "bumper/scenes/walls.h"
#include "scene_measures.h"

namespace bumper {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using tests::areaVector;

constexpr double rounding = 1e-9;  // of sums over many triangles of a scene 100 m wide

std::map<std::string, std::size_t> trianglesOfMeshes(const Scene& scene) {
  std::map<std::string, std::size_t> count;
  for (const Scene::Triangle& triangle : scene.triangles) ++count[scene.meshes[triangle.mesh].name];
  return count;
}

Vector3d centre(const Scene& scene, const Scene::Triangle& triangle) {
  return (scene.corner(triangle, 0) + scene.corner(triangle, 1) + scene.corner(triangle, 2)) / 3.0;
}

/// How often each directed edge of a mesh occurs.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> directedEdges(const Scene& scene,
                                                                     std::uint32_t mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Scene::Triangle& triangle : scene.triangles) {
    if (triangle.mesh != mesh) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{triangle.corners.at(k), triangle.corners.at((k + 1) % 3)}];
    }
  }
  return edges;
}

void expectEveryVertexIsUsed(const Scene& scene) {
  std::set<std::uint32_t> used;
  for (const Scene::Triangle& triangle : scene.triangles) {
    used.insert(triangle.corners.begin(), triangle.corners.end());
  }
  EXPECT_EQ(used.size(), scene.vertices.size());
}

// ---- test rail

TEST(TestRail, HasThePapersNumberOfTriangles) {
  const Scene scene = testRail();
  EXPECT_NO_THROW(validate(scene));
  EXPECT_EQ(scene.triangles.size(), 612U);
  const std::map<std::string, std::size_t> expected{
      {"side_wall", 106}, {"end_wall", 106}, {"ground", 400}};
  EXPECT_EQ(trianglesOfMeshes(scene), expected);
  expectEveryVertexIsUsed(scene);
}

TEST(TestRail, FacesStandOnTheStatedLines) {
  struct Face {
    std::uint32_t mesh;
    Vector2d point;
    Vector2d normal;
  };
  const Scene scene = testRail();
  for (const Face& face : {Face{0, {42.334, -0.900}, Vector2d(-0.10453, 0.99452).normalized()},
                           Face{1, {67.197, 1.713}, Vector2d(-0.98163, -0.19081).normalized()}}) {
    SCOPED_TRACE(scene.meshes[face.mesh].name);
    double area = 0.0;
    double shortest = std::numeric_limits<double>::infinity();
    double longest = -shortest;
    for (const Scene::Triangle& triangle : scene.triangles) {
      if (triangle.mesh != face.mesh) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d& corner = scene.corner(triangle, k);
        const double depth = face.normal.dot(face.point - corner.head<2>());
        EXPECT_NEAR(std::abs(depth - 0.15), 0.15, rounding) << "neither front nor back";
        EXPECT_NEAR(std::abs(corner.z() - 0.45), 0.45, rounding) << "neither foot nor top";
        const double along =
            Vector2d(face.normal.y(), -face.normal.x()).dot(corner.head<2>() - face.point);
        shortest = std::min(shortest, along);
        longest = std::max(longest, along);
      }
      const Vector3d vector = areaVector(scene, triangle);
      if (vector.head<2>().dot(face.normal) > 0.999 * vector.norm()) area += vector.norm();
    }
    EXPECT_NEAR(area, 60.0 * 0.9, rounding) << "of the face towards the car";
    EXPECT_NEAR(longest - shortest, 60.0, rounding);
  }
}

TEST(TestRail, WallsMeetAtTheCorner) {
  const Scene scene = testRail();
  std::array<Vector2d, 2> nearest;
  const Vector2d corner(67.197, 1.713);  // of physics to a millimetre
  for (const Scene::Triangle& triangle : scene.triangles) {
    if (triangle.mesh > 1) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector2d place = scene.corner(triangle, k).head<2>();
      Vector2d& best = nearest.at(triangle.mesh);
      if ((place - corner).norm() < (best - corner).norm()) best = place;
    }
  }
  EXPECT_LT((nearest[0] - nearest[1]).norm(), rounding);
  EXPECT_LT((nearest[0] - corner).norm(), 2e-3);
}

TEST(TestRail, SlabsAreWatertightAboveGroundAndFaceOutward) {
  const Scene scene = testRail();
  for (const std::uint32_t mesh : {0U, 1U}) {
    SCOPED_TRACE(scene.meshes[mesh].name);
    const auto edges = directedEdges(scene, mesh);
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      const auto back = edges.find({edge.second, edge.first});
      const bool onGround =
          scene.vertices[edge.first].z() == 0.0 && scene.vertices[edge.second].z() == 0.0;
      EXPECT_EQ(back == edges.end(), onGround);
    }
    // The divergence theorem, two ways; the open bottom adds nothing to either.
    double volumeBySides = 0.0;
    double volumeByTop = 0.0;
    for (const Scene::Triangle& triangle : scene.triangles) {
      if (triangle.mesh != mesh) continue;
      const Vector3d area = areaVector(scene, triangle);
      const Vector3d middle = centre(scene, triangle);
      volumeBySides += 0.5 * area.head<2>().dot(middle.head<2>());
      volumeByTop += area.z() * middle.z();
    }
    EXPECT_NEAR(volumeBySides, 60.0 * 0.3 * 0.9, rounding);
    EXPECT_NEAR(volumeByTop, 60.0 * 0.3 * 0.9, rounding);
  }
}

TEST(TestRail, GroundIsFlatAndReachesBeyondEverything) {
  const Scene scene = testRail();
  double area = 0.0;
  Eigen::AlignedBox2d ground;
  Eigen::AlignedBox2d walls;
  for (const Scene::Triangle& triangle : scene.triangles) {
    const Vector3d vector = areaVector(scene, triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      (triangle.mesh == 2 ? ground : walls).extend(scene.corner(triangle, k).head<2>());
    }
    if (triangle.mesh != 2) continue;
    EXPECT_GT(vector.z(), 0.0);
    EXPECT_EQ(vector.head<2>().norm(), 0.0);
    area += vector.z();
  }
  EXPECT_NEAR(area, ground.volume(), rounding);
  walls.extend(Vector2d(0, 0));
  EXPECT_TRUE(
      ground.contains(Eigen::AlignedBox2d(walls.min().array() - 5.0, walls.max().array() + 5.0)));
}

// ---- course

TEST(Course, HasThePapersNumbersOfTriangles) {
  const Scene scene = course();
  EXPECT_NO_THROW(validate(scene));
  EXPECT_EQ(scene.triangles.size(), 8780U);
  const std::map<std::string, std::size_t> expected{
      {"inner_wall", 918}, {"outer_wall", 920}, {"road", 2314}, {"verge", 4628}};
  EXPECT_EQ(trianglesOfMeshes(scene), expected);
  expectEveryVertexIsUsed(scene);

  const WallReport report = selectWalls(scene).report;
  EXPECT_EQ(report.walls, 1838U);
  EXPECT_EQ(report.droppedFlat, 6942U);
  EXPECT_EQ(report.lowestFoot, 0.0);
  EXPECT_EQ(report.highestTop, 1.0);
}

TEST(Course, CentreLineIsClosedAndEvenAndAsLongAsStated) {
  const std::size_t count = 5400;
  const std::vector<Vector2d> line = courseCentreLine(count);
  ASSERT_EQ(line.size(), count);
  double length = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double spacing = (line[(i + 1) % count] - line[i]).norm();
    EXPECT_NEAR(spacing, 1.0, 1e-3);
    length += spacing;
  }
  EXPECT_NEAR(length, 5400.0, 54.0);
  EXPECT_EQ(line[0], Vector2d(0, 0));
  EXPECT_NEAR(std::atan2(line[1].y(), line[1].x()), 0.0, 1e-3);
}

TEST(Course, BendsAreWideAndTheDriveIsClockwise) {
  const std::vector<Vector2d> line = courseCentreLine(1080);
  double turned = 0.0;
  double tightest = std::numeric_limits<double>::infinity();
  bool turnsLeftSomewhere = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector2d a = line[(i + 1) % line.size()] - line[i];
    const Vector2d b = line[(i + 2) % line.size()] - line[(i + 1) % line.size()];
    const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    turned += angle;
    turnsLeftSomewhere = turnsLeftSomewhere || angle > 0.05;
    tightest = std::min(tightest, a.norm() / std::abs(angle));
  }
  EXPECT_NEAR(turned, -2.0 * std::numbers::pi, 1e-9);
  EXPECT_TRUE(turnsLeftSomewhere);
  EXPECT_GT(tightest, 60.0);
}

TEST(Course, DoesNotComeNearItself) {
  const std::vector<Vector2d> line = courseCentreLine(1080);  // 5 m apart
  for (std::size_t i = 0; i < line.size(); ++i) {
    for (std::size_t k = i + 1; k < line.size(); ++k) {
      const std::size_t apart = std::min(k - i, line.size() - (k - i));
      if (apart < 40) continue;
      EXPECT_GT((line[i] - line[k]).norm(), 80.0) << 5 * i << " m and " << 5 * k << " m";
    }
  }
}

TEST(Course, WallsAreClosedFaceTheRoadAndStandSevenMetresFromItsMiddle) {
  const Scene scene = course();
  const std::vector<Vector2d> line = courseCentreLine(5400);
  const auto nearest = [&](const Vector2d& place) {
    return *std::min_element(line.begin(), line.end(), [&](const Vector2d& a, const Vector2d& b) {
      return (a - place).squaredNorm() < (b - place).squaredNorm();
    });
  };
  for (const Scene::Triangle& triangle : scene.triangles) {
    if (triangle.mesh > 1) continue;
    const Vector2d foot = scene.corner(triangle, 0).head<2>();
    const Vector2d middle = nearest(foot);
    // Points of the line are 1 m apart: half of that to the side at most.
    EXPECT_NEAR((foot - middle).norm(), 7.0, 0.02);
    EXPECT_GT(areaVector(scene, triangle).head<2>().normalized().dot((middle - foot).normalized()),
              0.9);
  }
  for (const std::uint32_t mesh : {0U, 1U}) {
    const auto edges = directedEdges(scene, mesh);
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      const bool level = scene.vertices[edge.first].z() == scene.vertices[edge.second].z();
      EXPECT_EQ(edges.count({edge.second, edge.first}), level ? 0U : 1U)
          << "open only at foot and top";
    }
  }
}

TEST(Course, GroundIsFlatAndClosed) {
  const Scene scene = course();
  double area = 0.0;
  for (const Scene::Triangle& triangle : scene.triangles) {
    if (triangle.mesh < 2) continue;
    const Vector3d vector = areaVector(scene, triangle);
    EXPECT_GT(vector.z(), 0.0);
    area += vector.z();
  }
  // Pappus: the area of a band is its width times the length of its middle.
  EXPECT_NEAR(area, 24.0 * 5400.0, 0.001 * 24.0 * 5400.0);
}

TEST(Course, CanBeMeshedMoreFinely) {
  const Scene scene =
      course({.innerPanels = 5000, .outerPanels = 5000, .groundAlong = 5000, .groundAcross = 8});
  EXPECT_EQ(scene.triangles.size(), 100000U);
  EXPECT_EQ(selectWalls(scene).report.walls, 20000U);
}

TEST(Course, RejectsTooCoarseMeshes) {
  EXPECT_THAT([] { course({.innerPanels = 49}); },
              ThrowsMessage<Error>(HasSubstr("CourseMesh::innerPanels is 49")));
  EXPECT_THAT([] { course({.outerPanels = 0}); }, ThrowsMessage<Error>(HasSubstr("outerPanels")));
  EXPECT_THAT([] { course({.groundAlong = 3}); }, ThrowsMessage<Error>(HasSubstr("groundAlong")));
  EXPECT_THAT([] { course({.groundAcross = 0}); }, ThrowsMessage<Error>(HasSubstr("groundAcross")));
  EXPECT_THAT([] { courseCentreLine(2); }, ThrowsMessage<Error>(HasSubstr("points is 2")));
}

// ---- straight wall

TEST(StraightWall, IsTheSameWallHoweverItIsMeshed) {
  struct Mesh {
    std::size_t panels;
    std::size_t rows;
    std::size_t triangles;
  };
  for (const Mesh& mesh : {Mesh{1, 1, 2}, Mesh{612, 1, 1224}, Mesh{102, 6, 1224}}) {
    const Scene scene = straightWall({1, 2}, {4, 6}, 0.8, mesh.panels, mesh.rows);
    EXPECT_EQ(scene.triangles.size(), mesh.triangles);
    EXPECT_EQ(scene.vertices.size(), (mesh.panels + 1) * (mesh.rows + 1));
    Vector3d area = Vector3d::Zero();
    Eigen::AlignedBox3d box;
    for (const Scene::Triangle& triangle : scene.triangles) area += areaVector(scene, triangle);
    for (const Vector3d& vertex : scene.vertices) box.extend(vertex);
    // 5 m × 0.8 m, facing left of the way (3, 4).
    EXPECT_LT((area - 4.0 * Vector3d(-0.8, 0.6, 0.0)).norm(), rounding);
    EXPECT_EQ(box.min(), Vector3d(1, 2, 0));
    EXPECT_EQ(box.max(), Vector3d(4, 6, 0.8));
  }
}

TEST(StraightWall, RejectsWhatIsNoWall) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([] { straightWall({0, 0}, {1, 0}, 0.0); }, ThrowsMessage<Error>(HasSubstr("height")));
  EXPECT_THAT(
      [&] {
        straightWall({0, 0}, {1, 0}, nan);
      },
      ThrowsMessage<Error>(HasSubstr("height")));
  EXPECT_THAT([] { straightWall({1, 0}, {1, 0}, 1.0); }, ThrowsMessage<Error>(HasSubstr("apart")));
  EXPECT_THAT(
      [&] {
        straightWall({1, 0}, {nan, 0}, 1.0);
      },
      ThrowsMessage<Error>(HasSubstr("finite")));
  EXPECT_THAT(
      [] {
        straightWall({0, 0}, {1, 0}, 1.0, 0);
      },
      ThrowsMessage<Error>(HasSubstr("panel")));
  EXPECT_THAT(
      [] {
        straightWall({0, 0}, {1, 0}, 1.0, 1, 0);
      },
      ThrowsMessage<Error>(HasSubstr("row")));
}

}  // namespace
}  // namespace bumper
