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

  /// `walls` are those within the outline enlarged by approach speed × penetration time on every
  /// side. `motion` is the vehicle's position now with the velocity that it would have at the
  /// step's end without walls. Walls that the outline overlaps while approaching them push back,
  /// the one touched first before the others, until nothing approaches.
  StepOutcome resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                      std::span<const WallSegment> walls);

 private:
  /// One point of the outline, a wall's normal there, and how fast they close, m/s.
  struct Approach {
    ContactPoint contact;
    Vector2 normal;
    double speed = 0.0;
  };

  /// A wall nearby, and what is known of the outline in it.
  struct Wall {
    Overlap overlap;
    const ResponseSettings* settings = nullptr;
    Vector2 startPoint;
    Vector2 endPoint;
    bool touched = false;  ///< the outline overlaps it
    bool hidden = false;   ///< … but it lies behind another touched wall
    bool struck = false;   ///< … and `contact` has had an impulse
    bool passed = false;   ///< … that lets the vehicle through
    Approach contact;
  };

  /// The next impulse to apply; none if `wall` is null.
  struct Next {
    Wall* wall = nullptr;
    Approach at;
  };

  void mergeWalls(std::span<const WallSegment> walls, const Vector2& centre);
  void findTouched();
  void findHidden();
  Next firstNewWall();
  Next fastestStruckWall();
  [[nodiscard]] Approach approach(const ContactPoint& contact, const Vector2& normal) const;
  [[nodiscard]] Approach touching(const Wall& wall) const;
  [[nodiscard]] Approach middleOfChain(const Wall& struck, double penetration) const;
  [[nodiscard]] double sinceTouch(const Wall& wall) const;

  // Of the step that is being resolved.
  Outline outline_{VehicleParameters{}};
  PlanarMotion motion_;

  std::vector<WallSegment> merged_;
  std::vector<Wall> walls_;
  std::vector<StepImpact> impacts_;
};

}  // namespace bumper
