// Every race track of torcs-data that is there: loads, and loses no wall that a car can hit.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "bumper/scenes/scene_files.h"
#include "bumper/scenes/walls.h"
#include "standing_car.h"
#include "track_files.h"

namespace bumper {
namespace {

class AllTracks : public ::testing::Test {
 protected:
  AllTracks() : files(tests::trackFiles(BUMPER_TRACKS_DIR)) {}
  void SetUp() override {
    if (files.empty()) {
      GTEST_SKIP() << "no track in " << BUMPER_TRACKS_DIR
                   << ": examples/fetch_tracks.sh --all gets them";
    }
  }
  std::vector<std::filesystem::path> files;
};

TEST_F(AllTracks, Load) {
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    LoadReport report;
    Scene scene;
    ASSERT_NO_THROW(scene = loadTrustedScene(file, {.up = UpAxis::y}, &report));
    EXPECT_EQ(report.triangles, scene.triangles.size());
    EXPECT_TRUE(report.warnings.empty());
    const WallReport walls = selectWalls(scene).report;
    EXPECT_EQ(walls.walls + walls.dropped(), scene.triangles.size());
    // Race tracks have walls, and more road and land than walls within reach.
    EXPECT_GT(walls.walls, 1000U);
    EXPECT_GT(walls.droppedFlat, 1000U);
  }
}

TEST_F(AllTracks, ReadLyingOnTheirSideAreWarnedAbout) {
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    LoadReport report;
    for (const UpAxis wrong : {UpAxis::x, UpAxis::z}) {
      loadTrustedScene(file, {.up = wrong}, &report);
      EXPECT_EQ(report.warnings.size(), 1U);
    }
  }
}

/// Cars that stand on a triangle of the track, or in its plane beside it.
TEST_F(AllTracks, NoCarTouchesWhatIsOutOfReach) {
  std::size_t touching = 0;
  std::size_t dropped = 0;
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    const Scene scene = loadTrustedScene(file, {.up = UpAxis::y});
    const Walls all = selectWalls(scene, {.dropRepeated = false, .groundReach = std::nullopt});
    const Walls kept = selectWalls(scene, {.dropRepeated = false});
    dropped += kept.report.droppedOverhead + kept.report.droppedBuried;
    std::mt19937_64 random(11);
    std::uniform_int_distribution<std::size_t> any(0, scene.triangles.size() - 1);
    std::uniform_real_distribution<double> turn(-std::numbers::pi, std::numbers::pi);
    for (int i = 0; i < 2000; ++i) {
      const Scene::Triangle& triangle = scene.triangles[any(random)];
      const Eigen::Vector3d& a = scene.corner(triangle, 0);
      const Eigen::Vector3d& b = scene.corner(triangle, 1);
      const Eigen::Vector3d& c = scene.corner(triangle, 2);
      Eigen::Vector3d up = (b - a).cross(c - a).normalized();
      if (up.z() < 0.0) up = -up;
      const double yaw = turn(random);
      if (up.z() < std::cos(30.0 * std::numbers::pi / 180.0)) continue;
      // Rails and beams carry nothing.
      if (0.5 * (b - a).cross(c - a).norm() < 4.0) continue;
      const Eigen::Vector3d place = (a + b + c) / 3.0;
      const Eigen::Vector3d left =
          up.cross(Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0.0)).normalized();
      const Eigen::Vector3d forward = left.cross(up);
      std::array<Eigen::Vector3d, 4> wheels;
      for (std::size_t k = 0; k < 4; ++k) {
        wheels.at(k) = place + (k < 2 ? 1.4 : -1.4) * forward + (k % 2 == 0 ? 0.9 : -0.9) * left;
      }
      const tests::StandingCar car = tests::carOn(wheels, 0.9, 0.3, 0.75);
      const auto unreduced = tests::touchingWalls(car, all.walls);
      touching += unreduced.size();
      ASSERT_EQ(tests::touchingWalls(car, kept.walls), unreduced) << place.transpose();
    }
  }
  EXPECT_GT(touching, 100U);
  if (files.size() == 38) {
    EXPECT_GT(dropped, 1000U);
  }
}

}  // namespace
}  // namespace bumper
