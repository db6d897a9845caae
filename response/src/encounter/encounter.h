#pragma once

#include <span>

#include "bumper/response/collision_step.h"
#include "contact_set.h"
#include "instant.h"
#include "participant.h"

namespace bumper {

/// One island of planar bodies on one timeline: a free one among fixed ones. The step advances from
/// one time of impact to the next; at each, an Instant ends the approach.
class Encounter {
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

 private:
  // The wall that is touched next; none if `wall` is null.
  struct NextTouch {
    double time = 0.0;
    Manifold* wall = nullptr;
  };

  [[nodiscard]] Vector2 recoveryVelocity(double h) const;
  NextTouch nextTouch(double from, double until);
  [[nodiscard]] double quietTime(const Manifold& wall, double h) const;
  [[nodiscard]] double pause(double h) const;

  Participant vehicle_;
  ContactSet contacts_{vehicle_};
  Instant instant_{vehicle_, contacts_};
  SpeculativeContacts speculative_;
};

}  // namespace bumper
