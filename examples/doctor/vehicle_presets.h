#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "bumper/response/vehicle_parameters.h"

namespace bumper::doctor {

/// "car", "van", "lorry", "motorcycle" and "model" (a car of 1:10).
std::span<const std::string_view> vehicleNames();
std::optional<VehicleParameters> findVehicle(std::string_view name);

/// Outline, mass and the rest as given, what is not is that of a vehicle like `model`: a length or
/// width scales nothing else but the yaw inertia, which keeps its ratio to mass times length².
struct VehicleChanges {
  std::optional<double> length;             ///< m
  std::optional<double> width;              ///< m
  std::optional<double> mass;               ///< kg
  std::optional<double> yawInertia;         ///< kg m²
  std::optional<double> massCentreToFront;  ///< m
  std::optional<double> massCentreHeight;   ///< m
};
/// Throws Error, naming the value, unless the result is a vehicle.
VehicleParameters changed(const VehicleParameters& model, const VehicleChanges& changes);

}  // namespace bumper::doctor
