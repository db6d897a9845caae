#pragma once

#include <array>
#include <cstddef>

#include "bumper/response/planar_motion.h"

namespace bumper {

/// A constant force at the mass centre and yaw moment for one step.
struct PlanarForce {
  Vector2 force = Vector2::Zero();  ///< N
  double yawMoment = 0.0;           ///< N m
};

/// Delivers impulses as constant forces (Eqs. 37 and 38): each impulse's pulse lasts one step and
/// starts at its impact, so it covers the rest of this step and the beginning of the next. That
/// makes position and velocity exact for an engine that integrates v ← v + h F/m, x ← x + h v. What
/// is kept between steps is the remaining impulse, never a force: the next step may have another
/// size. Plain data: a copy is a saved state.
class ForcePulse {
 public:
  /// An impact `start` seconds into the coming step of `step` seconds, 0 ≤ start ≤ step, step > 0.
  void add(const PlanarImpulse& impulse, double start, double step);

  /// The same with a contact time of the caller's, s, > 0: a constant force from the impact on,
  /// over any number of steps. At most maxLong of these run at once; a further one joins the last.
  void addLong(const PlanarImpulse& impulse, double start, double duration);

  /// Moves the vehicle by impulse · step / mass within the coming step and leaves its velocity as
  /// it is: what is given now is taken back in the next step.
  void shift(const PlanarImpulse& impulse);

  /// An impulse for the coming step that an earlier one failed to deliver.
  void owe(const PlanarImpulse& impulse);

  /// The force for the coming step; what it delivers is then no longer pending. A step of 0 s
  /// delivers nothing and keeps everything.
  PlanarForce take(double step);

  /// The impulse that take() would deliver. With one-step pulses alone that is all that is pending:
  /// the law's velocity is the body's with this added.
  [[nodiscard]] PlanarImpulse due(double step) const;

  /// What has been added and not yet taken.
  [[nodiscard]] PlanarImpulse pending() const;
  [[nodiscard]] bool isEmpty() const;

  /// By how much others, whose forces are not known before a step, may push a vehicle that is in no
  /// impact: tyres, motors.
  struct Ordinary {
    double linear = 0.0;   ///< N s, ≥ 0
    double angular = 0.0;  ///< N m s, ≥ 0
  };

  /// Takes out of what is pending of impacts, P, what contacts and joints that the engine solves
  /// have done of it already. `surplus`, D, is mass and yaw inertia times the difference between
  /// the motion as it came out and as it was expected. The share clamp((D·P − o·|P|) / (P·P), 0, 1)
  /// is taken, where · is the product of energy (linear parts over the mass, angular ones over the
  /// yaw inertia) and o is what is `ordinary`: the vehicle goes as fast along P as the law says, or
  /// as others have made it go, not both. What a shift() takes back stays.
  void reconcile(const PlanarImpulse& surplus, const Ordinary& ordinary, double mass,
                 double yawInertia);

  /// Writes all impulses in a frame whose x axis points along `ahead`, unit, in the old one.
  void turnFrame(const Vector2& ahead);

  /// Forgets what is pending: the vehicle was moved by other means.
  void drop();

  static constexpr std::size_t maxLong = 4;

 private:
  struct Long {
    PlanarImpulse left;
    double delay = 0.0;  // s until it starts
    double time = 0.0;   // s it still runs
  };

  PlanarImpulse thisStep_;
  PlanarImpulse nextStep_;
  // The part of each that takes a shift() back.
  PlanarImpulse takenBackThisStep_;
  PlanarImpulse takenBackNextStep_;
  std::array<Long, maxLong> long_{};
  std::size_t longCount_ = 0;
};

}  // namespace bumper
