#pragma once

#include "bumper/response/vehicle_parameters.h"

namespace bumper::tests {

/// The car of most tests, about the paper's.
inline constexpr VehicleParameters car{.mass = 1500.0,
                                       .yawInertia = 2600.0,
                                       .massCentreToFront = 2.1,
                                       .massCentreToRear = 2.5,
                                       .width = 1.8,
                                       .massCentreHeight = 0.55};

}  // namespace bumper::tests
