#pragma once

#include <optional>

#include "bumper/response/sweep.h"
#include "outline_oracle.h"

/// A second way to the time of touch, in extended precision. It knows the distance of a rectangle
/// from a segment or a circle and how fast that can shrink, and nothing of corners, ends and roots:
/// the rectangle is moved on by no more than the distance allows, until it touches.
namespace bumper::tests {

/// How a rectangle and a wall lie to each other.
struct Separation {
  /// Apart: the distance, m. Overlapping: minus the shortest way out. 0 counts as overlapping.
  Real gap = 0.0L;
  /// Unit, out of the wall into the rectangle, along the shortest way.
  Plane normal = Plane::Zero();
  /// Along a side of the rectangle, not a face of the wall.
  bool alongSide = false;
  /// Second shortest way out, m; to tell whether the shortest is the only one.
  Real secondDepth = 0.0L;
  /// Of the rectangle, the nearest to the wall; from the mass centre, in the plane's axes. Only
  /// when apart.
  Plane arm = Plane::Zero();
  /// Unit, from the nearest point of the wall to that. Only when apart.
  Plane away = Plane::Zero();
};
Separation separation(const Outline& outline, const Plane& position, Real yaw, const Segment& wall);

/// Free flight.
struct Flight {
  explicit Flight(const PlanarMotion& motion)
      : position(motion.position.cast<Real>()),
        yaw(motion.yaw),
        velocity(motion.velocity.cast<Real>()),
        yawRate(motion.yawRate) {}

  [[nodiscard]] Plane positionAt(Real time) const { return position + time * velocity; }
  [[nodiscard]] Real yawAt(Real time) const { return yaw + time * yawRate; }
  /// No point of the outline moves faster, m/s.
  [[nodiscard]] Real fastest(const Outline& outline) const;

  Plane position;
  Real yaw;
  Plane velocity;
  Real yawRate;
};

Separation separationAt(const Outline& outline, const Flight& flight, const Segment& wall,
                        Real time);

struct FirstTouch {
  enum class Kind { none, touch, undecided } kind = Kind::none;
  Real time = 0.0L;      ///< s
  Real approach = 0.0L;  ///< how fast the gap closes there, m/s
  Separation at{};       ///< just before
  Real nearest = 0.0L;   ///< without a touch: the smallest distance seen, m
};

/// Where the flight begins.
enum class Start {
  apart,    ///< clear of the wall
  touching  ///< in touch, moving away: nothing counts until the outline is clear of the wall
};

/// An outline is clear of a wall at this distance, m.
inline constexpr Real clear = 1e-8L;

FirstTouch firstTouch(const Outline& outline, const PlanarMotion& motion, const Segment& wall,
                      Real from, Real until, Start start);

/// The deepest overlap in an interval, m, as far as sampling sees it; negative if none.
Real deepestIn(const Outline& outline, const PlanarMotion& motion, const Segment& wall, Real from,
               Real until);

}  // namespace bumper::tests
