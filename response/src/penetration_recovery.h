#pragma once

#include <algorithm>

namespace bumper {

/// How an outline is moved out of a wall that it stands in: by a share of the depth in each step,
/// and what is left in peace, m.
inline constexpr double recoveryShare = 0.2;
inline constexpr double recoverySlop = 1e-4;

/// The speed, m/s, for a depth, m, no faster than `fastest`.
inline double recoverySpeed(double depth, double step, double fastest) {
  return std::clamp(recoveryShare * (depth - recoverySlop) / step, 0.0, fastest);
}

}  // namespace bumper
