#pragma once

#include <vector>

#include "bumper/response/collision_step.h"
#include "encounter/contact_set.h"
#include "encounter/participant.h"

namespace bumper {

/// The paper's step: of the walls that the outline overlaps where the step begins, the one touched
/// the longest time ago is resolved, once, at the middle of the overlap as found.
class BUMPER_HIDDEN PaperStep {
 public:
  PaperStep() = default;
  ~PaperStep() = default;
  PaperStep(const PaperStep&) = delete;
  PaperStep& operator=(const PaperStep&) = delete;
  PaperStep(PaperStep&&) = delete;
  PaperStep& operator=(PaperStep&&) = delete;

  /// See CollisionStep.
  StepOutcome resolve(const PlanarBody& body, const Outline& outline,
                      const CollisionStep::Walls& walls, double h);

 private:
  Participant vehicle_;
  ContactSet contacts_{vehicle_};
  StepImpact impact_;
};

}  // namespace bumper
