#pragma once

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

/// The vehicle data of the response: the six parameters of the paper's section "Initialization".
/// The four dimensions span the outline, a rectangle in the vehicle's yaw plane.
struct VehicleParameters {
  /// Whole vehicle, kg. Positive.
  double mass = 0.0;
  /// Whole vehicle about the vertical axis through its mass centre, kg m². Positive.
  double yawInertia = 0.0;
  /// Mass centre to the foremost point of the body, m. Positive.
  double massCentreToFront = 0.0;
  /// Mass centre to the rearmost point of the body, m. Positive.
  double massCentreToRear = 0.0;
  /// Overall width, m; the mass centre lies in its middle. Positive.
  double width = 0.0;
  /// Mass centre above the ground, m. Positive.
  double massCentreHeight = 0.0;
};

/// Throws Error, naming the value, unless every parameter is finite and positive.
void validate(const VehicleParameters& vehicle);

}  // namespace bumper
