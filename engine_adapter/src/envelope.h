#pragma once

#include <Eigen/Core>

#include "bumper/engine_adapter/vehicle.h"
#include "bumper/response/outline.h"
#include "vehicle_bodies.h"

namespace bumper {

/// The vehicle's volume for walls: its outline, over the band. In the vehicle's own frame: axes
/// forward, left, up; origin at the mass centre.
class Envelope {
 public:
  /// `band` is above the ground, the mass centre at parameters.massCentreHeight.
  Envelope(const VehicleParameters& parameters, const Band& band);

  [[nodiscard]] const Outline& outline() const { return outline_; }
  /// The band's limits, m above the mass centre.
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  [[nodiscard]] double bandHeight() const { return high_ - low_; }
  [[nodiscard]] double middleHeight() const { return 0.5 * (low_ + high_); }
  /// Of a sphere around the mass centre that holds all of it, m.
  [[nodiscard]] double radius() const { return radius_; }
  /// The area swept by the outline in a step of `h` seconds of free motion. `motion` is in the
  /// vehicle's axes at the step's start.
  [[nodiscard]] PlanRectangle swept(const PlanarMotion& motion, double h) const;

  /// Whether a wall that stands between the heights foot and top at a place of the world reaches
  /// into the band.
  [[nodiscard]] bool inBand(const VehiclePose& pose, const Eigen::Vector3d& place, double foot,
                            double top) const;
  /// Whether a place of the world lies above the band's lower limit.
  [[nodiscard]] bool isAboveBottom(const VehiclePose& pose, const Eigen::Vector3d& place) const;
  /// Whether it lies below the band's upper limit.
  [[nodiscard]] bool isBelowTop(const VehiclePose& pose, const Eigen::Vector3d& place) const;
  /// The same as inBand() for every wall within radius() that has its foot no higher and its top no
  /// lower than these; false if in doubt.
  [[nodiscard]] bool allInBand(const VehiclePose& pose, double highestFoot, double lowestTop) const;

 private:
  Outline outline_;
  double low_;
  double high_;
  double radius_;
};

}  // namespace bumper
