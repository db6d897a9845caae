#pragma once

#include <Eigen/Geometry>
#include <array>

#include "bumper/scenes/scene.h"

namespace bumper {

/// The corners of a triangle, m.
using TriangleCorners = std::array<Eigen::Vector3d, 3>;

inline TriangleCorners cornersOf(const Scene& scene, const Scene::Triangle& triangle) {
  return {scene.corner(triangle, 0), scene.corner(triangle, 1), scene.corner(triangle, 2)};
}

inline Eigen::AlignedBox3d boxOf(const TriangleCorners& corners) {
  return {corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]),
          corners[0].cwiseMax(corners[1]).cwiseMax(corners[2])};
}

}  // namespace bumper
