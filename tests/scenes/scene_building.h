#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "bumper/scenes/scene.h"

namespace bumper::tests {

/// A triangle with vertices of its own, in the scene's first mesh.
inline void addTriangle(Scene& scene, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c) {
  if (scene.meshes.empty()) scene.meshes.resize(1);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), {a, b, c});
  scene.triangles.push_back({{first, first + 1, first + 2}, 0});
}

/// Adds all of another scene.
inline void append(Scene& scene, const Scene& other) {
  const auto vertices = static_cast<std::uint32_t>(scene.vertices.size());
  const auto meshes = static_cast<std::uint32_t>(scene.meshes.size());
  scene.vertices.insert(scene.vertices.end(), other.vertices.begin(), other.vertices.end());
  scene.meshes.insert(scene.meshes.end(), other.meshes.begin(), other.meshes.end());
  for (Scene::Triangle triangle : other.triangles) {
    for (std::uint32_t& corner : triangle.corners) corner += vertices;
    triangle.mesh += meshes;
    scene.triangles.push_back(triangle);
  }
}

}  // namespace bumper::tests
