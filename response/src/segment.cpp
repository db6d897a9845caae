#include "bumper/response/segment.h"

#include <algorithm>
#include <cmath>

namespace bumper {

bool isOneWall(const Segment& segment, const Vector2& place, const Vector2& normal) {
  constexpr double thickness = 0.25;  // m
  constexpr double bend = 0.27;       // tan 15°
  constexpr double straight = 0.866;  // cos 30°
  const Vector2 along = segment.end - segment.start;
  const double length2 = along.squaredNorm();
  const double share =
      length2 > 0.0 ? std::clamp((place - segment.start).dot(along) / length2, 0.0, 1.0) : 0.0;
  const Vector2 away = segment.start + share * along - place;
  if (segment.isPost()) return away.norm() <= segment.radius + thickness;
  // An end, or a convex vertex.
  const double highest =
      std::max(normal.dot(segment.start - place), normal.dot(segment.end - place));
  if (away.norm() <= thickness && highest <= 0.2 * thickness) return true;
  return std::abs(normal.dot(segment.normal)) >= straight &&
         std::abs(normal.dot(away)) <= thickness + bend * std::abs(cross(normal, away));
}

Segment carried(const Segment& segment, const Placement& before, const Placement& after) {
  const auto place = [&](const Vector2& point) -> Vector2 {
    return after.position + after.turned(before.local(point));
  };
  Segment result = segment;
  result.start = place(segment.start);
  result.end = place(segment.end);
  result.normal = after.turned(before.turnedBack(segment.normal));
  return result;
}

}  // namespace bumper
