#pragma once

#include <map>
#include <memory>
#include <string>

#include "bumper/base/api.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// By vehicle name: what to draw instead of the car-like body, for instance from loadScene(). Its
/// x axis points forward and z up. It keeps its size and is placed with the middle of its bounding
/// box in the middle of the vehicle's outline, and with its lowest point on the ground,
/// massCentreHeight below the mass centre. Every name must be a vehicle of the recording, and
/// every mesh pass validate().
using VehicleMeshes = std::map<std::string, std::shared_ptr<const Scene>>;

}  // namespace bumper
