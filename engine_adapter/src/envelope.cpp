#include "envelope.h"

#include <algorithm>
#include <cmath>

namespace bumper {

Envelope::Envelope(const VehicleParameters& parameters, const Band& band)
    : outline_(parameters),
      low_(band.bottom - parameters.massCentreHeight),
      high_(band.top - parameters.massCentreHeight),
      radius_(std::hypot(std::max(outline_.front, outline_.rear), outline_.halfWidth,
                         std::max(std::abs(low_), std::abs(high_)))) {}

PlanRectangle Envelope::swept(const PlanarMotion& motion, double h) const {
  // A little more than rounding and what counts as a touch.
  constexpr double slack = 1e-6;  // m
  const Vector2 way = h * motion.velocity;
  PlanRectangle all = outline_.enlarged(h * std::abs(motion.yawRate) * outline_.radius() + slack);
  all.middle += 0.5 * way;
  all.half += 0.5 * way.cwiseAbs();
  return all;
}

bool Envelope::inBand(const VehiclePose& pose, const Eigen::Vector3d& place, double foot,
                      double top) const {
  const auto height = [&](double z) {
    return pose.up().dot(Eigen::Vector3d(place.x(), place.y(), z) - pose.massCentre);
  };
  return height(top) >= low_ && height(foot) <= high_;
}

bool Envelope::isAboveBottom(const VehiclePose& pose, const Eigen::Vector3d& place) const {
  return pose.up().dot(place - pose.massCentre) >= low_;
}

bool Envelope::isBelowTop(const VehiclePose& pose, const Eigen::Vector3d& place) const {
  return pose.up().dot(place - pose.massCentre) <= high_;
}

bool Envelope::allInBand(const VehiclePose& pose, double highestFoot, double lowestTop) const {
  const Eigen::Vector3d up = pose.up();
  const double slack = radius_ * up.head<2>().norm();
  const double footHeight = (highestFoot - pose.massCentre.z()) * up.z() + slack;
  const double topHeight = (lowestTop - pose.massCentre.z()) * up.z() - slack;
  return topHeight >= low_ && footHeight <= high_;
}

}  // namespace bumper
