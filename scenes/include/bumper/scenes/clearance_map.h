#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bumper/scenes/walls.h"

namespace bumper {

/// How far the nearest wall is at least, from any place and at once: a grid over the walls' extents
/// in the horizontal plane. Heights do not count, so that under a bridge its rails are near.
class ClearanceMap {
 public:
  /// Of no walls.
  ClearanceMap() = default;

  /// Takes one byte of memory for each cell: at most about max(65,536, 32 × walls) of them, no
  /// smaller than 1 m.
  explicit ClearanceMap(const std::vector<Wall>& walls);

  /// A horizontal distance, m, within which of a point of the world there is certainly no wall: the
  /// true distance less at most 1.6 cells, up to 5 cells; at least 0.7 of it less 2 cells further away, up
  /// to 31 cells; 0 for a point that is not finite. Infinite without walls.
  [[nodiscard]] double atLeast(double x, double y) const;

  [[nodiscard]] double cellSize() const { return cell_; }  ///< m
  [[nodiscard]] std::size_t cellCount() const { return distances_.size(); }

 private:
  void keepDistances(const Wall& wall, std::vector<std::uint8_t>& away);

  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  double cell_ = 0.0;
  double lowX_ = 0.0;
  double lowY_ = 0.0;
  double highX_ = 0.0;
  double highY_ = 0.0;
  // From the middle of each cell, in parts of a cell.
  std::vector<std::uint8_t> distances_;
};

}  // namespace bumper
