#pragma once

#include <algorithm>

#include "bumper/response/touch.h"

namespace bumper {

/// How a wall's part inside the outline pushes it out: with d the distance to the nearest side,
/// −∇ of ½ ∫ d² ds over that part, as the outline is moved. Where a wall passes through the
/// outline that is exactly along its normal; at ends, vertices and steps it turns from one
/// direction to the other as the outline engages, without a jump.
struct Engagement {
  Vector2 push = Vector2::Zero();    ///< towards free space, in the plane's frame, m²
  Vector2 moment = Vector2::Zero();  ///< ∫ place ds, m²
  double length = 0.0;               ///< of the part inside, m
  double depth = 0.0;                ///< the largest d, m

  void add(const Engagement& other, double weight) {
    push += weight * other.push;
    moment += weight * other.moment;
    length += weight * other.length;
    depth = std::max(depth, other.depth);
  }
};
Engagement engagement(const Outline& outline, const Placement& at, const Segment& wall);

/// −∇ ∫ d ds with d relative to the distance of the side from the mass centre, dimensionless: a
/// wall through the outline pushes it to the side of its mass centre. Summed up it says which way
/// leads out of all walls that an outline stands in: a function that is concave while they are
/// inside has no place to rest there.
Vector2 wayOut(const Outline& outline, const Placement& at, const Segment& wall);

/// Of a point inside the outline to the nearest side, m; negative: outside.
double depthInside(const Outline& outline, const Placement& at, const Vector2& point);

}  // namespace bumper
