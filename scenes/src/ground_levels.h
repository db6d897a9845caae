#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bumper/scenes/walls.h"

namespace bumper {

/// A triangle of a scene that is no wall by its slope.
struct FlatTriangle {
  std::uint32_t triangle;  ///< index into Scene::triangles
  bool wide;               ///< part of a connected surface that is wide enough for a vehicle
};

/// The heights at which a scene has wide ground, place by place: any number of storeys. Coarse, and
/// never less than there is.
class GroundLevels {
 public:
  /// `maxNormalUp` as in WallSelection; what is steeper is no ground. `distance`, m, sets the size
  /// of the cells.
  GroundLevels(const Scene& scene, double maxNormalUp, double distance);

  [[nodiscard]] bool empty() const { return levels_.empty(); }
  [[nodiscard]] const std::vector<FlatTriangle>& flat() const { return flat_; }
  /// The scene's vertices, as numbers that are equal where the points are.
  [[nodiscard]] const std::vector<std::uint32_t>& welded() const { return welded_; }

  /// Where the wide ground nearby is that a wall is out of reach of. `within_reach` in doubt, also
  /// if the searches have taken too long.
  enum class Place { within_reach, above_ground, below_ground, between, without_ground };
  [[nodiscard]] Place placeOf(const Wall& wall, const GroundReach& reach);

  /// How many cells and levels were looked at so far.
  [[nodiscard]] std::size_t visits() const { return visits_; }

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
  std::vector<FlatTriangle> flat_;
  std::vector<std::uint32_t> welded_;
  std::vector<std::uint32_t> first_;  // by cell: its first level
  std::vector<Level> levels_;
  std::size_t visits_ = 0;
  std::size_t mostVisits_ = 0;
};

}  // namespace bumper
