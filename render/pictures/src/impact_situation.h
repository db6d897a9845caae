#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/render/recording.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_INTERNAL bumper {
namespace drawing {

/// A vehicle at an impact, in plan and world axes.
struct Party {
  ImpactEvent event;      ///< as this vehicle sees it
  std::size_t index = 0;  ///< in the recording
  VehicleParameters vehicle;
  Eigen::Vector2d centre;   ///< mass centre
  double yaw = 0.0;         ///< rad
  Eigen::Vector2d forward;  ///< i
  Eigen::Vector2d left;     ///< j
  Eigen::Vector2d before;   ///< velocity, m/s
  Eigen::Vector2d after;
  std::vector<Eigen::Vector2d> corners;  ///< of the outline, to the left around
};

/// What is known of an impact, in plan and world axes.
struct Situation {
  Party vehicle;
  std::optional<Party> other;  ///< if it was recorded
  Eigen::Vector2d contact;
  Eigen::Vector2d normal;   ///< into the vehicle
  Eigen::Vector2d tangent;  ///< z × normal
  Eigen::Vector2d impulse;  ///< on the vehicle, N s
  /// Where a wall enters and leaves the outline; the contact if they only touch, or hit a vehicle.
  Eigen::Vector2d a;
  Eigen::Vector2d b;
  /// Of two vehicles: what of their outlines overlaps when both have gone on for the default
  /// penetration time, carried back by the mean of both motions.
  std::vector<Eigen::Vector2d> overlap;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> walls;  ///< as lines
};

/// Points of the outline and the wall that are nearer together count as one, m.
inline constexpr double touching = 0.005;

/// Throws Error if there is no such impact, or its vehicle was not recorded at its time.
Situation situationOf(const Scene& scene, const Recording& recording, std::size_t impact);

}  // namespace drawing
}  // namespace bumper
