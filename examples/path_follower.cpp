#include "path_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bumper::examples {

namespace {

constexpr double lookAheadTime = 0.6;    // s
constexpr double brakingTime = 2.5;      // s
constexpr double sideways = 4.0;         // m/s², in a bend
constexpr double leastLookAhead = 6.0;   // m
constexpr std::size_t searchAhead = 20;  // points of the path
constexpr double mostSteering = 0.35;    // rad
constexpr double speedGain = 3000.0;     // N per m/s
constexpr double mostDrive = 7000.0;     // N

}  // namespace

PathFollower::PathFollower(std::vector<Eigen::Vector2d> path, double speed)
    : path_(std::move(path)), speed_(speed) {}

void PathFollower::control(YawPlaneCar& car) {
  const Eigen::Vector2d place = car.position().head<2>();
  const auto distance = [&](std::size_t i) { return (path_[i % path_.size()] - place).norm(); };
  std::size_t closest = nearest_;
  for (std::size_t i = nearest_; i < nearest_ + searchAhead; ++i) {
    if (distance(i) < distance(closest)) closest = i;
  }
  laps_ += static_cast<int>(closest / path_.size());
  nearest_ = closest % path_.size();
  const double speed = car.forwardSpeed();
  const double wheelbase = car.design().massCentreToFrontAxle + car.design().massCentreToRearAxle;
  const double curvature = curvatureTo(car, std::max(leastLookAhead, lookAheadTime * speed));
  car.steer(std::clamp(std::atan(wheelbase * curvature), -mostSteering, mostSteering));

  // Slow enough for the bend here and the one that braking must be done for.
  const double bend =
      std::max(std::abs(curvature), std::abs(curvatureTo(car, brakingTime * speed)));
  const double allowed = std::min(speed_, std::sqrt(sideways / std::max(bend, 1e-6)));
  car.drive(std::clamp(speedGain * (allowed - speed), -mostDrive, mostDrive));
}

// Pure pursuit: the circle that runs along the car and through the path's point that far away.
double PathFollower::curvatureTo(const YawPlaneCar& car, double ahead) const {
  const Eigen::Vector2d place = car.position().head<2>();
  std::size_t target = nearest_ + 1;
  while ((path_[target % path_.size()] - place).norm() < ahead &&
         target < nearest_ + path_.size()) {
    ++target;
  }
  const Eigen::Vector2d away = path_[target % path_.size()] - place;
  const Eigen::Vector2d forward = car.axes().col(0).head<2>();
  return 2.0 * (forward.x() * away.y() - forward.y() * away.x()) / away.squaredNorm();
}

}  // namespace bumper::examples
