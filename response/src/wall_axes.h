#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "bumper/response/touch.h"

namespace bumper {

/// A corner of the outline in a wall's own axes: along it, and into it, m.
struct WallCorner {
  double along = 0.0;
  double depth = 0.0;
};
using WallCorners = std::array<WallCorner, 4>;

/// The corners of an outline, by `line` of lineOf().
inline WallCorners inWallAxes(const Outline& outline, const Placement& at, const Overlap& line) {
  const Vector2 tangent = turnedLeft(line.normal);
  const double along = tangent.dot(at.position);
  const double depth = line.offset - line.normal.dot(at.position);
  // The vehicle's axes in the wall's.
  const Vector2 forward = at.turned({1.0, 0.0});
  const double cosine = tangent.dot(forward);
  const double sine = line.normal.dot(forward);
  const std::array<Vector2, 4> corners = outline.corners();
  WallCorners result;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2& corner = corners[k];
    result[k] = {.along = along + cosine * corner.x() - sine * corner.y(),
                 .depth = depth - sine * corner.x() - cosine * corner.y()};
  }
  return result;
}

/// How deep the outline's boundary lies at a place along the wall; −∞ beside the outline.
inline double depthAt(const WallCorners& corners, double place) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const WallCorner& a = corners[k];
    const WallCorner& b = corners[(k + 1) % corners.size()];
    if ((a.along < place) == (b.along < place)) continue;
    const double share = (place - a.along) / (b.along - a.along);
    deepest = std::max(deepest, a.depth + share * (b.depth - a.depth));
  }
  return deepest;
}

}  // namespace bumper
