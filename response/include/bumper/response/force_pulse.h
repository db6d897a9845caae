#pragma once

#include "bumper/response/planar_motion.h"

namespace bumper {

/// A constant force at the mass centre and yaw moment for one step.
struct PlanarForce {
  Vector2 force = Vector2::Zero();  ///< N
  double yawMoment = 0.0;           ///< N m
};

/// Delivers impulses as constant forces (Eqs. 37 and 38): each impulse's pulse lasts one step and
/// starts at its impact, so it covers the rest of this step and the beginning of the next. What is
/// kept between steps is the remaining impulse, never a force: the next step may have another size.
/// All impulses are in one frame that does not turn.
class ForcePulse {
 public:
  /// An impact `start` seconds into the coming step of `step` seconds, 0 ≤ start ≤ step, step > 0.
  void add(const PlanarImpulse& impulse, double start, double step);

  /// The force for the coming step; what it delivers is then no longer pending. A step of 0 s
  /// delivers nothing and keeps everything.
  PlanarForce take(double step);

  /// What has been added and not yet taken.
  [[nodiscard]] PlanarImpulse pending() const;

  /// Forgets what is pending: the vehicle was moved by other means.
  void drop();

 private:
  PlanarImpulse thisStep_;
  PlanarImpulse nextStep_;
};

}  // namespace bumper
