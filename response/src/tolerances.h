#pragma once

#include "bumper/response/touch.h"

namespace bumper {

/// Walls whose normals differ by less than this sine are in line.
inline constexpr double inLine = 1e-4;

/// Walls, or a wall and a side of the outline, whose normals differ by less than this sine, 5°, are
/// nearly in line.
inline constexpr double nearlyInLine = 0.087;

/// Walls whose ends are no further apart than this, m, meet.
inline constexpr double jointWidth = 1e-3;

/// A penetration greater than this within a step, m, is no new touch: it slides.
inline constexpr double freshDepth = 10.0 * touchTolerance;

/// Sliding within a step penetrates no deeper than this, m; an outline that lies deeper was placed
/// there.
inline constexpr double slidingDepth = 0.05;

}  // namespace bumper
