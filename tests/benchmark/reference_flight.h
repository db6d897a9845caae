#pragma once

#include <functional>
#include <vector>

#include "bumper/response/force_pulse.h"
#include "bumper/response/planar_motion.h"
#include "bumper/response/response_settings.h"
#include "bumper/response/vehicle_parameters.h"

namespace bumper::benchmark {

/// A straight flat wall of finite length, m.
struct StraightWall {
  Vector2 start = Vector2::Zero();
  Vector2 end = Vector2::Zero();
};

/// One impulse of an instant, on the vehicle.
struct FlightImpact {
  double time = 0.0;              ///< s after the start
  Vector2 arm = Vector2::Zero();  ///< mass centre to contact point, m
  PlanarImpulse impulse;
  PlanarMotion after;
};

/// A vehicle's flight against one wall by the law of the impact, computed event by event. Shares
/// the law of a single impact with the library (respond()), and nothing of its geometry.
struct Flight {
  /// In their order. A lasting contact is in here as many small impulses.
  std::vector<FlightImpact> impacts;
  int impulses = 0;  ///< without those of a lasting contact
  PlanarMotion end;
  /// A wall's end pressed on a side and slid along it: no sequence of impacts any more but a force,
  /// which the reference integrates. Coriolis' acceleration can hold a turning car to an end; a
  /// corner on a face always lifts off by itself.
  bool lasting = false;
  /// False: a point still approached after the last impulse that an instant allows.
  bool settled = true;
};

/// What acts on the vehicle besides walls, as a function of its motion, in the world's frame.
using ForceField = std::function<PlanarForce(const PlanarMotion&)>;

/// Free flight for `duration` seconds from `start`, which must be clear of the wall. Times of
/// impact are roots to the last bit of an extended precision number.
Flight freeFlight(const VehicleParameters& vehicle, const PlanarMotion& start,
                  const StraightWall& wall, const ResponseSettings& settings, double duration);

/// The same under forces: second order in `step` (half a kick, drift with the impacts, half a
/// kick), with an impact's step ended at the impact.
Flight forcedFlight(const VehicleParameters& vehicle, const PlanarMotion& start,
                    const StraightWall& wall, const ResponseSettings& settings, double duration,
                    const ForceField& forces, double step);

/// The position and velocity at `time` of a free flight from `start`.
PlanarMotion motionAt(const Flight& flight, const PlanarMotion& start, double time);

}  // namespace bumper::benchmark
