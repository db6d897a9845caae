// Which walls make one face, and that a face is nothing but its walls.

#include "wall_face.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace bumper::tests {
namespace {

using Eigen::Vector3d;

Wall wallOf(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return {.corners = {a, b, c}, .normal = (b - a).cross(c - a).normalized()};
}

// The plane that faces stand in: no axis of the world lies in it.
const Vector3d along = Vector3d(0.8, 0.6, 0.0);
const Vector3d up = Vector3d(-0.06, 0.08, 1.0).normalized();

Vector3d at(double x, double z) { return Vector3d(31.0, -17.0, 0.4) + x * along + z * up; }

double areaOf(const Wall& wall) {
  const auto& [a, b, c] = wall.corners;
  return 0.5 * (b - a).cross(c - a).norm();
}

double areaOf(const WallFace& face) {
  Vector3d sum = Vector3d::Zero();
  const std::span<const Vector3d> corners = face.corners();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    sum += (corners[k] - corners[0]).cross(corners[(k + 1) % corners.size()] - corners[0]);
  }
  return 0.5 * sum.norm();
}

bool isCorner(const WallFace& face, const Vector3d& place) {
  return std::ranges::any_of(face.corners(),
                             [&](const Vector3d& each) { return (each - place).norm() < 1e-9; });
}

TEST(WallFace, TwoTrianglesOfAPanel) {
  for (const bool otherDiagonal : {false, true}) {
    WallFace face(otherDiagonal ? wallOf(at(0, 0), at(2, 0), at(0, 1))
                                : wallOf(at(0, 0), at(2, 0), at(2, 1)));
    EXPECT_TRUE(face.add(otherDiagonal ? wallOf(at(2, 0), at(2, 1), at(0, 1))
                                       : wallOf(at(0, 0), at(2, 1), at(0, 1))));
    EXPECT_EQ(face.corners().size(), 4U);
    EXPECT_NEAR(areaOf(face), 2.0, 1e-12);
  }
}

TEST(WallFace, PanelsAboveOneAnotherAreOneRectangle) {
  WallFace face(wallOf(at(0, 0), at(2, 0), at(2, 0.3)));
  EXPECT_TRUE(face.add(wallOf(at(0, 0), at(2, 0.3), at(0, 0.3))));
  for (int k = 1; k < 5; ++k) {
    const double z = 0.3 * k;
    EXPECT_TRUE(face.add(wallOf(at(0, z), at(2, z), at(2, z + 0.3)))) << k;
    EXPECT_TRUE(face.add(wallOf(at(0, z), at(2, z + 0.3), at(0, z + 0.3)))) << k;
    EXPECT_EQ(face.corners().size(), 4U) << k;
  }
  for (const Vector3d& corner : {at(0, 0), at(2, 0), at(2, 1.5), at(0, 1.5)}) {
    EXPECT_TRUE(isCorner(face, corner));
  }
}

TEST(WallFace, PanelsBesideOneAnotherAreNot) {
  WallFace face(wallOf(at(0, 0), at(2, 0), at(2, 1)));
  EXPECT_TRUE(face.add(wallOf(at(0, 0), at(2, 1), at(0, 1))));
  EXPECT_FALSE(face.add(wallOf(at(2, 0), at(4, 1), at(2, 1))));
  EXPECT_FALSE(face.add(wallOf(at(2, 0), at(4, 0), at(2, 1))));
  EXPECT_NEAR(areaOf(face), 2.0, 1e-12);
}

TEST(WallFace, WhatIsNotOneConvexPlaneIsLeftAlone) {
  const Wall first = wallOf(at(0, 0), at(2, 0), at(2, 1));
  const Vector3d aside = 1e-6 * along.cross(up);
  const std::array<Wall, 6> others = {
      wallOf(at(0, 0), at(2, 1), at(0, 1) + aside),  // bent by a micrometre
      wallOf(at(0, 0), at(0, 1), at(2, 1)),          // of the other winding
      wallOf(at(0, 0), at(2, -1), at(2, 0)),         // below it
      wallOf(at(0, 0), at(1.5, 3), at(0, 1)),        // … with a notch
      wallOf(at(3, 0), at(5, 0), at(5, 1)),          // apart
      wallOf(at(0, 0), at(1, 0.5), at(0, 1)),        // along a part of a side only
  };
  for (std::size_t k = 0; k < others.size(); ++k) {
    WallFace face(first);
    EXPECT_EQ(face.add(others[k]), k == 2) << k;
    if (k == 2) continue;
    EXPECT_EQ(face.corners().size(), 3U) << k;
    EXPECT_NEAR(areaOf(face), 1.0, 1e-12) << k;
  }
}

TEST(WallFace, AnyTriangulationOfAConvexPolygon) {
  // A face may refuse a triangle, but what it took is a convex polygon of the same area.
  std::mt19937 random(11);
  int taken = 0;
  for (int i = 0; i < 500; ++i) {
    std::uniform_int_distribution<int> count(3, 9);
    const int corners = count(random);
    std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
    std::vector<double> angles;
    for (int k = 0; k < corners; ++k) angles.push_back(angle(random));
    std::ranges::sort(angles);
    std::vector<Vector3d> polygon;
    for (const double each : angles) {
      polygon.push_back(at(5.0 * std::cos(each), 2.0 * std::sin(each)));
    }
    // Ears from anywhere.
    WallFace face;
    double area = 0.0;
    for (bool isFirst = true; polygon.size() >= 3; isFirst = false) {
      std::uniform_int_distribution<std::size_t> which(0, polygon.size() - 1);
      const std::size_t ear = which(random);
      const std::size_t before = (ear + polygon.size() - 1) % polygon.size();
      const std::size_t after = (ear + 1) % polygon.size();
      const Wall wall = wallOf(polygon[before], polygon[ear], polygon[after]);
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
      if (areaOf(wall) < 1e-3) break;
      if (isFirst) {
        face = WallFace(wall);
        area = areaOf(wall);
      } else if (face.add(wall)) {
        area += areaOf(wall);
        ++taken;
      }
      EXPECT_NEAR(areaOf(face), area, 1e-7) << i;
      const std::span<const Vector3d> now = face.corners();
      for (std::size_t k = 0; k < now.size(); ++k) {
        const Vector3d side = now[(k + 1) % now.size()] - now[k];
        const Vector3d next = now[(k + 2) % now.size()] - now[(k + 1) % now.size()];
        EXPECT_GT(face.normal().dot(side.cross(next)), 0.0) << i;
      }
    }
  }
  EXPECT_GT(taken, 100);
}

TEST(WallFace, HasNoMoreCornersThanItCanKeep) {
  // A half disc, its arc made of more and more corners.
  const auto onArc = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return at(3.0 * std::cos(angle), 3.0 * std::sin(angle));
  };
  WallFace face(wallOf(at(-3, 0), at(3, 0), onArc(90)));
  std::size_t taken = 0;
  for (const double degrees : {45.0, 135.0, 22.5, 67.5, 112.5, 157.5, 11.25}) {
    const double half = degrees == 45.0 || degrees == 135.0 ? 45.0
                        : degrees == 11.25                  ? 11.25
                                                            : 22.5;
    const Wall ear = wallOf(onArc(degrees - half), onArc(degrees), onArc(degrees + half));
    if (face.add(ear)) ++taken;
  }
  EXPECT_EQ(taken, WallFace::mostCorners - 3);
  EXPECT_EQ(face.corners().size(), WallFace::mostCorners);
}

}  // namespace
}  // namespace bumper::tests
