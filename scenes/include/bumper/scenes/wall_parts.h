#pragma once

#include <vector>

#include "bumper/base/api.h"
#include "bumper/scenes/walls.h"

namespace BUMPER_API bumper {

/// The role of a scene's triangle beside the walls selected from the scene.
struct WallPart {
  enum class Kind {
    none,  ///< ground, or unrelated to any wall
    face,  ///< a wall, or a second skin of one
    cap    ///< flat, and reaches to the upper edge of a wall: its top, or the ground behind it
  };
  Kind kind = Kind::none;
  double foot = 0.0;  ///< m, of the wall, or of all walls that a cap reaches to
  double top = 0.0;   ///< m
};

/// The role of each triangle of a scene, by its index in Scene::triangles; `walls` must have been
/// selected from that scene.
std::vector<WallPart> wallParts(const Scene& scene, const Walls& walls);

}  // namespace bumper
