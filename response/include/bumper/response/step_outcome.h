#pragma once

#include <span>

#include "bumper/base/api.h"
#include "bumper/response/impact.h"

namespace BUMPER_API bumper {

/// An impact of one step and the response to it. Its impulse acts at its arm, and leads from the
/// motion before to the motion after.
///
/// The impulse that ends the approach at several points at once is reported as one impact for each
/// of them, the fastest first. No motion between these existed, and it may be fast where walls face
/// each other. So approachSpeed is the one before all of them; energyChange and energyRatio are
/// shares of the total energy change; no share is a gain.
struct StepImpact {
  double time = 0.0;  ///< of the impact, s from the step's start
  Impact impact{};
  ImpactResponse response{};
  /// Part of a sliding contact within the step: a wall's end along a turning side.
  bool slides = false;
  /// This one and the next are parts of one impulse: energy bounds hold for their sum.
  bool isPartOfNext = false;
};

/// A velocity and yaw rate for one step only: penetration recovery, or holding a vehicle in place.
struct StepShift {
  Vector2 velocity = Vector2::Zero();  ///< m/s
  double yawRate = 0.0;                ///< rad/s
};

/// The effect of walls on a vehicle in one step.
struct StepOutcome {
  /// In the order in which they act; valid until the next call.
  std::span<const StepImpact> impacts;
  PlanarImpulse impulse;  ///< of all impacts together
  PlanarMotion after;     ///< at the step's end; the paper's other choice, state reset
  /// A motion for this step only: it is part of `after`'s position and yaw, not of its velocity.
  StepShift shift;
  /// False: after CollisionStep::maxAnswers the vehicle was held where it was for the rest of the
  /// step.
  bool settled = true;
};

}  // namespace bumper
