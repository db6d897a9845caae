#pragma once

#include <cstdint>
#include <vector>

#include "bumper/scenes/scene.h"
#include "bumper/scenes/walls.h"
#include "corners.h"

namespace bumper {

/// |vertical component of the unit normal| from which on, 64° from the vertical, nothing stops a
/// vehicle.
inline constexpr double flattest = 0.9;

/// Judges triangles that lean too far for a wall by the surface that they are part of. Its profile,
/// the section along a triangle's slope, stops a vehicle if
///   - it folds, so that one part overhangs another, and is nearly as tall as it is deep: rails of
///     round or edged tube, beams of zigzag profile, leaning posts; or
///   - it rises by more than a vehicle climbs, at 45° or more, and belongs to no ground: hedges,
///     leaning boards.
/// By index in `surfaces`: all triangles up to `flattest`, of which those up to `maxNormalUp` are
/// walls anyway; `corners` names their corners by numbers that are equal where the points are.
std::vector<bool> areWalls(const Scene& scene, const std::vector<Wall>& surfaces,
                           const std::vector<Corners>& corners, double maxNormalUp);

}  // namespace bumper
