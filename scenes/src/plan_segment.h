#pragma once

#include <algorithm>

#include "bumper/response/planar_motion.h"

namespace bumper {

/// Where on a segment the point nearest to another lies, in plan: 0 at its start, 1 at its end.
inline double nearestShare(const Vector2& from, const Vector2& to, const Vector2& point) {
  const Vector2 along = to - from;
  const double length2 = along.squaredNorm();
  return length2 > 0.0 ? std::clamp((point - from).dot(along) / length2, 0.0, 1.0) : 0.0;
}

/// That point.
inline Vector2 nearestPoint(const Vector2& from, const Vector2& to, const Vector2& point) {
  return from + nearestShare(from, to, point) * (to - from);
}

/// From a point to the nearest of a segment's, in plan, m.
inline double planDistance(const Vector2& from, const Vector2& to, const Vector2& point) {
  return (point - from - nearestShare(from, to, point) * (to - from)).norm();
}

}  // namespace bumper
