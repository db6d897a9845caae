#pragma once

#include <array>
#include <cstddef>

#include "bumper/base/api.h"
#include "bumper/response/planar_motion.h"

namespace BUMPER_API bumper {

/// A constant force at the mass centre and yaw moment for one step.
struct PlanarForce {
  Vector2 force = Vector2::Zero();  ///< N
  double yawMoment = 0.0;           ///< N m
};

/// Delivers impulses as constant forces (Eqs. 37 and 38): each impulse's pulse lasts one step and
/// starts at its impact, so it covers the rest of this step and the beginning of the next. That
/// makes position and velocity exact for an engine that integrates v ← v + h F/m, x ← x + h v. The
/// remaining impulse is kept between steps, not a force: the next step may have another size. Plain
/// data: a copy is a saved state.
class ForcePulse {
 public:
  /// An impact `start` seconds into the coming step of `step` seconds, 0 ≤ start ≤ step, step > 0.
  void add(const PlanarImpulse& impulse, double start, double step);

  /// The same with a given contact time, s, > 0: a constant force from the impact on, over any
  /// number of steps. At most maxLong of these run at once; a further one is added to the last.
  void addLong(const PlanarImpulse& impulse, double start, double duration);

  /// Moves the vehicle by impulse · step / mass within the coming step and leaves its velocity
  /// unchanged: the next step applies the opposite impulse.
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

  /// The largest impulse, in a step without impact, of forces that are not known beforehand: tyres,
  /// motors.
  struct Ordinary {
    double linear = 0.0;   ///< N s, ≥ 0
    double angular = 0.0;  ///< N m s, ≥ 0
  };

  /// Subtracts from the pending impulse of impacts, P, the part that the engine's contacts and
  /// joints have already applied. `surplus`, D, is mass and yaw inertia times the difference
  /// between the actual and the predicted motion. The share clamp((D·P − o·|P|) / (P·P), 0, 1) is
  /// subtracted, where · is the energy inner product (linear parts over the mass, angular ones over
  /// the yaw inertia) and o is `ordinary`: the vehicle reaches the law's speed along P, or that
  /// given by other forces, not both. The return part of a shift() is kept.
  void reconcile(const PlanarImpulse& surplus, const Ordinary& ordinary, double mass,
                 double yawInertia);

  /// Writes all impulses in a frame whose x axis points along `ahead`, unit, in the old one.
  void turnFrame(const Vector2& ahead);

  /// Discards the pending impulse: the vehicle was moved by other means.
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
  // The part of each that reverses a shift().
  PlanarImpulse takenBackThisStep_;
  PlanarImpulse takenBackNextStep_;
  std::array<Long, maxLong> long_{};
  std::size_t longCount_ = 0;
};

}  // namespace bumper
