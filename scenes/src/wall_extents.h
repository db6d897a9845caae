#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bumper/scenes/walls.h"

namespace bumper {

/// Fills in foot and top of each wall. `corners` names the corners of each wall by numbers that are
/// equal where the points are.
void findWallExtents(std::vector<Wall>& walls,
                     const std::vector<std::array<std::uint32_t, 3>>& corners);

}  // namespace bumper
