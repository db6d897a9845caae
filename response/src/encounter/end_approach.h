#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bumper/response/planar_body.h"

namespace bumper {

/// A touching point: the wall's normal there, and the arm from the mass centre.
struct TouchingPoint {
  Vector2 normal = Vector2::Zero();
  Vector2 arm = Vector2::Zero();
  double wallSpeed = 0.0;  ///< of the wall itself, along the normal, m/s
};

/// More never count at once.
inline constexpr std::size_t mostTouchingPoints = 64;

/// A rigid motion in the plane has three degrees of freedom: more points are never needed.
inline constexpr std::size_t mostCarryingPoints = 3;

/// The share of one of the points.
struct CarryingPoint {
  std::size_t point = 0;  ///< its place among those that were given
  double impulse = 0.0;   ///< along its normal, N s, > 0
};

/// An impulse and the points that it comes from.
struct SharedImpulse {
  PlanarImpulse sum;
  std::array<CarryingPoint, mostCarryingPoints> shares;
  std::size_t count = 0;  ///< of the shares

  [[nodiscard]] std::span<CarryingPoint> all() { return {shares.data(), count}; }
};

/// The impulse that ends all approach at these points at once, without friction or rebound: of all
/// motions in which none approaches it leads to the nearest one, in the measure of kinetic energy,
/// so it never adds energy, as seen from the walls. Where walls that move leave no such motion,
/// some approach remains. At most mostTouchingPoints.
///
/// The sum does not depend on the order of the points. The shares make it up to rounding, each with
/// its moment about the mass centre; where several sets of points could carry it, the order
/// decides. Between walls that face each other they can be much larger than the sum.
SharedImpulse endApproach(const PlanarBody& body, std::span<const TouchingPoint> points);

}  // namespace bumper
