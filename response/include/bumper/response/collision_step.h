#pragma once

#include <span>
#include <vector>

#include "bumper/response/force_pulse.h"
#include "bumper/response/impact.h"

namespace bumper {

/// An impact of this step and the response to it.
struct StepImpact {
  Impact impact;
  ImpactResponse response;
};

/// What a vehicle's walls do to it in one step.
struct StepOutcome {
  /// In the order in which they act; valid until the next call.
  std::span<const StepImpact> impacts;
  PlanarImpulse impulse;  ///< of all impacts together
  PlanarMotion after;     ///< the motion with that impulse: the paper's other choice, state reset
  bool settled = true;    ///< false: the vehicle still approached a wall when the bound was reached
};

/// One vehicle, one step: walls nearby in, impacts out. Knows no engine. Holds only scratch memory
/// that is used again from step to step, so one object serves any number of vehicles in turn.
class CollisionStep {
 public:
  CollisionStep();

  /// At most this many impulses are applied in one step.
  static constexpr int maxImpacts = 32;

  /// `motion` is the vehicle's position now with the velocity that it would have at the step's end
  /// without walls. Walls that the outline overlaps while approaching them push back, the one
  /// touched first before the others, until nothing approaches.
  StepOutcome resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                      std::span<const WallSegment> walls);

 private:
  /// A wall that the outline overlaps.
  struct Touched {
    Overlap overlap;
    const ResponseSettings* settings = nullptr;
    bool hidden = false;
    bool struck = false;
    double penetration = 0.0;  ///< at which its contact point is taken, once struck
  };

  /// The next impulse to apply: which wall, and where on the outline.
  struct Next {
    Touched* wall = nullptr;
    ContactPoint contact;
    double urgency = 0.0;
  };

  void mergeWalls(std::span<const WallSegment> walls, const Vector2& centre);
  void findTouched(const Outline& outline, const PlanarMotion& motion);
  void dropHidden(const Outline& outline, const PlanarMotion& motion);
  Next nextImpact(const Outline& outline, const PlanarMotion& motion);

  std::vector<WallSegment> merged_;
  std::vector<Touched> touched_;
  std::vector<StepImpact> impacts_;
};

}  // namespace bumper
