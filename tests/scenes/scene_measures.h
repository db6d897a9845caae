#pragma once

#include <Eigen/Geometry>

#include "bumper/scenes/scene.h"

namespace bumper::tests {

/// Files hold single precision: 24 bits of coordinates below 2,048 m.
constexpr double singlePrecision = 2048.0 / (1 << 24);

/// A triangle's normal, as long as its area, m².
inline Eigen::Vector3d areaVector(const Scene& scene, const Scene::Triangle& triangle) {
  return 0.5 * (scene.corner(triangle, 1) - scene.corner(triangle, 0))
                   .cross(scene.corner(triangle, 2) - scene.corner(triangle, 0));
}

inline Eigen::AlignedBox3d boxOf(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : scene.vertices) box.extend(vertex);
  return box;
}

}  // namespace bumper::tests
