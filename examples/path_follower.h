#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "yaw_plane_car.h"

namespace bumper::examples {

/// Steers a car along a closed line and holds its speed, less in bends.
class PathFollower {
 public:
  /// `path`: points in order, some metres apart; the last is followed by the first.
  PathFollower(std::vector<Eigen::Vector2d> path, double speed);

  /// Sets the car's steering and driving force for the coming step.
  void control(YawPlaneCar& car);

  /// Whole rounds of the path so far.
  [[nodiscard]] int laps() const { return laps_; }

 private:
  [[nodiscard]] double curvatureTo(const YawPlaneCar& car, double ahead) const;

  std::vector<Eigen::Vector2d> path_;
  double speed_;
  std::size_t nearest_ = 0;
  int laps_ = 0;
};

}  // namespace bumper::examples
