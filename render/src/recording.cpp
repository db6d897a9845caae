#include "bumper/render/recording.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "bumper/response/error.h"

namespace bumper {

namespace {

constexpr double unitTolerance = 0.001;

[[noreturn]] void reject(const std::string& what, double time, const std::string& allowed) {
  std::ostringstream message;
  message.precision(17);
  message << what << " (time " << time << " s): " << allowed;
  throw Error(message.str());
}

void requireFinite(bool finite, const std::string& owner, const char* quantity, double time) {
  if (!finite) reject(owner + ": its " + quantity + " is not finite", time, "it must be finite");
}

void requireOrder(double time, double last, const std::string& owner) {
  if (time >= last) return;
  std::ostringstream allowed;
  allowed.precision(17);
  allowed << "it must not be less than the last one's, " << last << " s";
  reject(owner + ": its time goes back", time, allowed.str());
}

}  // namespace

double heading(const Eigen::Quaterniond& orientation) {
  const Eigen::Vector3d forward = orientation * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

RecordedImpact::RecordedImpact(const ImpactEvent& event)
    : event_(event), vehicle_(event.vehicle), barrier_(event.barrier), material_(event.material) {
  event_.vehicle = event_.barrier = event_.material = {};
}

ImpactEvent RecordedImpact::event() const {
  ImpactEvent result = event_;
  result.vehicle = vehicle_;
  result.barrier = barrier_;
  result.material = material_;
  return result;
}

std::optional<RecordedPose> poseAt(const RecordedVehicle& vehicle, double time) {
  const auto& poses = vehicle.poses;
  if (poses.empty() || !(time >= poses.front().time && time <= poses.back().time)) return {};
  const auto next = std::ranges::upper_bound(poses, time, {}, &RecordedPose::time);
  const RecordedPose& before = *std::prev(next);
  if (next == poses.end() || before.time == time) return before;
  const double share = (time - before.time) / (next->time - before.time);
  RecordedPose pose;
  pose.time = time;
  pose.position = before.position + share * (next->position - before.position);
  pose.orientation = before.orientation.slerp(share, next->orientation);
  pose.velocity = before.velocity + share * (next->velocity - before.velocity);
  pose.yawRate = before.yawRate + share * (next->yawRate - before.yawRate);
  return pose;
}

std::size_t Recording::addVehicle(std::string name, const VehicleParameters& parameters) {
  validate(parameters);
  if (std::ranges::find(vehicles_, name, &RecordedVehicle::name) != vehicles_.end())
    throw Error("Recording: the vehicle name \"" + name + "\" is taken; each must be its own");
  vehicles_.push_back({std::move(name), parameters, {}});
  return vehicles_.size() - 1;
}

void Recording::addPose(std::size_t vehicle, const RecordedPose& pose) {
  if (vehicle >= vehicles_.size()) {
    throw Error("Recording: there is no vehicle " + std::to_string(vehicle) + "; " +
                std::to_string(vehicles_.size()) + " were added");
  }
  auto& [name, parameters, poses] = vehicles_[vehicle];
  const std::string owner = "Recording: pose of \"" + name + '"';
  requireFinite(std::isfinite(pose.time), owner, "time", pose.time);
  requireFinite(pose.position.allFinite(), owner, "position", pose.time);
  requireFinite(pose.orientation.coeffs().allFinite(), owner, "orientation", pose.time);
  requireFinite(pose.velocity.allFinite(), owner, "velocity", pose.time);
  requireFinite(std::isfinite(pose.yawRate), owner, "yaw rate", pose.time);
  if (std::abs(pose.orientation.norm() - 1.0) > unitTolerance)
    reject(owner + ": its orientation is not a rotation", pose.time, "it must be of unit length");
  if (!poses.empty()) requireOrder(pose.time, poses.back().time, owner);
  poses.push_back(pose);
  poses.back().orientation.normalize();
}

void Recording::addImpact(const ImpactEvent& event) {
  const std::string vehicle(event.vehicle);
  if (std::ranges::find(vehicles_, vehicle, &RecordedVehicle::name) == vehicles_.end())
    throw Error("Recording: impact of \"" + vehicle + "\", which is not one of its vehicles");
  const std::string owner = "Recording: impact of \"" + vehicle + '"';
  requireFinite(std::isfinite(event.time), owner, "time", event.time);
  requireFinite(event.contact.allFinite(), owner, "contact point", event.time);
  requireFinite(event.normal.allFinite(), owner, "normal", event.time);
  requireFinite(event.arm.allFinite(), owner, "arm", event.time);
  requireFinite(std::isfinite(event.impulseNormal) && std::isfinite(event.impulseTangent), owner,
                "impulse", event.time);
  requireFinite(std::isfinite(event.deltaV), owner, "velocity change", event.time);
  requireFinite(std::isfinite(event.speedBefore) && std::isfinite(event.speedAfter), owner, "speed",
                event.time);
  requireFinite(std::isfinite(event.yawRateBefore) && std::isfinite(event.yawRateAfter), owner,
                "yaw rate", event.time);
  requireFinite(event.velocityAfter.allFinite(), owner, "velocity after", event.time);
  if (std::abs(event.normal.norm() - 1.0) > unitTolerance)
    reject(owner + ": its normal is not a direction", event.time, "it must be of unit length");
  const auto last = std::find_if(
      impacts_.rbegin(), impacts_.rend(),
      [&](const RecordedImpact& impact) { return impact.event().vehicle == event.vehicle; });
  if (last != impacts_.rend()) requireOrder(event.time, last->event().time, owner);
  impacts_.emplace_back(event);
}

}  // namespace bumper
