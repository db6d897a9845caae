#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "bumper/scenes/scene.h"

namespace bumper::testing {

/// Adds a plane quad in two triangles, with corners of its own.
inline void addQuad(Scene& scene, const std::array<Eigen::Vector3d, 4>& corners) {
  if (scene.meshes.empty()) scene.meshes.resize(1);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), corners.begin(), corners.end());
  scene.triangles.push_back({{first, first + 1, first + 2}, 0});
  scene.triangles.push_back({{first, first + 2, first + 3}, 0});
}

/// Level ground from (−30, −40) to (60, 40) m.
inline Scene levelGround() {
  Scene scene;
  addQuad(scene,
          {{{-30.0, -40.0, 0.0}, {60.0, -40.0, 0.0}, {60.0, 40.0, 0.0}, {-30.0, 40.0, 0.0}}});
  return scene;
}

/// Adds a closed block on the ground, its eight corners shared: 12 triangles.
inline void addBlock(Scene& scene, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                     double height) {
  if (scene.meshes.empty()) scene.meshes.resize(1);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const double z : {0.0, height}) {
    scene.vertices.emplace_back(low.x(), low.y(), z);
    scene.vertices.emplace_back(high.x(), low.y(), z);
    scene.vertices.emplace_back(high.x(), high.y(), z);
    scene.vertices.emplace_back(low.x(), high.y(), z);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  for (const auto& [a, b, c, d] : faces) {
    scene.triangles.push_back({{first + a, first + b, first + c}, 0});
    scene.triangles.push_back({{first + a, first + c, first + d}, 0});
  }
}

/// A wall along x from 0 to 40 m whose second half stands `step` m further out, to +y.
inline Scene steppedWall(double step) {
  Scene scene = levelGround();
  addBlock(scene, {0.0, -0.5}, {20.0, 0.0}, 1.0);
  addBlock(scene, {20.0, -0.5}, {40.0, step}, 1.0);
  return scene;
}

inline Scene healthyWall() {
  Scene scene = levelGround();
  addBlock(scene, {0.0, -0.5}, {40.0, 0.0}, 1.0);
  return scene;
}

/// A row of 20 blocks laid by hand: joints of 1 cm, up to 4 mm out of line.
inline Scene rowOfBlocks() {
  Scene scene = levelGround();
  for (int i = 0; i < 20; ++i)
    addBlock(scene, {2.0 * i, -0.5}, {2.0 * i + 1.99, 0.002 * ((i * 7) % 5 - 2)}, 0.9);
  return scene;
}

}  // namespace bumper::testing
