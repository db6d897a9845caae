#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "bumper/scenes/walls.h"

namespace bumper {

/// The heights at which a scene has ground, place by place: any number of storeys. Coarse, and
/// never less than there is.
class GroundLevels {
 public:
  /// `maxNormalUp` as in WallSelection; what is steeper is no ground. `distance`, m, sets the size
  /// of the cells.
  GroundLevels(const Scene& scene, double maxNormalUp, double distance);

  [[nodiscard]] bool empty() const { return levels_.empty(); }

  enum class Place { within_reach, overhead, buried, without_ground };

  /// Where a wall lies for vehicles on the ground nearby.
  [[nodiscard]] Place placeOf(const Wall& wall, const GroundReach& reach) const;

 private:
  /// A piece of ground in a cell, as the box around it.
  struct Level {
    float low;
    float high;
    std::uint32_t next;
  };

  struct Cells {
    std::int64_t left, right, near, far;  // the last ones included
    [[nodiscard]] std::int64_t count() const { return (right - left + 1) * (far - near + 1); }
  };

  [[nodiscard]] Cells cellsOf(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const;
  void chooseCellSize(const std::vector<Eigen::Vector2d>& boxes, double wanted);
  void add(std::size_t cell, float low, float high);

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  double cellSize_ = 1.0;
  std::int64_t across_ = 0;
  std::int64_t deep_ = 0;
  std::vector<std::uint32_t> first_;  // by cell: its first level
  std::vector<Level> levels_;
};

}  // namespace bumper
