#include "pair_plane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bumper {

PairPlane::PairPlane(const VehiclePose& first, const VehiclePose& second)
    : origin_(first.massCentre) {
  const Eigen::Vector3d normal = (first.up() + second.up()).normalized();
  axes_.col(2) = normal;
  axes_.col(0) = (Eigen::Vector3d::UnitX() - normal.x() * normal).normalized();
  axes_.col(1) = normal.cross(axes_.col(0));
}

PairFrame PairPlane::frameOf(const VehiclePose& vehicle) const {
  const Eigen::Vector3d ahead =
      Eigen::Quaterniond::FromTwoVectors(vehicle.up(), normal()) * vehicle.axes.col(0);
  const Eigen::Vector3d away = vehicle.massCentre - origin_;
  return {.origin = {axes_.col(0).dot(away), axes_.col(1).dot(away)},
          .yaw = std::atan2(axes_.col(1).dot(ahead), axes_.col(0).dot(ahead))};
}

bool bandsOverlap(const PairPlane& plane, const VehiclePose& first, const Envelope& firstBand,
                  const VehiclePose& second, const Envelope& secondBand) {
  const double higher = plane.normal().dot(second.massCentre - first.massCentre);
  return firstBand.low() <= higher + secondBand.high() &&
         higher + secondBand.low() <= firstBand.high();
}

}  // namespace bumper
