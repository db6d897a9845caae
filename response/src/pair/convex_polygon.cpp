#include "convex_polygon.h"

#include <algorithm>
#include <span>

namespace bumper {

std::array<FaceLine, 4> faceLines(const Outline& outline, const Placement& at) {
  const std::array<OutlineSide, 4> sides = outline.sides();
  std::array<FaceLine, 4> lines;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Vector2 normal = at.turned(sides[i].out);
    lines[i] = {.normal = normal, .offset = normal.dot(at.position) + sides[i].reach};
  }
  return lines;
}

ConvexPolygon::ConvexPolygon(const Outline& outline, const Placement& at) : count_(4) {
  const std::array<Vector2, 4> corners = outline.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners_[i] = at.position + at.turned(corners[i]);
  }
}

void ConvexPolygon::clip(const Vector2& normal, double offset) {
  std::array<Vector2, mostCorners> kept;
  std::size_t count = 0;
  const auto heightOf = [&](const Vector2& corner) { return normal.dot(corner) - offset; };
  for (std::size_t i = 0; i < count_; ++i) {
    const Vector2& from = corners_[i];
    const Vector2& to = corners_[i + 1 < count_ ? i + 1 : 0];
    const double height = heightOf(from);
    const double nextHeight = heightOf(to);
    if (height <= 0.0 && count < mostCorners) kept[count++] = from;
    if (((height < 0.0 && nextHeight > 0.0) || (height > 0.0 && nextHeight < 0.0)) &&
        count < mostCorners) {
      kept[count++] = from + height / (height - nextHeight) * (to - from);
    }
  }
  corners_ = kept;
  count_ = count;
}

ConvexPolygon::Moments ConvexPolygon::moments(const Vector2& origin) const {
  Moments result;
  if (isEmpty()) return result;
  const Vector2 first = corners_[0] - origin;
  for (std::size_t i = 1; i + 1 < count_; ++i) {
    const Vector2 a = corners_[i] - origin;
    const Vector2 b = corners_[i + 1] - origin;
    const double area = 0.5 * cross(a - first, b - first);
    result.area += area;
    result.first += area / 3.0 * (first + a + b);
  }
  return result;
}

std::array<Vector2, 2> ConvexPolygon::endsAlong(const Vector2& direction) const {
  const auto isLess = [&](const Vector2& a, const Vector2& b) {
    return direction.dot(a) < direction.dot(b);
  };
  const std::span<const Vector2> corners(corners_.data(), count_);
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end(), isLess);
  return {*low, *high};
}

}  // namespace bumper
