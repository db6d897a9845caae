#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/render/run_description.h"
#include "bumper/response/impact_event.h"
#include "bumper/response/vehicle_parameters.h"

namespace BUMPER_API bumper {

/// Where a vehicle is and how it moves at one instant. World frame: right-handed, z up, SI units.
struct RecordedPose {
  double time = 0.0;                                                ///< s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< mass centre, m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< vehicle axes to world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< mass centre, m/s
  double yawRate = 0.0;  ///< about the vehicle's own z axis, rad/s, positive turning left
};

/// The direction in which the vehicle's x axis points on the ground, rad in [−π, π], positive to
/// the left of the world's x axis.
double heading(const Eigen::Quaterniond& orientation);

/// An ImpactEvent that owns its names: the vehicle and the barrier may be gone.
class RecordedImpact {
 public:
  explicit RecordedImpact(const ImpactEvent& event);

  /// The event as it was handed over; its names live as long as this object stays in its place.
  [[nodiscard]] ImpactEvent event() const;

 private:
  ImpactEvent event_;
  std::string vehicle_;
  std::string barrier_;
  std::string otherVehicle_;
  std::string material_;
};

/// The impact as a vehicle sees it: as it is for the one that the event is about; with all that is
/// its own and the other's exchanged for the other one, whose angles of the centre's velocity and
/// the heading are NaN, not known; nothing for a vehicle that takes no part.
std::optional<ImpactEvent> asSeenBy(std::string_view vehicle, const ImpactEvent& event);

/// How hard an impact is: the larger Δv of those that take part and are known, m/s.
double hardness(const ImpactEvent& event);

struct RecordedVehicle {
  std::string name;
  VehicleParameters parameters;
  RunParameters settings;           ///< what else the application states of it
  std::vector<RecordedPose> poses;  ///< in order of time
};

/// The pose at a time: linear interpolation between the two poses around it, spherical for the
/// orientation along the shorter arc; nothing before the first pose, after the last, or without
/// poses. Of two poses at the same time the later counts.
std::optional<RecordedPose> poseAt(const RecordedVehicle& vehicle, double time);

/// What a run did: the vehicles, where they were over time, and their impacts. An application fills
/// it from its loop; pictures and files are made from it.
class Recording {
 public:
  /// Returns the vehicle's index. Throws Error if the name is taken or a parameter is not finite
  /// and positive.
  std::size_t addVehicle(std::string name, const VehicleParameters& parameters,
                         RunParameters settings = {});

  /// Adds a pose of the vehicle with that index. Throws Error if there is no such vehicle, a number
  /// is not finite, the orientation is not of unit length to 0.001 (it is then normalised), or the
  /// time lies before that of the vehicle's last pose.
  void addPose(std::size_t vehicle, const RecordedPose& pose);

  /// Adds an impact of the vehicle that the event names; the other vehicle need not be recorded.
  /// Throws Error if there is no such vehicle, or it is its own other one; if the time, the contact
  /// point, the normal, the arm, the impulse, Δv, a speed, a yaw rate or the velocity after is not
  /// finite; if the velocity before or anything of the other vehicle's is infinite; if the normal
  /// is not of unit length to 0.001; or if the time lies before that of the vehicle's last impact.
  /// The other numbers may be NaN: not known.
  void addImpact(const ImpactEvent& event);

  [[nodiscard]] std::span<const RecordedVehicle> vehicles() const { return vehicles_; }
  /// In the order in which they were added.
  [[nodiscard]] std::span<const RecordedImpact> impacts() const { return impacts_; }

 private:
  std::vector<RecordedVehicle> vehicles_;
  std::vector<RecordedImpact> impacts_;
  std::vector<std::optional<double>> lastImpacts_;  ///< of each vehicle, s
};

}  // namespace bumper
