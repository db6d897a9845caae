#pragma once

#include <array>

#include "bumper/response/impact.h"
#include "pair_body.h"

namespace bumper {

/// The contact of two outlines that touch or overlap. The arms lead from either's mass centre to
/// the one point where the impulse acts.
struct PairContact {
  Vector2 point = Vector2::Zero();   ///< m
  Vector2 normal = Vector2::Zero();  ///< unit, out of the second into the first
  Vector2 arm = Vector2::Zero();
  Vector2 otherArm = Vector2::Zero();
  double speed = 0.0;  ///< at which they close there, m/s; ≤ 0: they pass by each other
  /// The places between which they touch along the tangent, either side of the point: of a corner
  /// in a side nearly one.
  std::array<Vector2, 2> ends{};
  /// Of the impulse: 1, or less the thinner the sliver in which two corners sweep past each other,
  /// so that the edge between hit and miss is no jump.
  double share = 1.0;

  [[nodiscard]] Impact impact(double depth) const {
    return {.point = point, .normal = normal, .arm = arm, .otherArm = otherArm, .depth = depth};
  }
};

/// The nearest-face rule. Both outlines are carried on by their own motion for the penetration
/// time, by no more than the narrower one's width. R being their overlap there, the normal is
/// that of −∇ ∫ (depth in the first + depth in the second) over R: the sum of each side's normal
/// times the area of R that lies nearest to it. It is the side's own where a corner meets a side,
/// turns from one side to the next without a jump, and is equal and opposite for both. The point is
/// the centroid of R, carried back. Nothing closes (speed 0) if there is no overlap.
PairContact pairContact(const PairBody& first, const PairBody& second, double penetrationTime);

}  // namespace bumper
