// Time and memory of every stage grow as the number of triangles, up to a million, also where all
// of them are in one place. Time is counted as what takes it: bytes that are allocated, cells and
// levels that are looked at. A program of its own, because it replaces operator new.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "allocated_bytes.h"
#include "assimp_converter.h"
#include "bumper/scenes/wall_feet.h"
#include "bumper/scenes/wall_parts.h"
#include "bumper/scenes/wall_plan.h"
#include "bumper/scenes/walls.h"
#include "ground_levels.h"
#include "importer_scene.h"
#include "sanitized.h"
#include "scene_building.h"

namespace bumper {
namespace {

/// The bytes that a call allocates.
template <typename Call>
double bytesOf(const Call& call) {
  const std::size_t before = tests::allocatedBytes();
  call();
  return static_cast<double>(tests::allocatedBytes() - before);
}

/// `work` of n things, for n up to a million, is at most `most` for each.
template <typename Work>
void expectInProportion(const Work& work, double most) {
  for (const std::size_t n : {1'000UL, 10'000UL, 100'000UL, 1'000'000UL}) {
    if (tests::sanitized && n > 100'000) break;
    EXPECT_LE(work(n), most * static_cast<double>(n)) << n;
  }
}

Wall wallOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  Wall wall;
  wall.corners = {a, b, c};
  wall.normal = (b - a).cross(c - a).normalized();
  return wall;
}

/// Upright, 2 km long, all through one place.
std::vector<Wall> star(std::size_t n) {
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    const Eigen::Vector3d along(1000.0 * std::cos(angle), 1000.0 * std::sin(angle), 0.0);
    walls.push_back(wallOf(-along, along, along + Eigen::Vector3d::UnitZ()));
  }
  return walls;
}

/// That lean and overlap, 2 km wide.
std::vector<Wall> leaning(std::size_t n) {
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = 1e-4 * static_cast<double>(i);
    walls.push_back(
        wallOf({x - 1000.0, -250.0, -1000.0}, {x + 1000.0, -250.0, -1000.0}, {x, 250.0 + x, 1000}));
  }
  return walls;
}

TEST(Growth, OfThePlanOfWallsInOnePlace) {
  constexpr double most = 1500.0;  // bytes for each: 32 cells, in vectors that have grown
  expectInProportion(
      [](std::size_t n) {
        const std::vector<Wall> walls = star(n);
        return bytesOf([&] { static_cast<void>(WallPlan(walls)); });
      },
      most);
  expectInProportion(
      [](std::size_t n) {
        const std::vector<Wall> walls = leaning(n);
        return bytesOf([&] { static_cast<void>(WallPlan(walls)); });
      },
      most);
}

/// Storeys 1 m apart, each 100 m wide.
Scene tower(std::size_t n) {
  Scene scene;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = -static_cast<double>(i);
    tests::addTriangle(scene, {-50, -50, z}, {50, -50, z}, {0, 50, z});
  }
  return scene;
}

TEST(Growth, OfTheLevelsOfATower) {
  expectInProportion(
      [](std::size_t n) {
        const GroundLevels levels(tower(n), 0.3, 8.0);
        // The smallest grid has so many cells, and a cell so many levels.
        return static_cast<double>(levels.visits()) - 64.0 * 65536.0;
      },
      8.0 * 64.0);
}

TEST(Growth, OfTheReachOfLargeWalls) {
  expectInProportion(
      [](std::size_t n) {
        const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
        Scene scene;
        for (std::size_t i = 0; i < n / 2; ++i) {
          const double x = 5.0 * static_cast<double>(i % side);
          const double y = 5.0 * static_cast<double>(i / side);
          tests::addTriangle(scene, {x, y, 0}, {x + 5, y, 0}, {x + 5, y + 5, 0});
        }
        GroundLevels levels(scene, 0.3, 8.0);
        const double far = 5.0 * static_cast<double>(side);
        for (std::size_t i = 0; i < n / 2; ++i) {
          static_cast<void>(levels.placeOf(wallOf({0, 0, 20}, {far, far, 20}, {far, far, 21}), {}));
        }
        // No less than what is allowed to any scene.
        return static_cast<double>(levels.visits()) - static_cast<double>(std::size_t{1} << 22U);
      },
      1024.0);
}

TEST(Growth, OfSelectionAndWhatFollowsIt) {
  // A hedge of walls that share a corner, a fan of leaning triangles, ground.
  expectInProportion(
      [](std::size_t n) {
        Scene scene;
        for (std::size_t i = 0; i < n / 2; ++i) {
          const auto angle = [&](std::size_t k) {
            return 4.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
          };
          const auto rim = [&](std::size_t k, double radius, double z) {
            return Eigen::Vector3d(radius * std::cos(angle(k)), radius * std::sin(angle(k)), z);
          };
          tests::addTriangle(scene, {0, 0, 900}, rim(i + 1, 1000, 0), rim(i, 1000, 0));
          tests::addTriangle(scene, {0, 0, 4000}, rim(i, 900, 0), rim(i + 1, 900, 0));
        }
        return bytesOf([&] {
          const Walls walls = selectWalls(scene);
          wallParts(scene, walls);
          wallFeet(scene, walls.walls);
          static_cast<void>(WallPlan(walls.walls));
        });
      },
      6000.0);
}

TEST(Growth, OfCopiesOfAMesh) {
  for (const unsigned n : {1'000U, 10'000U, 100'000U}) {
    const std::unique_ptr<aiScene> scene = bumper::testing::importedTriangle({0, 1, 2}, "copy", n);
    const double bytes = bytesOf([&] {
      FileScene result;
      convert("copies.ply", *scene, {}, result, [](LoadStage, double) {});
      EXPECT_EQ(result.scene.triangles.size(), n);
    });
    EXPECT_LE(bytes, 1000.0 * n) << n;
  }
}

}  // namespace
}  // namespace bumper
