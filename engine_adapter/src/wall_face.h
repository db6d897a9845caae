#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "bumper/scenes/walls.h"

namespace bumper {

/// Walls in one plane that together are a convex polygon: a panel's two triangles, or a stretch of
/// a straight wall.
class WallFace {
 public:
  /// Of no wall.
  WallFace() = default;
  explicit WallFace(const Wall& wall);

  /// Adds a wall whose one side is a side of the polygon, if the whole stays in one plane and
  /// convex, to a nanometre; else changes nothing and returns false.
  bool add(const Wall& wall);

  /// In order around it, at most `mostCorners`.
  [[nodiscard]] std::span<const Eigen::Vector3d> corners() const {
    return {corners_.data(), count_};
  }
  /// Unit; of the first wall.
  [[nodiscard]] const Eigen::Vector3d& normal() const { return normal_; }

  static constexpr std::size_t mostCorners = 8;

 private:
  bool addCorner(const Eigen::Vector3d& corner, std::size_t side);

  std::array<Eigen::Vector3d, mostCorners> corners_;
  std::size_t count_ = 0;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
};

}  // namespace bumper
