#pragma once

#include "bumper/response/touch.h"

namespace bumper {

/// Walls whose normals differ by less than this sine are in line.
inline constexpr double inLine = 1e-4;

/// Walls, or a wall and a side of the outline, whose normals differ by less than this sine, 5°, are
/// nearly in line.
inline constexpr double nearlyInLine = 0.087;

/// What is found deeper in each other than this within a step, m, was not touched anew: it slides.
inline constexpr double freshDepth = 10.0 * touchTolerance;

/// What slides within a step is no deeper in each other than this, m; an outline that lies deeper
/// was put there.
inline constexpr double slidingDepth = 0.05;

}  // namespace bumper
