#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

/// A named part of a scene with one material.
struct SceneMesh {
  std::string name;
  std::string material;
  Eigen::Vector3f colour{0.7F, 0.7F, 0.7F};  ///< diffuse, RGB in [0, 1]
};

/// What a scene file holds, as plain triangles: metres, right-handed, z up, double precision.
struct Scene {
  struct Triangle {
    std::array<std::uint32_t, 3> corners{};  ///< into vertices, counter-clockwise from outside
    std::uint32_t mesh = 0;                  ///< into meshes
  };

  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  std::vector<SceneMesh> meshes;

  [[nodiscard]] const Eigen::Vector3d& corner(const Triangle& triangle, std::size_t k) const {
    return vertices[triangle.corners[k]];
  }
};

/// Throws Error, naming the first defect: no triangle, a vertex or mesh index out of range, a
/// coordinate that is not finite.
void validate(const Scene& scene);

/// For each mesh of a scene whether the whole of its name, or of its material, matches a regular
/// expression (ECMAScript); an empty one matches none. Throws Error if `pattern` is none, or if a
/// name is longer than SceneBudget's usual nameLength: matching takes stack for each character.
std::vector<bool> matchingMeshes(const Scene& scene, const std::string& pattern);

}  // namespace bumper
