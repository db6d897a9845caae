#pragma once

#include <cmath>
#include <limits>

#include "bumper/base/api.h"
#include "bumper/response/planar_motion.h"
#include "bumper/response/vehicle_parameters.h"

namespace BUMPER_API bumper {

/// A rigid body in a yaw plane. A free one has finite mass and yaw inertia; a fixed one, the
/// default, has neither and is at rest; a driven one has neither and moves as prescribed.
struct PlanarBody {
  double mass = std::numeric_limits<double>::infinity();  ///< kg, > 0
  double yawInertia =
      std::numeric_limits<double>::infinity();  ///< about the mass centre, kg m², > 0
  PlanarMotion motion;

  [[nodiscard]] bool isFree() const { return std::isfinite(mass); }

  /// An impulse on the body and its moment about the mass centre (Eqs. 1 and 2).
  void apply(const PlanarImpulse& impulse) {
    motion = afterImpulse(motion, impulse, mass, yawInertia);
  }

  /// Of a free body, J (Eq. 25); 0 for others.
  [[nodiscard]] double energy() const {
    return isFree() ? yawPlaneEnergy(motion, mass, yawInertia) : 0.0;
  }
};

/// A vehicle that moves as `motion` says.
inline PlanarBody freeBody(const VehicleParameters& vehicle, const PlanarMotion& motion) {
  return {.mass = vehicle.mass, .yawInertia = vehicle.yawInertia, .motion = motion};
}

}  // namespace bumper
