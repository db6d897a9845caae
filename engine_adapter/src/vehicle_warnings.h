#pragma once

#include <ode/ode.h>

#include <optional>
#include <string>
#include <vector>

#include "bumper/engine_adapter/vehicle.h"
#include "vehicle_bodies.h"

namespace bumper {

/// What about a vehicle would falsify its impulses or let it go into walls, a sentence each.
std::vector<std::string> warningsOf(const VehicleBodies& bodies,
                                    const VehicleParameters& parameters, const Band& band,
                                    const std::string& name);

/// Whether the world's gravity says that up is not along z.
std::optional<std::string> warningOf(dWorldID world);

}  // namespace bumper
