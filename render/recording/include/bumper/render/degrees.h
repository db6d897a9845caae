#pragma once

#include <numbers>

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

/// A radian in degrees, in which people read angles.
inline constexpr double degrees = 180.0 / std::numbers::pi;

}  // namespace bumper
