#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "bumper/base/api.h"
#include "bumper/response/planar_motion.h"
#include "bumper/response/vehicle_parameters.h"

namespace BUMPER_API bumper {

/// A rectangle along the axes of a vehicle's own frame, m.
struct PlanRectangle {
  Vector2 middle = Vector2::Zero();
  Vector2 half = Vector2::Zero();

  /// From the frame's origin to the farthest corner, m.
  [[nodiscard]] double farthest() const { return (middle.cwiseAbs() + half).norm(); }

  /// Whether it holds no point of the segment between two points.
  [[nodiscard]] bool misses(const Vector2& from, const Vector2& to) const {
    const Vector2 centre = 0.5 * (from + to) - middle;
    const Vector2 arm = 0.5 * (to - from);
    if ((centre.cwiseAbs() - arm.cwiseAbs() - half).maxCoeff() > 0.0) return true;
    // Across the segment.
    return std::abs(cross(arm, centre)) >
           half.x() * std::abs(arm.y()) + half.y() * std::abs(arm.x());
  }
};

/// The smallest that holds both.
inline PlanRectangle hull(const PlanRectangle& a, const PlanRectangle& b) {
  const Vector2 low = (a.middle - a.half).cwiseMin(b.middle - b.half);
  const Vector2 high = (a.middle + a.half).cwiseMax(b.middle + b.half);
  return {.middle = 0.5 * (low + high), .half = 0.5 * (high - low)};
}

/// One side of an outline, in the vehicle's frame.
struct OutlineSide {
  Vector2 out;         ///< unit normal, outwards
  double reach = 0.0;  ///< from the mass centre to the side's line, m
  double low = 0.0;    ///< where it begins and ends along `out` turned left, m
  double high = 0.0;
};

/// The vehicle's bounding rectangle in its yaw plane (the paper's Figure 1), m from the mass
/// centre.
struct Outline {
  double front = 0.0;
  double rear = 0.0;
  double halfWidth = 0.0;

  explicit Outline(const VehicleParameters& vehicle)
      : front(vehicle.massCentreToFront),
        rear(vehicle.massCentreToRear),
        halfWidth(0.5 * vehicle.width) {}

  [[nodiscard]] Outline grown(double by) const {
    Outline result = *this;
    result.front += by;
    result.rear += by;
    result.halfWidth += by;
    return result;
  }
  /// Enlarged on every side, m.
  [[nodiscard]] PlanRectangle enlarged(double by) const {
    return {.middle = {0.5 * (front - rear), 0.0},
            .half = {0.5 * (front + rear) + by, halfWidth + by}};
  }
  /// From the mass centre to the farthest corner, m.
  [[nodiscard]] double radius() const { return Vector2(std::max(front, rear), halfWidth).norm(); }
  /// Front left, rear left, rear right, front right in the vehicle's frame: counter-clockwise.
  [[nodiscard]] std::array<Vector2, 4> corners() const {
    return {Vector2(front, halfWidth), Vector2(-rear, halfWidth), Vector2(-rear, -halfWidth),
            Vector2(front, -halfWidth)};
  }
  /// Front, rear, left, right.
  [[nodiscard]] std::array<OutlineSide, 4> sides() const {
    return {OutlineSide{{1.0, 0.0}, front, -halfWidth, halfWidth},
            OutlineSide{{-1.0, 0.0}, rear, -halfWidth, halfWidth},
            OutlineSide{{0.0, 1.0}, halfWidth, -front, rear},
            OutlineSide{{0.0, -1.0}, halfWidth, -rear, front}};
  }
};

}  // namespace bumper
