#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "bumper/base/api.h"

namespace BUMPER_INTERNAL bumper {

/// Corners at most this far apart, m, are one: well above the rounding of the single precision in
/// which most files hold coordinates, well below any gap that matters to a vehicle.
inline constexpr double weldDistance = 1e-5;

/// Triangles thinner than this, m, have no area to speak of, and no normal either.
inline constexpr double degenerateThickness = 1e-6;

/// For each point the index of the first point before it, or itself, that it falls together with.
std::vector<std::uint32_t> weld(const std::vector<Eigen::Vector3d>& points);

/// Smallest height of a triangle, m; 0 if it has two equal corners.
double thickness(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace bumper
