#pragma once

#include <vector>

#include "bumper/scenes/walls.h"
#include "corners.h"

namespace bumper {

/// Drops walls that are there twice and counts them. `corners` names the corners of each wall by
/// numbers that are equal where the points are, and is kept in step with `walls`.
void dropRepeated(std::vector<Wall>& walls, std::vector<Corners>& corners, WallReport& report);

}  // namespace bumper
