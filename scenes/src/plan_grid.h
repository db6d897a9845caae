#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace bumper {

/// A value for each of the square cells of the plan that hold any.
template <typename Value>
class PlanGrid {
 public:
  struct Cell {
    std::int64_t x;
    std::int64_t y;
    bool operator==(const Cell&) const = default;
  };

  /// `size` of a cell, m.
  explicit PlanGrid(double size) : size_(size) {}

  [[nodiscard]] Cell cellOf(double x, double y) const {
    return {static_cast<std::int64_t>(std::floor(x / size_)),
            static_cast<std::int64_t>(std::floor(y / size_))};
  }
  [[nodiscard]] Eigen::Vector2d middleOf(const Cell& cell) const {
    return {size_ * (static_cast<double>(cell.x) + 0.5),
            size_ * (static_cast<double>(cell.y) + 0.5)};
  }
  [[nodiscard]] double size() const { return size_; }

  /// Where the value of a cell is, and whether it is new.
  std::pair<Value&, bool> at(const Cell& cell) {
    const auto [entry, isNew] = values_.try_emplace(cell);
    return {entry->second, isNew};
  }
  /// Null if the cell holds none.
  [[nodiscard]] const Value* find(const Cell& cell) const {
    const auto found = values_.find(cell);
    return found == values_.end() ? nullptr : &found->second;
  }

  /// Calls `visit` with each cell that a box touches, unless they are more than `most`: then it
  /// returns false.
  template <typename Visit>
  bool forCells(const Eigen::AlignedBox3d& box, std::int64_t most, const Visit& visit) const {
    const Cell low = cellOf(box.min().x(), box.min().y());
    const Cell high = cellOf(box.max().x(), box.max().y());
    if (high.x - low.x >= most || high.y - low.y >= most ||
        (high.x - low.x + 1) * (high.y - low.y + 1) > most) {
      return false;
    }
    for (std::int64_t x = low.x; x <= high.x; ++x) {
      for (std::int64_t y = low.y; y <= high.y; ++y) visit(Cell{x, y});
    }
    return true;
  }

 private:
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t value = static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15ULL;
      value = (value ^ value >> 29U ^ static_cast<std::uint64_t>(cell.y)) * 0xBF58476D1CE4E5B9ULL;
      return static_cast<std::size_t>(value ^ value >> 32U);
    }
  };

  double size_;
  std::unordered_map<Cell, Value, Hash> values_;
};

}  // namespace bumper
