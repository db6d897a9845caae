#pragma once

#include <algorithm>

#include "bumper/response/planar_motion.h"

namespace bumper {

/// From a point to the nearest of a segment's, in plan, m.
inline double planDistance(const Vector2& from, const Vector2& to, const Vector2& point) {
  const Vector2 along = to - from;
  const double length2 = along.squaredNorm();
  const double share =
      length2 > 0.0 ? std::clamp((point - from).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - from - share * along).norm();
}

}  // namespace bumper
