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

  /// Cells are 1.25 m wide, or more where that would be over four million; those that are 7 cells
  /// and more from every wall take next to no memory.
  explicit ClearanceMap(const std::vector<Wall>& walls);

  /// A horizontal distance, m, within which of a point of the world there is certainly no wall: the
  /// true distance less at most 1.6 cells, up to 4 cells; further away 0.7 of it less 2 cells or 6
  /// cells, whichever is less, and usually more; 0 for a point that is not finite. Infinite without
  /// walls.
  [[nodiscard]] double atLeast(double x, double y) const;

  [[nodiscard]] double cellSize() const { return cell_; }  ///< m
  [[nodiscard]] std::size_t memory() const {               ///< bytes
    return distances_.capacity() + tiles_.capacity() * sizeof(std::int32_t);
  }

 private:
  void findDistances(const Wall& wall, std::vector<std::uint8_t>& distances,
                     std::vector<std::uint8_t>& away) const;
  void keep(const std::vector<std::uint8_t>& distances);
  /// From the middle of a cell to the nearest wall at least, in cells.
  [[nodiscard]] double fromMiddle(std::size_t row, std::size_t column) const;

  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  double cell_ = 0.0;
  double lowX_ = 0.0;
  double lowY_ = 0.0;
  double highX_ = 0.0;
  double highY_ = 0.0;
  // Distances from the middles of cells, in parts of a cell, tile by tile; and for each tile where
  // it begins, or −1 times one distance for all of it.
  std::vector<std::uint8_t> distances_;
  std::vector<std::int32_t> tiles_;
  std::size_t tileColumns_ = 0;
};

}  // namespace bumper
