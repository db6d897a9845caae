#include "vehicle_presets.h"

#include <algorithm>
#include <array>

namespace bumper::doctor {

namespace {

constexpr std::array<std::string_view, 5> names{"car", "van", "lorry", "motorcycle", "model"};
constexpr std::array<VehicleParameters, 5> vehicles{{
    {.mass = 1500.0,
     .yawInertia = 2600.0,
     .massCentreToFront = 2.1,
     .massCentreToRear = 2.5,
     .width = 1.8,
     .massCentreHeight = 0.55},
    {.mass = 2800.0,
     .yawInertia = 7500.0,
     .massCentreToFront = 2.7,
     .massCentreToRear = 3.2,
     .width = 2.0,
     .massCentreHeight = 0.75},
    {.mass = 16000.0,
     .yawInertia = 120000.0,
     .massCentreToFront = 5.0,
     .massCentreToRear = 5.0,
     .width = 2.5,
     .massCentreHeight = 1.3},
    {.mass = 280.0,
     .yawInertia = 75.0,
     .massCentreToFront = 1.05,
     .massCentreToRear = 1.05,
     .width = 0.8,
     .massCentreHeight = 0.6},
    {.mass = 2.0,
     .yawInertia = 0.035,
     .massCentreToFront = 0.21,
     .massCentreToRear = 0.25,
     .width = 0.18,
     .massCentreHeight = 0.05},
}};

}  // namespace

std::span<const std::string_view> vehicleNames() { return names; }

std::optional<VehicleParameters> findVehicle(std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names.at(i) == name) return vehicles.at(i);
  }
  return std::nullopt;
}

VehicleParameters changed(const VehicleParameters& model, const VehicleChanges& changes) {
  const double before = model.massCentreToFront + model.massCentreToRear;
  VehicleParameters vehicle = model;
  if (changes.length) {
    const double ratio = *changes.length / before;
    vehicle.massCentreToFront *= ratio;
    vehicle.massCentreToRear *= ratio;
    vehicle.yawInertia *= ratio * ratio;
  }
  if (changes.mass) {
    vehicle.yawInertia *= *changes.mass / model.mass;
    vehicle.mass = *changes.mass;
  }
  if (changes.massCentreToFront) {
    const double length = changes.length.value_or(before);
    vehicle.massCentreToFront = *changes.massCentreToFront;
    vehicle.massCentreToRear = length - vehicle.massCentreToFront;
  }
  vehicle.width = changes.width.value_or(vehicle.width);
  vehicle.massCentreHeight = changes.massCentreHeight.value_or(vehicle.massCentreHeight);
  vehicle.yawInertia = changes.yawInertia.value_or(vehicle.yawInertia);
  validate(vehicle);
  return vehicle;
}

}  // namespace bumper::doctor
