#pragma once

#include <cmath>

#include "bumper/response/outline.h"
#include "bumper/response/planar_body.h"

namespace bumper {

/// A free body of an encounter and its outline.
struct Participant {
  PlanarBody body;
  Outline outline{VehicleParameters{}};

  /// No point of the outline is faster, m/s.
  [[nodiscard]] double fastest() const {
    return body.motion.velocity.norm() + std::abs(body.motion.yawRate) * outline.radius();
  }
  /// The maximum acceleration of any gap between outline and wall in free flight, m/s².
  [[nodiscard]] double gapAcceleration() const {
    const double turning = std::abs(body.motion.yawRate);
    return turning * (2.0 * body.motion.velocity.norm() + turning * outline.radius());
  }
};

}  // namespace bumper
