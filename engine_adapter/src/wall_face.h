#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "bumper/scenes/walls.h"

namespace bumper {

/// Walls in one plane that together are a convex polygon, no longer than the first of them: the two
/// triangles of a panel, or of panels above one another. Not those beside it: a vehicle that leans
/// touches each piece at its nearest point, and a longer piece has a nearer one elsewhere.
class WallFace {
 public:
  /// Of no wall.
  WallFace() = default;
  explicit WallFace(const Wall& wall);

  /// Adds a wall whose one side is a side of the polygon, if the whole stays in one plane, convex
  /// and no longer, to a nanometre; else changes nothing and returns false.
  bool add(const Wall& wall);

  /// In order around it, at most `mostCorners`.
  [[nodiscard]] std::span<const Eigen::Vector3d> corners() const {
    return {corners_.data(), count_};
  }
  /// Unit; of the first wall.
  [[nodiscard]] const Eigen::Vector3d& normal() const { return normal_; }

  /// The greatest distance between two corners, m.
  [[nodiscard]] double diameter() const;

  static constexpr std::size_t mostCorners = 8;

 private:
  bool addCorner(const Eigen::Vector3d& corner, std::size_t side);

  std::array<Eigen::Vector3d, mostCorners> corners_;
  std::size_t count_ = 0;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_ = Eigen::Vector3d::Zero();  // horizontal, in the plane
  double start_ = 0.0;                               // of the polygon, along that
  double end_ = 0.0;
};

/// A face that leans and is much longer than wide, along a direction that is nearly level: a side
/// of a rail.
struct Strip {
  Eigen::Vector3d direction;  ///< unit
  double width;               ///< m
};

/// Nothing for a face that is steep, as most walls are, or not of that shape.
std::optional<Strip> stripOf(const WallFace& face);

}  // namespace bumper
