#pragma once

#include <cstddef>
#include <span>

#include "bumper/response/planar_motion.h"

namespace bumper {

/// A touching point: the wall's normal there, and the arm from the mass centre.
struct TouchingPoint {
  Vector2 normal = Vector2::Zero();
  Vector2 arm = Vector2::Zero();
};

/// More never count at once.
inline constexpr std::size_t mostTouchingPoints = 64;

/// The impulse that ends all approach at these points at once, without friction or rebound: of all
/// motions in which none approaches it leads to the nearest one, in the measure of kinetic energy,
/// so it never adds energy. At most mostTouchingPoints.
PlanarImpulse endApproach(const PlanarMotion& motion, double mass, double yawInertia,
                          std::span<const TouchingPoint> points);

}  // namespace bumper
