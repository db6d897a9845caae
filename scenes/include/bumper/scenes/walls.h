#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// One triangle that a vehicle can hit: one of the paper's "vertical elements". The triangles that
/// make up a whole barrier or building are as many walls.
struct Wall {
  std::array<Eigen::Vector3d, 3> corners;
  Eigen::Vector3d normal;  ///< unit, by the triangle's winding, which need not be right
  int triangle = -1;       ///< index into Scene::triangles
  /// Lowest and highest point, m, of the wall surface that the triangle is a part of, over the
  /// triangle's own stretch of it: a wall meshed in several rows is as tall as all of them. The
  /// surface is connected at corners, bends by less than 10° in plan and has no gap of
  /// more than 1 mm in height.
  double foot = 0.0;
  double top = 0.0;
};

/// How far a vehicle that stands anywhere on a scene's ground can reach. The defaults allow for
/// lorries, slopes and a jump.
struct GroundReach {
  double distance = 8.0;  ///< m, horizontally, from the ground that carries it; >= 0, finite
  double above = 4.0;     ///< m above that ground; likewise
  double below = 2.0;     ///< m below it, where its nose points down; likewise
};

/// What makes a triangle a wall. Each reduction can be switched off by itself.
struct WallSelection {
  /// |vertical component of the unit normal| up to which a triangle is a wall by itself; [0, 1].
  /// 0.3 keeps what leans by less than 17° from the vertical, 1 keeps all. What leans further, by
  /// up to 64°, is judged by the surface that it is part of: a rail of tube, a zigzag beam, a
  /// leaning post, a hedge are walls, a hillside and a ramp are none.
  double maxNormalUp = 0.3;

  /// Meshes that no vehicle hits, such as pictures of trees: a pattern for matchingMeshes(); empty:
  /// none. A trimesh of ODE's has no meshes. Must outlive the call that it is given to.
  std::string_view scenery{};

  /// Drops walls that are there twice: with the same corners, or as the other two triangles of a
  /// plane quad that is there already.
  bool dropRepeated = true;

  /// Drops walls above all that a vehicle on the scene's own ground can reach; empty: keeps them,
  /// for vehicles that drive on ground which is not in this scene as well. Ground is what is no
  /// wall by its slope and wide enough for a vehicle, by itself or together with pieces next to it.
  /// A wall is dropped only if ground lies under all of it and around it, and none is in reach:
  /// what has ground only above it, or beside it, is kept.
  std::optional<GroundReach> groundReach = GroundReach{};
};

/// Where a scene's triangles went.
struct WallReport {
  std::size_t walls = 0;
  std::size_t droppedFlat = 0;            ///< ground, road, roofs, terrain
  std::size_t droppedDegenerate = 0;      ///< no area
  std::size_t droppedScenery = 0;         ///< steep, but WallSelection::scenery
  std::size_t droppedDuplicate = 0;       ///< the corners of a wall before, either winding
  std::size_t droppedRetriangulated = 0;  ///< a plane quad cut along its other diagonal
  std::size_t droppedOverhead = 0;        ///< above what a vehicle on the ground below reaches
  std::size_t droppedBuried = 0;          ///< the same, and below the ground above it
  /// Of droppedFlat what is steeper than 45°, where no vehicle drives: taken for hillsides, or for
  /// the foot of a wall.
  std::size_t droppedOnGuess = 0;
  std::size_t withoutGround = 0;  ///< walls kept because there is no ground nearby
  std::size_t inDoubt = 0;  ///< walls kept out of reach of the ground nearby: there may be other
  std::size_t memory = 0;   ///< bytes that the walls take: here, or with their trees in ODE
  double lowestFoot = 0.0;  ///< m; 0 without walls
  double highestTop = 0.0;  ///< m; 0 without walls

  [[nodiscard]] std::size_t dropped() const {
    return droppedFlat + droppedDegenerate + droppedScenery + droppedDuplicate +
           droppedRetriangulated + droppedOverhead + droppedBuried;
  }
};

struct Walls {
  std::vector<Wall> walls;  ///< in the scene's order
  WallReport report;
};

/// The triangles of a scene that a vehicle can hit. Throws Error on an invalid scene or selection.
Walls selectWalls(const Scene& scene, const WallSelection& selection = {});

/// The last of the reductions, for walls that were selected without it; does nothing if
/// `selection.groundReach` is empty or the scene has no ground.
void dropOutOfReach(const Scene& scene, const WallSelection& selection, Walls& walls);

}  // namespace bumper
