#pragma once

#include <array>
#include <cstddef>

#include "bumper/response/outline.h"

namespace bumper {

/// One side of an outline in the plane: n · p ≤ offset inside.
struct FaceLine {
  Vector2 normal = Vector2::Zero();  ///< unit, outwards
  double offset = 0.0;               ///< m
};

/// Front, rear, left, right of an outline at a pose.
std::array<FaceLine, 4> faceLines(const Outline& outline, const Placement& at);

/// A convex polygon, counter-clockwise: the overlap of two rectangles and its parts.
class ConvexPolygon {
 public:
  /// The outline at a pose.
  ConvexPolygon(const Outline& outline, const Placement& at);

  /// Keeps the part with normal · p ≤ offset; the normal need not be of unit length.
  void clip(const Vector2& normal, double offset);
  [[nodiscard]] bool isEmpty() const { return count_ < 3; }

  /// Its area, m², and the integral of the place over it, m³; relative to `origin`.
  struct Moments {
    double area = 0.0;
    Vector2 first = Vector2::Zero();
  };
  [[nodiscard]] Moments moments(const Vector2& origin) const;

  /// Its corners that lie least and farthest along a direction.
  [[nodiscard]] std::array<Vector2, 2> endsAlong(const Vector2& direction) const;

  [[nodiscard]] const Vector2& front() const { return corners_.front(); }

 private:
  // Four corners, one more for each line that clips it: by the four sides of another rectangle and
  // three bisectors.
  static constexpr std::size_t mostCorners = 12;

  std::array<Vector2, mostCorners> corners_;
  std::size_t count_ = 0;
};

}  // namespace bumper
