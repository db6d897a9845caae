#pragma once

#include <numbers>

namespace bumper {

/// A radian in degrees, in which people read angles.
inline constexpr double degrees = 180.0 / std::numbers::pi;

}  // namespace bumper
