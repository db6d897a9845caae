#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace bumper {

/// The index of nothing.
inline constexpr std::uint32_t noIndex = std::numeric_limits<std::uint32_t>::max();

/// The corners of a triangle, as numbers that are equal where the points are.
using Corners = std::array<std::uint32_t, 3>;

/// The same for triangles that differ in winding or in where they begin.
inline Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Numbers triangles by their sorted corners; one allocation serves all.
class TriangleTable {
 public:
  /// For at most so many different triangles.
  explicit TriangleTable(std::size_t most) : slots_(std::bit_ceil(2 * most + 1), noIndex) {
    keys_.reserve(most);
  }

  /// Gives a triangle that is not in the table yet the next number, from 0 on; false if it is.
  bool insert(const Corners& corners) {
    std::uint32_t& slot = slots_[slotOf(corners)];
    if (slot != noIndex) return false;
    slot = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(corners);
    return true;
  }

  /// The number of a triangle; `noIndex` if it is not in the table.
  [[nodiscard]] std::uint32_t find(const Corners& corners) const { return slots_[slotOf(corners)]; }

 private:
  /// Where a triangle is, or would be.
  [[nodiscard]] std::size_t slotOf(const Corners& corners) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t corner : corners) {
      hash = (hash ^ corner) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 32U;
    }
    std::size_t slot = static_cast<std::size_t>(hash) & (slots_.size() - 1);
    while (slots_[slot] != noIndex && keys_[slots_[slot]] != corners) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Corners> keys_;
};

}  // namespace bumper
