#include "recording_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "bumper/response/error.h"

namespace bumper {

namespace {

constexpr double unitTolerance = 0.001;
/// What normalising leaves: a quaternion as near as this is not normalised again, so that a pose
/// keeps its bits from file to file.
constexpr double unitRounding = 8.0 * std::numeric_limits<double>::epsilon();

/// Who is at fault: "Recording: pose of "car"".
struct Owner {
  const char* kind;
  std::string_view vehicle;
  double time;

  [[noreturn]] void reject(const std::string& defect, const std::string& allowed) const {
    std::ostringstream message;
    message.precision(17);
    message << "Recording: " << kind << " of \"" << vehicle << "\": its " << defect << " (time "
            << time << " s): " << allowed;
    throw Error(message.str());
  }

  void requireFinite(bool finite, const char* quantity) const {
    if (!finite) reject(std::string(quantity) + " is not finite", "it must be finite");
  }

  /// NaN is allowed: not known.
  template <typename Vector>
  void requireNoInfinity(const Vector& numbers, const char* quantity) const {
    for (const double number : numbers) {
      if (std::isinf(number)) {
        reject(std::string(quantity) + " is infinite", "it must be finite, or NaN if not known");
      }
    }
  }

  void requireOrder(std::optional<double> last) const {
    if (!last || time >= *last) return;
    std::ostringstream allowed;
    allowed.precision(17);
    allowed << "it must not be less than the last one's, " << *last << " s";
    reject("time goes back", allowed.str());
  }
};

}  // namespace

RecordedVehicle checkedVehicle(std::string name, const VehicleParameters& parameters,
                               RunParameters settings, std::span<const RecordedVehicle> others) {
  validate(parameters);
  if (std::ranges::find(others, name, &RecordedVehicle::name) != others.end())
    throw Error("Recording: the vehicle name \"" + name + "\" is taken; each must be its own");
  return {.name = std::move(name),
          .parameters = parameters,
          .settings = std::move(settings),
          .poses = {}};
}

void checkIndex(std::size_t vehicle, std::size_t count) {
  if (vehicle < count) return;
  throw Error("Recording: there is no vehicle " + std::to_string(vehicle) + "; " +
              std::to_string(count) + " were added");
}

RecordedPose checkedPose(const RecordedPose& pose, const std::string& vehicle,
                         std::optional<double> last) {
  const Owner owner{.kind = "pose", .vehicle = vehicle, .time = pose.time};
  owner.requireFinite(std::isfinite(pose.time), "time");
  owner.requireFinite(pose.position.allFinite(), "position");
  owner.requireFinite(pose.orientation.coeffs().allFinite(), "orientation");
  owner.requireFinite(pose.velocity.allFinite(), "velocity");
  owner.requireFinite(std::isfinite(pose.yawRate), "yaw rate");
  if (std::abs(pose.orientation.norm() - 1.0) > unitTolerance)
    owner.reject("orientation is not a rotation", "it must be of unit length");
  owner.requireOrder(last);
  RecordedPose kept = pose;
  if (std::abs(kept.orientation.squaredNorm() - 1.0) > unitRounding) kept.orientation.normalize();
  return kept;
}

std::size_t vehicleOf(const ImpactEvent& event, std::span<const RecordedVehicle> vehicles) {
  const auto found = std::ranges::find_if(vehicles, [&](const RecordedVehicle& vehicle) {
    return std::string_view(vehicle.name) == event.vehicle;
  });
  if (found == vehicles.end()) {
    throw Error("Recording: impact of \"" + std::string(event.vehicle) +
                "\", which is not one of its vehicles");
  }
  return static_cast<std::size_t>(found - vehicles.begin());
}

void checkImpact(const ImpactEvent& event, std::optional<double> last) {
  const Owner owner{.kind = "impact", .vehicle = event.vehicle, .time = event.time};
  owner.requireFinite(std::isfinite(event.time), "time");
  owner.requireFinite(event.contact.allFinite(), "contact point");
  owner.requireFinite(event.normal.allFinite(), "normal");
  owner.requireFinite(event.arm.allFinite(), "arm");
  owner.requireFinite(std::isfinite(event.impulseNormal) && std::isfinite(event.impulseTangent),
                      "impulse");
  owner.requireFinite(std::isfinite(event.deltaV), "velocity change");
  owner.requireFinite(std::isfinite(event.speedBefore) && std::isfinite(event.speedAfter), "speed");
  owner.requireFinite(std::isfinite(event.yawRateBefore) && std::isfinite(event.yawRateAfter),
                      "yaw rate");
  owner.requireFinite(event.velocityAfter.allFinite(), "velocity after");
  if (std::abs(event.normal.norm() - 1.0) > unitTolerance)
    owner.reject("normal is not a direction", "it must be of unit length");
  owner.requireNoInfinity(event.velocityBefore, "velocity before");
  if (!event.otherVehicle.empty()) {
    if (event.otherVehicle == event.vehicle)
      owner.reject("other vehicle is itself", "it must be another");
    owner.requireNoInfinity(event.otherArm, "other vehicle's arm");
    owner.requireNoInfinity(event.otherVelocityBefore, "other vehicle's velocity before");
    owner.requireNoInfinity(event.otherVelocityAfter, "other vehicle's velocity after");
    owner.requireNoInfinity(Vector2(event.otherYawRateBefore, event.otherYawRateAfter),
                            "other vehicle's yaw rate");
  }
  owner.requireOrder(last);
}

}  // namespace bumper
