#pragma once

#include <vector>

#include "bumper/scenes/walls.h"

namespace bumper {

/// What a triangle is to the walls of its scene.
struct WallPart {
  enum class Kind {
    none,  ///< ground, or nothing that has to do with a wall
    face,  ///< a wall, or a second skin of one
    cap    ///< flat, and reaches to the upper edge of a wall: its top, or the ground behind it
  };
  Kind kind = Kind::none;
  double foot = 0.0;  ///< m, of the wall, or of all walls that a cap reaches to
  double top = 0.0;   ///< m
};

/// For each triangle of a scene its part in the walls that were selected from it.
std::vector<WallPart> wallParts(const Scene& scene, const Walls& walls);

}  // namespace bumper
