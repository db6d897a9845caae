#pragma once

#include <vector>

#include "bumper/base/api.h"
#include "bumper/scenes/scene.h"
#include "bumper/scenes/walls.h"

namespace BUMPER_API bumper {

/// How far the foot of a wall reaches, m: in front of the wall as seen from above, on either side,
/// and below it.
inline constexpr double footReach = 0.5;

/// A triangle at the foot of a taller wall, no further away than footReach: a plinth, the toe
/// of a concrete barrier, a kerb at its base, a narrow ledge, rocks. Ground is none: a surface no
/// steeper than 45° that goes on beyond that distance. Nor is a wall of more than 1 m.
struct WallFoot {
  int triangle = -1;  ///< index into Scene::triangles
  /// Lowest and highest point, m, of the walls at whose foot it stands.
  double foot = 0.0;
  double top = 0.0;
};

/// The feet among walls, in their order.
std::vector<WallFoot> wallFeet(const std::vector<Wall>& walls);

/// The feet among all triangles of the scene that the walls were selected from, in its order.
std::vector<WallFoot> wallFeet(const Scene& scene, const std::vector<Wall>& walls);

}  // namespace bumper
