#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "bumper/response/vehicle_parameters.h"

namespace bumper::doctor {

/// "car", "van", "lorry", "motorcycle" and "model" (a car of 1:10).
std::span<const std::string_view> vehicleNames();
std::optional<VehicleParameters> findVehicle(std::string_view name);

/// What is not given is the model's: the mass centre stays in its place along the length, and the
/// yaw inertia keeps its ratio to mass times length².
struct VehicleChanges {
  std::optional<double> length{};             ///< m
  std::optional<double> width{};              ///< m
  std::optional<double> mass{};               ///< kg
  std::optional<double> yawInertia{};         ///< kg m²
  std::optional<double> massCentreToFront{};  ///< m
  std::optional<double> massCentreHeight{};   ///< m
};
/// Throws Error, naming the value, unless the result is a vehicle.
VehicleParameters changed(const VehicleParameters& model, const VehicleChanges& changes);

}  // namespace bumper::doctor
