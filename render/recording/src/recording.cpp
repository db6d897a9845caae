#include "bumper/render/recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "recording_checks.h"

namespace bumper {

double heading(const Eigen::Quaterniond& orientation) {
  const Eigen::Vector3d forward = orientation * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

RecordedImpact::RecordedImpact(const ImpactEvent& event)
    : event_(event),
      vehicle_(event.vehicle),
      barrier_(event.barrier),
      otherVehicle_(event.otherVehicle),
      material_(event.material) {
  event_.vehicle = event_.barrier = event_.otherVehicle = event_.material = {};
}

ImpactEvent RecordedImpact::event() const {
  ImpactEvent result = event_;
  result.vehicle = vehicle_;
  result.barrier = barrier_;
  result.otherVehicle = otherVehicle_;
  result.material = material_;
  return result;
}

std::optional<ImpactEvent> asSeenBy(std::string_view vehicle, const ImpactEvent& event) {
  if (event.vehicle == vehicle) return event;
  if (event.otherVehicle.empty() || event.otherVehicle != vehicle) return {};
  ImpactEvent other = event;
  std::swap(other.vehicle, other.otherVehicle);
  std::swap(other.arm, other.otherArm);
  std::swap(other.velocityBefore, other.otherVelocityBefore);
  std::swap(other.velocityAfter, other.otherVelocityAfter);
  std::swap(other.yawRateBefore, other.otherYawRateBefore);
  std::swap(other.yawRateAfter, other.otherYawRateAfter);
  other.speedBefore = other.velocityBefore.norm();
  other.speedAfter = other.velocityAfter.norm();
  other.deltaV = (other.velocityAfter - other.velocityBefore).norm();
  // Its impulse is the opposite one, and so are its normal and its tangent: their shares are the
  // same numbers.
  other.normal = -event.normal;
  other.angles.centreVelocity = other.angles.heading = std::numeric_limits<double>::quiet_NaN();
  return other;
}

double hardness(const ImpactEvent& event) {
  const auto other = asSeenBy(event.otherVehicle, event);
  return other && other->deltaV > event.deltaV ? other->deltaV : event.deltaV;
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

std::size_t Recording::addVehicle(std::string name, const VehicleParameters& parameters,
                                  RunParameters settings) {
  vehicles_.push_back(checkedVehicle(std::move(name), parameters, std::move(settings), vehicles_));
  lastImpacts_.emplace_back();
  return vehicles_.size() - 1;
}

void Recording::addPose(std::size_t vehicle, const RecordedPose& pose) {
  checkIndex(vehicle, vehicles_.size());
  RecordedVehicle& owner = vehicles_[vehicle];
  owner.poses.push_back(
      checkedPose(pose, owner.name,
                  owner.poses.empty() ? std::nullopt : std::optional(owner.poses.back().time)));
}

void Recording::addImpact(const ImpactEvent& event) {
  std::optional<double>& last = lastImpacts_[vehicleOf(event, vehicles_)];
  checkImpact(event, last);
  impacts_.emplace_back(event);
  last = event.time;
}

}  // namespace bumper
