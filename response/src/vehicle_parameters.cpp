#include "bumper/response/vehicle_parameters.h"

#include <cmath>
#include <sstream>

#include "bumper/response/error.h"

namespace bumper {

namespace {

void requirePositive(double value, const char* name, const char* unit) {
  if (std::isfinite(value) && value > 0.0) return;
  std::ostringstream message;
  message << "VehicleParameters::" << name << " is " << value << ' ' << unit
          << ": it must be finite and positive";
  throw Error(message.str());
}

}  // namespace

void validate(const VehicleParameters& vehicle) {
  requirePositive(vehicle.mass, "mass", "kg");
  requirePositive(vehicle.yawInertia, "yawInertia", "kg m²");
  requirePositive(vehicle.massCentreToFront, "massCentreToFront", "m");
  requirePositive(vehicle.massCentreToRear, "massCentreToRear", "m");
  requirePositive(vehicle.width, "width", "m");
  requirePositive(vehicle.massCentreHeight, "massCentreHeight", "m");
}

}  // namespace bumper
