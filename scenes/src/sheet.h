#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bumper/scenes/scene.h"

namespace bumper {

std::uint32_t addMesh(Scene& scene, const std::string& name, const std::string& material,
                      const Eigen::Vector3f& colour);

/// Two triangles, seen counter-clockwise from outside.
void addQuad(Scene& scene, std::uint32_t mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
             std::uint32_t d);

/// Points in stations along a way, the same number at each.
struct Sheet {
  std::vector<Eigen::Vector3d> points;  ///< station after station
  std::size_t across = 0;               ///< points of a station
  bool closed = false;                  ///< the last station joins the first
  std::vector<std::uint32_t> meshes;    ///< of each column of quads: across - 1
};

/// Adds a sheet to the scene and gives the index of its first vertex. With the way ahead and the
/// points of a station running up, the sheet faces left; running left to right, it faces up.
std::uint32_t addSheet(Scene& scene, const Sheet& sheet);

}  // namespace bumper
