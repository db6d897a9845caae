#pragma once

#include <Eigen/Core>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/scenes/walls.h"

namespace BUMPER_API bumper {

/// Distance from a point to the nearest wall in the horizontal plane, m, whatever the heights; 0
/// above or below a wall that leans, infinite if there is no wall. Looks at every wall: for checks,
/// pictures and plots, not for a simulation step.
double clearance(const std::vector<Wall>& walls, const Eigen::Vector2d& point);

/// The same of one wall.
double clearance(const Wall& wall, const Eigen::Vector2d& point);

}  // namespace bumper
