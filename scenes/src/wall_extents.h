#pragma once

#include <vector>

#include "bumper/scenes/walls.h"
#include "corners.h"

namespace bumper {

/// Fills in foot and top of each wall. `corners` names the corners of each wall by numbers that are
/// equal where the points are.
void findWallExtents(std::vector<Wall>& walls, const std::vector<Corners>& corners);

}  // namespace bumper
