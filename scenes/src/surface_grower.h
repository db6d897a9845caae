#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bumper/scenes/walls.h"
#include "corners.h"

namespace bumper {

/// Horizontal direction in which a wall faces, unit; a flat triangle, which a selection can let
/// pass, faces along x.
Eigen::Vector2d facing(const Wall& wall);

/// Which walls meet at a corner.
class WallsAtCorners {
 public:
  explicit WallsAtCorners(const std::vector<Corners>& corners);

  [[nodiscard]] std::size_t corners() const { return begins_.size() - 1; }

  [[nodiscard]] std::span<const std::uint32_t> wallsAt(std::uint32_t corner) const {
    return {walls_.data() + begins_[corner], walls_.data() + begins_[corner + 1]};
  }

 private:
  std::vector<std::uint32_t> begins_;
  std::vector<std::uint32_t> walls_;
};

/// Region growing: takes surfaces, walls that are connected at corners and face nearly the same
/// way.
class SurfaceGrower {
 public:
  /// Both must outlive it. `corners` names the corners of each wall by numbers that are equal where
  /// the points are.
  SurfaceGrower(const std::vector<Wall>& walls, const std::vector<Corners>& corners);

  [[nodiscard]] bool isTaken(std::uint32_t wall) const { return taken_[wall]; }

  /// The walls not yet taken that are connected to `seed` and face as it does, or the opposite
  /// way.
  std::vector<std::uint32_t> take(std::uint32_t seed);

 private:
  const std::vector<Wall>& walls_;
  const std::vector<Corners>& corners_;
  WallsAtCorners table_;
  std::vector<bool> taken_;
  std::vector<std::uint32_t> visitedFrom_;  ///< by corner: the seed of the last surface to pass
};

}  // namespace bumper
