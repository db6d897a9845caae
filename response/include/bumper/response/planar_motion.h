#pragma once

#include <Eigen/Core>

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

/// A vector in a vehicle's yaw plane (z up, so that a turn from x to y is positive).
using Vector2 = Eigen::Vector2d;

/// The z component of the vector product.
inline double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// z × v: v turned by 90° to the left.
inline Vector2 turnedLeft(const Vector2& v) { return {-v.y(), v.x()}; }

/// Rotates v by an angle, rad, positive to the left.
Vector2 rotated(const Vector2& v, double angle);

/// A place in the plane, m, and a heading, rad, whose sine and cosine are taken once.
struct Placement {
  Placement() = default;
  Placement(Vector2 itsPosition, double yaw);

  Vector2 position = Vector2::Zero();
  double cosine = 1.0;
  double sine = 0.0;

  /// A direction of the vehicle's frame in the plane's, and the other way round.
  [[nodiscard]] Vector2 turned(const Vector2& v) const {
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
  }
  [[nodiscard]] Vector2 turnedBack(const Vector2& v) const {
    return {cosine * v.x() + sine * v.y(), cosine * v.y() - sine * v.x()};
  }
  /// A point of the plane in the vehicle's frame.
  [[nodiscard]] Vector2 local(const Vector2& point) const { return turnedBack(point - position); }
};

/// Position and motion of a rigid vehicle in its yaw plane. The plane's frame is the caller's: for
/// a flat world the world itself, in the ODE adapter the vehicle's own axes at the step's start.
struct PlanarMotion {
  Vector2 position = Vector2::Zero();  ///< Mass centre, m.
  double yaw = 0.0;                    ///< From the frame's x axis, rad, positive to the left.
  Vector2 velocity = Vector2::Zero();  ///< Mass centre, m/s.
  double yawRate = 0.0;                ///< rad/s, positive turning left.

  [[nodiscard]] Placement placement() const { return {position, yaw}; }
};

/// The motion after `time` seconds of free flight at constant velocity and yaw rate.
PlanarMotion advanced(PlanarMotion motion, double time);

/// Velocity of the body point at `arm` from the mass centre (both in the plane's frame).
inline Vector2 velocityAt(const PlanarMotion& motion, const Vector2& arm) {
  return motion.velocity + motion.yawRate * turnedLeft(arm);
}

/// An impulse and its moment about the mass centre: the left sides of Eqs. 1 and 2.
struct PlanarImpulse {
  Vector2 linear = Vector2::Zero();  ///< N s
  double angular = 0.0;              ///< N m s

  PlanarImpulse& operator+=(const PlanarImpulse& other) {
    linear += other.linear;
    angular += other.angular;
    return *this;
  }
};

/// The motion after an impulse acted on the mass centre (Eqs. 1 and 2).
inline PlanarMotion afterImpulse(PlanarMotion motion, const PlanarImpulse& impulse, double mass,
                                 double yawInertia) {
  motion.velocity += impulse.linear / mass;
  motion.yawRate += impulse.angular / yawInertia;
  return motion;
}

/// ½ m |v|² + ½ I r² (Eq. 25), J.
inline double yawPlaneEnergy(const PlanarMotion& motion, double mass, double yawInertia) {
  return 0.5 * mass * motion.velocity.squaredNorm() +
         0.5 * yawInertia * motion.yawRate * motion.yawRate;
}

/// Whether all six numbers are finite.
bool isFinite(const PlanarMotion& motion);

}  // namespace bumper
