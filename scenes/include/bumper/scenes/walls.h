#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "bumper/scenes/scene.h"

namespace bumper {

/// A triangle that a vehicle can hit: one of the paper's "vertical elements".
struct Wall {
  std::array<Eigen::Vector3d, 3> corners;
  Eigen::Vector3d normal;  ///< unit, by the triangle's winding, which need not be right
  int triangle = -1;       ///< in the scene it comes from
  /// Lowest and highest point, m, of the wall surface that the triangle is a part of, over the
  /// triangle's own stretch of it: a wall meshed in several rows is as tall as all of them. The
  /// surface is what hangs together at corners, bends by less than 10° in plan and has no gap of
  /// more than 1 mm in height.
  double foot = 0.0;
  double top = 0.0;
};

/// What makes a triangle a wall.
struct WallSelection {
  /// |vertical component of the unit normal| up to which a triangle is a wall; [0, 1]. 0.3 keeps
  /// what leans by less than 17° from the vertical.
  double maxNormalUp = 0.3;
};

/// Where a scene's triangles went.
struct WallReport {
  std::size_t walls = 0;
  std::size_t droppedFlat = 0;        ///< ground, road, roofs, terrain
  std::size_t droppedDegenerate = 0;  ///< no area
  std::size_t droppedDuplicate = 0;   ///< the same three corners as a wall before, either winding
  double lowestFoot = 0.0;            ///< m; 0 without walls
  double highestTop = 0.0;            ///< m; 0 without walls
};

struct Walls {
  std::vector<Wall> walls;  ///< in the scene's order
  WallReport report;
};

/// The triangles of a scene that a vehicle can hit. Throws Error on an invalid scene or selection.
Walls selectWalls(const Scene& scene, const WallSelection& selection = {});

}  // namespace bumper
