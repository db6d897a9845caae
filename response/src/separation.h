#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "bumper/response/outline.h"

namespace bumper {

/// The side with the largest distance of the points, in the vehicle's frame, beyond it; negative:
/// inside.
struct Separation {
  std::size_t side = 0;
  double distance = -std::numeric_limits<double>::infinity();
};
inline Separation separationFrom(const Outline& outline, const Vector2& a, const Vector2& b) {
  // In the order of Outline::sides().
  const std::array<double, 4> distances = {
      std::min(a.x(), b.x()) - outline.front, -std::max(a.x(), b.x()) - outline.rear,
      std::min(a.y(), b.y()) - outline.halfWidth, -std::max(a.y(), b.y()) - outline.halfWidth};
  const auto* most = std::max_element(distances.begin(), distances.end());
  return {.side = static_cast<std::size_t>(most - distances.begin()), .distance = *most};
}

}  // namespace bumper
