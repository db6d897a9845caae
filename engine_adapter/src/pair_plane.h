#pragma once

#include <Eigen/Core>

#include "bumper/response/island_step.h"
#include "envelope.h"
#include "vehicle_bodies.h"

namespace bumper {

/// The plane in which two vehicles meet: its normal is the normalised sum of their up axes, its
/// origin the first one's mass centre. Each outline is carried into it by the smallest rotation, so
/// it stays the rectangle that it is.
class PairPlane {
 public:
  PairPlane(const VehiclePose& first, const VehiclePose& second);

  [[nodiscard]] PairFrame frameOf(const VehiclePose& vehicle) const;
  [[nodiscard]] Eigen::Vector3d toWorld(const Vector2& direction) const {
    return axes_.leftCols<2>() * direction;
  }
  [[nodiscard]] Eigen::Vector3d placeOf(const Vector2& point) const {
    return origin_ + toWorld(point);
  }
  [[nodiscard]] Eigen::Vector3d normal() const { return axes_.col(2); }

 private:
  Eigen::Vector3d origin_;
  Eigen::Matrix3d axes_;
};

/// Whether the bands of two vehicles overlap along their plane's normal: one on a bridge above the
/// other does not meet it.
bool bandsOverlap(const PairPlane& plane, const VehiclePose& first, const Envelope& firstBand,
                  const VehiclePose& second, const Envelope& secondBand);

}  // namespace bumper
