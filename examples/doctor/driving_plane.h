#pragma once

#include <Eigen/Core>

#include "bumper/response/planar_motion.h"

namespace bumper::doctor {

inline constexpr double degree = 0.017453292519943295;  // rad

/// A plane that a vehicle's mass centre moves in, level or leaning with a slope.
struct DrivingPlane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: its x, its y, up

  [[nodiscard]] Eigen::Vector3d local(const Eigen::Vector3d& point) const {
    return axes.transpose() * (point - origin);
  }
  [[nodiscard]] Eigen::Vector3d world(const Vector2& point, double height = 0.0) const {
    return origin + axes * Eigen::Vector3d(point.x(), point.y(), height);
  }
  [[nodiscard]] Eigen::Vector3d direction(const Vector2& local) const {
    return axes.leftCols<2>() * local;
  }
};

}  // namespace bumper::doctor
