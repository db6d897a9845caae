#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "box_tree.h"
#include "bumper/response/planar_motion.h"
#include "bumper/scenes/walls.h"

namespace bumper {

/// How much higher than its foot, m, a wall must be.
inline constexpr double minRise = 0.05;

/// The walls in reach of a place.
struct Surroundings {
  std::size_t nearestWall = 0;
  Vector2 nearest = Vector2::Zero();
  double squaredDistance = std::numeric_limits<double>::infinity();
  double foot = std::numeric_limits<double>::infinity();  ///< m, of all of them
  double top = -std::numeric_limits<double>::infinity();  ///< m
};

/// Finds walls by a place near them and by height. The time for all searches together is bounded.
class TallWalls {
 public:
  /// The walls must outlive it.
  explicit TallWalls(const std::vector<Wall>& walls);

  /// The walls within footReach of a place that what reaches up to `top`, m, may be the foot of;
  /// nothing if there is none or the searches have taken too long.
  [[nodiscard]] std::optional<Surroundings> around(const Vector2& place, double top);

  [[nodiscard]] const Wall& wall(std::size_t i) const { return walls_[i]; }

  /// Allows searches for so many triangles more.
  void expect(std::size_t triangles) { visits_ += maxVisits * triangles; }

 private:
  const std::vector<Wall>& walls_;
  BoxTree tree_;
  std::size_t visits_ = 0;
};

}  // namespace bumper
