#pragma once

#include <optional>
#include <vector>

#include "bumper/response/contact_point.h"
#include "oracle.h"

/// A second way to the overlap of an outline and a wall: the rectangle as a polygon, cut by half
/// planes in extended precision.
namespace bumper::tests {

using Polygon = std::vector<Plane>;

/// The rectangle placed in the plane, counter-clockwise.
Polygon placed(const Outline& outline, const Plane& position, Real yaw);

/// The part of a convex polygon where direction · p ≤ limit.
Polygon clipped(const Polygon& polygon, const Plane& direction, Real limit);

/// The part of the segment inside a convex polygon; nothing if there is none.
struct Piece {
  Plane begin;
  Plane end;
  [[nodiscard]] Plane middle() const { return 0.5L * (begin + end); }
  [[nodiscard]] Real length() const { return (end - begin).norm(); }
};
std::optional<Piece> inside(const Polygon& polygon, const Plane& start, const Plane& end);

/// What findOverlap and contactPoint promise, computed by clipping.
struct ExactOverlap {
  Plane normal;
  Plane tangent;
  Real offset = 0.0L;
  Real start = 0.0L;
  Real end = 0.0L;
  Real depth = 0.0L;
  Real deepest = 0.0L;
  Real lengthInside = 0.0L;  ///< of the wall
};
std::optional<ExactOverlap> exactOverlap(const Outline& outline, const Vector2& position,
                                         double yaw, const Segment& wall);

/// The wall's middle inside the outline once that is moved to the given penetration, from the
/// mass centre.
std::optional<Plane> exactArm(const Outline& outline, const Vector2& position, double yaw,
                              const ExactOverlap& overlap, Real penetration);

}  // namespace bumper::tests
