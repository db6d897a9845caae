// Real scenes: tracks of the game TORCS, whose descriptions state how tall their walls are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "bumper/scenes/scene_files.h"
#include "bumper/scenes/walls.h"

namespace bumper {
namespace {

class Tracks : public ::testing::Test {
 protected:
  static std::filesystem::path track(const std::string& name) {
    return std::filesystem::path(BUMPER_TRACKS_DIR) / name;
  }
};

#define BUMPER_NEED_TRACK(file)       \
  if (!std::filesystem::exists(file)) \
  GTEST_SKIP() << (file) << " is not there: extract torcs-data and set BUMPER_TRACKS_DIR"

struct Counts {
  std::string name;
  std::string file;
  std::size_t triangles;
  std::size_t dropped;
  std::size_t meshes;
  std::size_t walls;
  Eigen::Vector3d extents;  ///< m
};

class TrackCounts : public Tracks, public ::testing::WithParamInterface<Counts> {};

TEST_P(TrackCounts, AreThoseCountedByOtherMeans) {
  const std::filesystem::path file = track(GetParam().file);
  BUMPER_NEED_TRACK(file);
  LoadReport report;
  const Scene scene = loadTrustedScene(file, {.up = UpAxis::y}, &report);
  EXPECT_EQ(report.triangles + report.droppedDegenerate + report.droppedDuplicate,
            GetParam().triangles);
  EXPECT_EQ(report.droppedDegenerate + report.droppedDuplicate, GetParam().dropped);
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_EQ(scene.meshes.size(), GetParam().meshes);
  // The others are parts of rails, posts and hedges.
  const Walls all = selectWalls(scene, {.dropRepeated = false, .groundReach = std::nullopt});
  EXPECT_EQ(std::count_if(all.walls.begin(), all.walls.end(),
                          [](const Wall& wall) { return std::abs(wall.normal.z()) <= 0.3 + 1e-9; }),
            static_cast<std::ptrdiff_t>(GetParam().walls));
  Eigen::Vector3d low = scene.vertices.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& vertex : scene.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  EXPECT_LT((high - low - GetParam().extents).cwiseAbs().maxCoeff(), 0.5);
}

INSTANTIATE_TEST_SUITE_P(
    Tracks, TrackCounts,
    ::testing::Values(
        Counts{"aalborg", "road/aalborg/aalborg.acc", 11698, 0, 1315, 4323, {853, 798, 39}},
        Counts{"speedway", "oval/a-speedway/a-speedway.ac", 4336, 2, 241, 1022, {931, 571, 18}},
        Counts{"forza", "road/forza/forza.acc", 71775, 361, 3856, 38067, {2468, 1317, 91}}),
    [](const auto& counts) { return counts.param.name; });

TEST_F(Tracks, AreReadAlikeInProcessAndInIsolation) {
  const std::filesystem::path file = track("road/aalborg/aalborg.acc");
  BUMPER_NEED_TRACK(file);
  const Scene inProcess = loadTrustedScene(file, {.up = UpAxis::y});
  const Scene isolated = loadScene(file, {.up = UpAxis::y});
  EXPECT_EQ(inProcess.name, isolated.name);
  EXPECT_EQ(inProcess.vertices, isolated.vertices);
  ASSERT_EQ(inProcess.triangles.size(), isolated.triangles.size());
  for (std::size_t i = 0; i < inProcess.triangles.size(); ++i) {
    EXPECT_EQ(inProcess.triangles[i].corners, isolated.triangles[i].corners);
    EXPECT_EQ(inProcess.triangles[i].mesh, isolated.triangles[i].mesh);
  }
  ASSERT_EQ(inProcess.meshes.size(), isolated.meshes.size());
  for (std::size_t i = 0; i < inProcess.meshes.size(); ++i) {
    EXPECT_EQ(inProcess.meshes[i].name, isolated.meshes[i].name);
    EXPECT_EQ(inProcess.meshes[i].material, isolated.meshes[i].material);
    EXPECT_EQ(inProcess.meshes[i].colour, isolated.meshes[i].colour);
  }
}

/// Length of a triangle's vertical edge, m: what the description gives, also where the track
/// climbs.
double uprightEdge(const Wall& wall) {
  double height = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d edge = wall.corners.at((k + 1) % 3) - wall.corners.at(k);
    if (edge.head<2>().norm() < 0.01) height = std::max(height, std::abs(edge.z()));
  }
  return height;
}

TEST_F(Tracks, BarriersAreAsTallAsTheTracksDescriptionStates) {
  const std::filesystem::path file = track("road/aalborg/aalborg.acc");
  BUMPER_NEED_TRACK(file);
  const Scene scene = loadTrustedScene(file, {.up = UpAxis::y});
  // aalborg.xml: "Left Barrier" and "Right Barrier" are 0.6 m tall, on some segments 3.0 m. The
  // file names their meshes B…LT… and B…RT….
  const auto isBarrier = [&](const Wall& wall) {
    std::string name =
        scene.meshes[scene.triangles[static_cast<std::size_t>(wall.triangle)].mesh].name;
    std::erase_if(name, [](char c) { return c >= '0' && c <= '9'; });
    return name == "BLT" || name == "BRT";
  };
  std::size_t barriers = 0;
  std::size_t low = 0;
  std::size_t tall = 0;
  for (const Wall& wall : selectWalls(scene).walls) {
    if (!isBarrier(wall)) continue;
    ++barriers;
    // Where a tall barrier meets a low one, the tall one's end shows above it.
    const double edge = uprightEdge(wall);
    const double stated = edge < 1.0 ? 0.6 : edge < 2.7 ? 3.0 - 0.6 : 3.0;
    EXPECT_NEAR(edge, stated, 1e-3);
    EXPECT_GE(wall.top - wall.foot, edge - 1e-9);
    low += std::abs(wall.top - wall.foot - 0.6) < 0.05 ? 1 : 0;
    tall += std::abs(wall.top - wall.foot - 3.0) < 0.05 ? 1 : 0;
  }
  // The numbers of triangles that extend by just as much, over the level parts of the track.
  EXPECT_GE(low, 1452U);
  EXPECT_GE(tall, 378U);
  EXPECT_LT(low + tall, barriers);
}

}  // namespace
}  // namespace bumper
