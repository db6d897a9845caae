// Tiny walls by the thousand: what a step asks for is few, and it is their outside. The oracle is
// each wall's own corners, or the radius of a ball.

#include "fine_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "bumper/scenes/scene.h"
#include "bumper/scenes/walls.h"

namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;

const VehicleParameters car{.mass = 1500.0,
                            .yawInertia = 2600.0,
                            .massCentreToFront = 2.1,
                            .massCentreToRear = 2.5,
                            .width = 1.8,
                            .massCentreHeight = 0.55};
const Envelope envelope{car, Band{.bottom = 0.3, .top = 0.75}};

// A surface over a square, in so many rows and columns.
Scene surface(int columns, int rows, const std::function<Eigen::Vector3d(double, double)>& at) {
  Scene scene;
  scene.meshes.emplace_back();
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      scene.vertices.push_back(at(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
    }
  }
  const auto corner = [&](int i, int j) {
    return static_cast<std::uint32_t>(j * (columns + 1) + i);
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      scene.triangles.push_back({{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)}, 0});
      scene.triangles.push_back({{corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)}, 0});
    }
  }
  return scene;
}

WallTable tableOf(const Scene& scene) {
  return {selectWalls(scene, {.maxNormalUp = 0.95}).walls, scene};
}

VehicleState standingAt(const Eigen::Vector3d& place, double yaw = 0.0) {
  VehicleState state;
  state.massCentre = place;
  state.axes = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return state;
}

std::vector<FineWalls::Crowd> crowdsNear(const FineWalls& fine, const VehicleState& state,
                                         double reach = 1.0) {
  std::vector<FineWalls::Crowd> crowds;
  fine.find(envelope, state, envelope.outline().enlarged(reach), crowds);
  return crowds;
}

// How far a point is beyond all sides of the polygon that it is least beyond, m.
double beyond(const std::vector<FineWalls::Crowd>& crowds, const Vector2& point) {
  double least = 1e9;
  for (const FineWalls::Crowd& crowd : crowds) {
    double most = -1e9;
    crowd.outside.forEachSide(
        [&](const Outside::Extreme& from, const Outside::Extreme&, const Vector2& normal) {
          most = std::max(most, normal.dot(point - from.point));
        });
    least = std::min(least, most);
  }
  return least;
}

Scene ball(const Eigen::Vector3d& middle, double radius, int rings) {
  return surface(2 * rings, rings, [&](double a, double b) -> Eigen::Vector3d {
    return middle + radius * Eigen::Vector3d(std::sin(pi * b) * std::cos(2.0 * pi * a),
                                             std::sin(pi * b) * std::sin(2.0 * pi * a),
                                             std::cos(pi * b));
  });
}

TEST(FineWalls, ABallIsOneCrowdOfItsRadius) {
  for (const int rings : {32, 64, 128}) {
    const WallTable table = tableOf(ball({2.3, 0.2, 0.5}, 0.05, rings));
    const FineWalls fine(table);
    for (const double yaw : {0.0, 0.7}) {
      const VehicleState state = standingAt({0.0, 0.0, 0.55}, yaw);
      const Vector2 middle = (state.axes.transpose() * Eigen::Vector3d(2.3, 0.2, 0.0)).head<2>();
      const std::vector<FineWalls::Crowd> crowds = crowdsNear(fine, state);
      ASSERT_EQ(crowds.size(), 1U);
      for (const Outside::Extreme& each : crowds[0].outside.extremes()) {
        EXPECT_NEAR((each.point - middle).norm(), 0.05, 0.001);
      }
    }
  }
}

// A ball of half a metre under the band but for its cap: the section there, not the equator.
TEST(FineWalls, OnlyThePartInTheBandCounts) {
  const double radius = 0.5;
  for (const double height : {-0.1, 0.05}) {
    const WallTable table = tableOf(ball({3.0, 0.0, height}, radius, 64));
    const FineWalls fine(table);
    const std::vector<FineWalls::Crowd> crowds =
        crowdsNear(fine, standingAt({0.0, 0.0, 0.55}), 2.0);
    ASSERT_FALSE(crowds.empty());
    const double section = std::sqrt(radius * radius - std::pow(0.3 - height, 2));
    double widest = 0.0;
    for (const FineWalls::Crowd& crowd : crowds) {
      for (const Outside::Extreme& each : crowd.outside.extremes()) {
        widest = std::max(widest, (each.point - Vector2(3.0, 0.0)).norm());
      }
    }
    EXPECT_NEAR(widest, section, 0.04);
  }
}

TEST(FineWalls, FarAwayOrAboveThereIsNone) {
  const WallTable table = tableOf(ball({2.3, 0.0, 0.5}, 0.05, 64));
  const FineWalls fine(table);
  EXPECT_TRUE(crowdsNear(fine, standingAt({-3.0, 0.0, 0.55})).empty());
  EXPECT_TRUE(crowdsNear(fine, standingAt({0.0, 0.0, 2.0})).empty());
  EXPECT_TRUE(crowdsNear(fine, standingAt({0.0, 0.0, -1.0})).empty());
}

// A rough wall of 96,000 triangles beside the car: few polygons, which hold all corners in reach
// and go no further than they do.
TEST(FineWalls, ARoughWallKeepsItsPlace) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> rough(-0.01, 0.01);
  const Scene scene = surface(600, 80, [&](double a, double b) -> Eigen::Vector3d {
    return {12.0 * (a - 0.5), 1.5 + rough(random), b};
  });
  const WallTable table = tableOf(scene);
  const FineWalls fine(table);
  for (const double x : {-2.0, 0.0, 0.37, 1.9}) {
    const std::vector<FineWalls::Crowd> crowds = crowdsNear(fine, standingAt({x, 0.0, 0.55}));
    EXPECT_LE(crowds.size(), FineWalls::most);
    for (const FineWalls::Crowd& crowd : crowds) {
      for (const Outside::Extreme& each : crowd.outside.extremes()) {
        EXPECT_NEAR(each.point.y(), 1.5, 0.0101);
      }
    }
    for (const Wall& wall : table) {
      for (const Eigen::Vector3d& corner : wall.corners) {
        const bool isInReach =
            corner.x() > x - 3.4 && corner.x() < x + 3.0 && corner.z() > 0.35 && corner.z() < 0.7;
        if (!isInReach) continue;
        ASSERT_LE(beyond(crowds, {corner.x() - x, corner.y()}), 0.02) << corner.transpose();
      }
    }
  }
}

TEST(FineWalls, AKnotIsFewPolygonsEverywhere) {
  const Scene scene = surface(1500, 16, [](double a, double b) -> Eigen::Vector3d {
    const double turn = 2.0 * pi * a;
    const Eigen::Vector3d out(std::cos(2.0 * turn), std::sin(2.0 * turn), 0.0);
    const Eigen::Vector3d line = (2.0 + std::cos(3.0 * turn)) * out;
    const Eigen::Vector3d up(0.0, 0.0, 0.25 * std::sin(3.0 * turn) + 0.5);
    return 0.5 * line + up + 0.05 * (std::cos(2.0 * pi * b) * out) +
           0.05 * std::sin(2.0 * pi * b) * Eigen::Vector3d::UnitZ();
  });
  const FineWalls fine(tableOf(scene));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-2.5, 2.5);
  for (int i = 0; i < 200; ++i) {
    EXPECT_LE(
        crowdsNear(fine, standingAt({place(random), place(random), 0.55}, place(random))).size(),
        FineWalls::most);
  }
}

TEST(FineWalls, WhatIsLargeOrNotManyIsNot) {
  const auto plane = [](double a, double b) -> Eigen::Vector3d { return {10.0 * a, 0.0, b}; };
  EXPECT_TRUE(FineWalls(tableOf(surface(30, 3, plane))).isEmpty());
  EXPECT_TRUE(FineWalls(tableOf(ball({2.3, 0.2, 0.55}, 0.05, 3))).isEmpty());
  EXPECT_FALSE(FineWalls(tableOf(ball({2.3, 0.2, 0.55}, 0.05, 16))).isEmpty());
}

TEST(FineWalls, ACornerInOnePlaceManyTimesEnds) {
  Scene scene;
  scene.meshes.emplace_back();
  scene.vertices = {{0.0, 0.0, 0.4}, {0.1, 0.0, 0.4}, {0.0, 0.0, 0.55}};
  for (int i = 0; i < 5000; ++i) scene.triangles.push_back({{0, 1, 2}, 0});
  const WallTable table(selectWalls(scene, {.dropRepeated = false}).walls, scene);
  ASSERT_EQ(table.size(), 5000U);
  const FineWalls fine(table);
  EXPECT_EQ(crowdsNear(fine, standingAt({0.0, 0.0, 0.55})).size(), 1U);
}

}  // namespace
}  // namespace bumper::tests
