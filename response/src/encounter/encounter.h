#pragma once

#include <span>

#include "bumper/response/collision_step.h"
#include "contact_set.h"
#include "instant.h"
#include "participant.h"

namespace bumper {

/// One free body among fixed ones on one timeline. The step advances from one time of impact to the
/// next; at each, an Instant ends the approach. An Island advances several of them.
class BUMPER_HIDDEN Encounter {
 public:
  Encounter() = default;
  ~Encounter() = default;
  Encounter(const Encounter&) = delete;
  Encounter& operator=(const Encounter&) = delete;
  Encounter(Encounter&&) = delete;
  Encounter& operator=(Encounter&&) = delete;

  /// See CollisionStep.
  StepOutcome resolve(const PlanarBody& body, const Outline& outline,
                      const CollisionStep::Walls& walls, double h);
  std::span<const SpeculativeContact> speculativeContacts(const PlanarMotion& motion,
                                                          const PlanarMotion& after,
                                                          double distance, double h);

  /// For an Island: where the vehicle is before it is eased out of others.
  void place(const PlanarBody& body, const Outline& outline) {
    vehicle_ = {.body = body, .outline = outline};
    time_ = 0.0;
  }
  /// The parts of resolve(): where the step begins, eased out of what it overlaps with `eased` in
  /// addition, m/s.
  void begin(const PlanarBody& body, const Outline& outline, const CollisionStep::Walls& walls,
             double h, const Vector2& eased = Vector2::Zero());
  /// Ends the approach to walls where it is now.
  void settle(Effort effort = Effort::as_set);
  /// When a wall has to be answered or checked next, s from the step's start; `until` if not
  /// before.
  double nextLook(double until);
  /// Free flight.
  void advanceTo(double time);
  /// Held until the step's end: what it still meets is left to the next one.
  [[nodiscard]] bool isHeld() const { return settled_ == Settled::for_now; }
  void hold() { settled_ = Settled::for_now; }
  /// At the step's end.
  [[nodiscard]] StepOutcome finish() const;

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] bool wasShifted() const { return !shift_.velocity.isZero(0.0); }
  [[nodiscard]] Participant& participant() { return vehicle_; }
  [[nodiscard]] const Participant& participant() const { return vehicle_; }
  [[nodiscard]] Instant& instant() { return instant_; }

 private:
  // The wall that is touched next; none if `wall` is null.
  struct NextTouch {
    double time = 0.0;
    Manifold* wall = nullptr;
  };

  [[nodiscard]] Vector2 recoveryVelocity(const Vector2& eased) const;
  NextTouch nextTouch(double until);
  [[nodiscard]] double quietTime(const Manifold& wall) const;
  [[nodiscard]] double pause() const;

  Participant vehicle_;
  ContactSet contacts_{vehicle_};
  Instant instant_{vehicle_, contacts_};
  SpeculativeContacts speculative_;

  double step_ = 0.0;  // its size, s
  double time_ = 0.0;  // from the step's start, of the vehicle's motion
  StepShift shift_;
  Settled settled_ = Settled::without_impulse;
  // What nextLook() found.
  double nextTime_ = 0.0;
  Manifold* touched_ = nullptr;
};

}  // namespace bumper
