#pragma once

#include <limits>

#include "bumper/base/api.h"
#include "bumper/response/touch.h"

namespace BUMPER_API bumper {

/// A contact point that approaches more slowly than this, m/s, is at rest to rounding.
inline constexpr double restTolerance = 1e-9;

/// The time of an event that does not occur, later than any other.
inline constexpr double never = std::numeric_limits<double>::max();

/// The least time, s, to cover a distance, m, from an initial rate, m/s, with a maximum
/// acceleration, m/s². A negative rate moves away at first.
double leastTime(double distance, double rate, double acceleration);

/// Continuous collision detection: the outline in free flight from time 0 on, at constant velocity
/// and yaw rate, and walls that rest, or belong to a body that moves so too.
class Sweep {
 public:
  /// `motion` is the vehicle's at time 0, `walls` that of the walls' body: at rest by default.
  Sweep(const Outline& outline, const PlanarMotion& motion, const PlanarMotion& walls = {});

  /// The first time in [from, until], s, at which a point of the outline and a point of the wall
  /// touch while they approach each other: a corner and a face, an end and a side, a post and
  /// either. `wall` is where it is at time 0. `touch` is the result of findTouch() at `from`, in
  /// the axes of time 0, or null. `never` if there is none. Exact to rounding, whatever the speed
  /// and the step. Points that already overlap count again once they have separated.
  [[nodiscard]] double timeOfTouch(const Segment& wall, const Overlap* touch, double from,
                                   double until) const;

 private:
  Outline outline_;
  PlanarMotion motion_;  // as seen from the walls, which turn about the pivot by `spin_`, rad/s
  Vector2 pivot_;
  double spin_;
  Placement start_;
  double speed_;  // of the mass centre, as seen from walls that do not turn, m/s
};

}  // namespace bumper
