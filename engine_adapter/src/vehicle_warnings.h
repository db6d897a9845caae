#pragma once

#include <ode/ode.h>

#include <optional>
#include <string>
#include <vector>

#include "bumper/engine_adapter/vehicle.h"
#include "vehicle_bodies.h"

namespace bumper {

/// What would falsify a vehicle's impulses or let it penetrate walls, a sentence each.
std::vector<std::string> warningsOf(const VehicleBodies& bodies,
                                    const VehicleParameters& parameters, const Band& band,
                                    const std::string& name);

/// A warning if the world's gravity is not along −up.
std::optional<std::string> warningOf(dWorldID world, const WorldFrame& frame);

}  // namespace bumper
