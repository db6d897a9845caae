// Walls that are there twice: as the same triangle, or as the other half of a quad.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <random>

#include "bumper/scenes/walls.h"
#include "scene_building.h"

namespace bumper {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using tests::addTriangle;

const std::array<Vector3d, 4> square{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 0, 1),
                                     Vector3d(0, 0, 1)};

/// A quad cut along a diagonal.
void addQuad(Scene& scene, const std::array<Vector3d, 4>& q, bool other) {
  const std::size_t first = other ? 1 : 0;
  addTriangle(scene, q.at(first), q.at(first + 1), q.at(first + 2));
  addTriangle(scene, q.at(first), q.at(first + 2), q.at((first + 3) % 4));
}

TEST(RepeatedWalls, OneQuadIsLeftOfTwoThatAreCutDifferently) {
  Scene scene;
  addQuad(scene, square, false);
  addQuad(scene, square, true);
  const Walls walls = selectWalls(scene);
  ASSERT_EQ(walls.report.walls, 2U);
  EXPECT_EQ(walls.report.droppedRetriangulated, 2U);
  EXPECT_EQ(walls.walls[0].triangle, 0);
  EXPECT_EQ(walls.walls[1].triangle, 1);
  EXPECT_EQ(selectWalls(scene, {.dropRepeated = false}).report.walls, 4U);
}

TEST(RepeatedWalls, HalfAQuadIsDroppedToo) {
  Scene scene;
  addQuad(scene, square, false);
  addTriangle(scene, square[1], square[2], square[3]);
  EXPECT_EQ(selectWalls(scene).report.droppedRetriangulated, 1U);
}

TEST(RepeatedWalls, ASliverIsHalfOfNoQuad) {
  Scene scene;
  addQuad(scene, square, false);
  // Along the diagonal, and so thin that two of its corners count as one.
  addTriangle(scene, square[0], square[2], square[2] + Vector3d(-2e-6, 0, 0));
  addTriangle(scene, square[0], square[2], square[2] + Vector3d(0, 0, -2e-6));
  const Walls walls = selectWalls(scene);
  EXPECT_EQ(walls.report.droppedRetriangulated, 0U);
  ASSERT_GE(walls.report.walls, 2U);
  EXPECT_EQ(walls.walls[0].triangle, 0);
  EXPECT_EQ(walls.walls[1].triangle, 1);
}

TEST(RepeatedWalls, TwoHalvesOfDifferentCutsAreKept) {
  Scene scene;
  addTriangle(scene, square[0], square[1], square[2]);
  addTriangle(scene, square[1], square[2], square[3]);
  EXPECT_EQ(selectWalls(scene).report.walls, 2U);
}

TEST(RepeatedWalls, QuadThatIsNotPlaneIsTwoSurfaces) {
  std::array<Vector3d, 4> bent = square;
  bent[2].y() += 0.01;
  Scene scene;
  addQuad(scene, bent, false);
  addQuad(scene, bent, true);
  EXPECT_EQ(selectWalls(scene).report.walls, 4U);
}

TEST(RepeatedWalls, QuadWithACornerThatPointsInwardHasOneCut) {
  // An arrowhead: the triangles of the other diagonal reach beyond it.
  const std::array<Vector3d, 4> arrow{Vector3d(0, 0, 0), Vector3d(1, 0, 3), Vector3d(0, 0, 1),
                                      Vector3d(-1, 0, 3)};
  Scene scene;
  addQuad(scene, arrow, false);
  addQuad(scene, arrow, true);
  EXPECT_EQ(selectWalls(scene).report.walls, 4U);
}

TEST(RepeatedWalls, SwitchedOffKeepsTheSameTriangleTwice) {
  Scene scene;
  addTriangle(scene, square[0], square[1], square[2]);
  addTriangle(scene, square[2], square[1], square[0]);
  EXPECT_EQ(selectWalls(scene).report.droppedDuplicate, 1U);
  EXPECT_EQ(selectWalls(scene, {.dropRepeated = false}).report.walls, 2U);
}

/// Whether a point of the plane y = 0 lies in a wall.
bool covers(const Wall& wall, const Vector2d& point) {
  std::array<double, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& a = wall.corners.at(k);
    const Vector3d& b = wall.corners.at((k + 1) % 3);
    sides.at(k) = (b.x() - a.x()) * (point.y() - a.z()) - (b.z() - a.z()) * (point.x() - a.x());
  }
  return std::all_of(sides.begin(), sides.end(), [](double side) { return side > 0.0; }) ||
         std::all_of(sides.begin(), sides.end(), [](double side) { return side < 0.0; });
}

TEST(RepeatedWalls, WhatIsCoveredStaysCovered) {
  std::mt19937_64 random(7);
  const auto corner = [&] {
    std::uniform_int_distribution<int> grid(0, 3);
    const int x = grid(random);
    return Vector3d(x, 0.0, grid(random));
  };
  std::uniform_real_distribution<double> anywhere(0.0, 3.0);
  std::size_t dropped = 0;
  std::size_t covered = 0;
  for (int i = 0; i < 400; ++i) {
    // So many triangles of one grid overlap in all ways.
    Scene scene;
    for (int k = 0; k < 40; ++k) addTriangle(scene, corner(), corner(), corner());
    const Walls all = selectWalls(scene, {.dropRepeated = false});
    const Walls kept = selectWalls(scene);
    dropped += kept.report.droppedRetriangulated;
    const auto anyCovers = [](const Walls& walls, const Vector2d& point) {
      return std::any_of(walls.walls.begin(), walls.walls.end(),
                         [&](const Wall& wall) { return covers(wall, point); });
    };
    for (int k = 0; k < 100; ++k) {
      const double x = anywhere(random);
      const Vector2d point(x, anywhere(random));
      ASSERT_EQ(anyCovers(kept, point), anyCovers(all, point)) << point.transpose();
      covered += anyCovers(all, point) ? 1 : 0;
    }
  }
  EXPECT_GT(dropped, 200U);
  EXPECT_GT(covered, 10000U);
}

}  // namespace
}  // namespace bumper
