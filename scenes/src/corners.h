#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace bumper {

/// The corners of a triangle, as numbers that are equal where the points are.
using Corners = std::array<std::uint32_t, 3>;

/// The same for triangles that differ in winding or in where they begin.
inline Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

struct CornersHash {
  std::size_t operator()(const Corners& corners) const {
    std::uint64_t value = 0;
    for (const std::uint32_t corner : corners) {
      value = (value ^ corner) * 0x9E3779B97F4A7C15ULL;
      value ^= value >> 32U;
    }
    return static_cast<std::size_t>(value);
  }
};

}  // namespace bumper
