#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include "bumper/response/planar_motion.h"

namespace bumper {

/// The convex polygon around points in a plane, by those of them that are extreme in one of sixteen
/// directions: what stands out of it does so by less than 2 % of its size.
class Outside {
 public:
  static constexpr std::size_t directions = 16;

  /// The point that is farthest in a direction, and who gave it.
  struct Extreme {
    double distance = -std::numeric_limits<double>::infinity();
    std::size_t owner = 0;
    Vector2 point = Vector2::Zero();
  };

  void include(const Vector2& point, std::size_t owner) {
    for (std::size_t k = 0; k < directions; ++k) {
      const double distance = direction(k).dot(point);
      if (distance > extremes_[k].distance) extremes_[k] = {distance, owner, point};
    }
  }

  [[nodiscard]] std::span<const Extreme> extremes() const { return extremes_; }

  /// Calls with the ends of each side and its unit normal, counter-clockwise. Of points in one line
  /// with one side, and not at all for a single point.
  template <typename Call>
  void forEachSide(const Call& call) const;

  /// Unit, counter-clockwise.
  static const Vector2& direction(std::size_t k) {
    static const auto all = [] {
      std::array<Vector2, directions> result;
      for (std::size_t i = 0; i < result.size(); ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / directions;
        result.at(i) = {std::cos(angle), std::sin(angle)};
      }
      return result;
    }();
    return all[k];
  }

 private:
  std::array<Extreme, directions> extremes_{};
};

template <typename Call>
void Outside::forEachSide(const Call& call) const {
  // In the order of the directions. There and back again is one wall.
  std::array<std::size_t, directions> sides;
  std::size_t count = 0;
  for (std::size_t k = 0; k < directions; ++k) {
    const Vector2 along = extremes_[(k + 1) % directions].point - extremes_[k].point;
    if (along.norm() > 0.0) sides[count++] = k;
  }
  if (count == 2) count = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Extreme& from = extremes_[sides[i]];
    const Extreme& to = extremes_[(sides[i] + 1) % directions];
    const Vector2 along = to.point - from.point;
    call(from, to, Vector2(Vector2(along.y(), -along.x()) / along.norm()));
  }
}

}  // namespace bumper
