#include "bumper/response/contact_point.h"

#include <algorithm>

#include "separation.h"
#include "wall_axes.h"

namespace bumper {

ContactPoint firstPoint(const Vector2& position, const Overlap& overlap) {
  const Vector2 point =
      overlap.deepest * turnedLeft(overlap.normal) + overlap.offset * overlap.normal;
  return {.point = point, .arm = point - overlap.depth * overlap.normal - position};
}

double moveTo(const Overlap& overlap, const Vector2& position, double penetration) {
  const double centreDepth = overlap.offset - overlap.normal.dot(position);
  const double most = std::max(overlap.depth - centreDepth, 0.0);
  return overlap.depth - std::clamp(penetration, 0.0, most);
}

ContactPoint contactPoint(const Outline& outline, const Placement& at, const Segment& wall,
                          const Overlap& overlap, double penetration) {
  if (wall.isPost()) {
    // The middle of the overlap between the post's foremost point and the outline.
    const Vector2 point =
        overlap.deepest * turnedLeft(overlap.normal) + overlap.offset * overlap.normal;
    const double move = moveTo(overlap, at.position, 0.5 * penetration);
    return {.point = point, .arm = point - at.position - move * overlap.normal};
  }
  Placement moved = at;
  moved.position += moveTo(overlap, at.position, penetration) * overlap.normal;
  const Interference inside = interference(outline, moved, wall);
  // Without penetration rounding decides what is inside.
  const bool touchesOnly = inside.empty || penetration <= 0.0;
  const Vector2 point = touchesOnly ? firstPoint(at.position, overlap).point : inside.middle();
  return {.point = point, .arm = point - moved.position};
}

ContactPoints touchingPoints(const Outline& outline, const Placement& at, const Segment& wall,
                             const Overlap& overlap) {
  ContactPoints found;
  found.add(firstPoint(at.position, overlap));
  if (wall.isPost()) return found;
  if (overlap.byEnd) {
    for (const Vector2& end : {wall.start, wall.end}) {
      const Vector2 local = at.local(end);
      if (separationFrom(outline, local, local).distance <= touchTolerance) {
        found.add({.point = end, .arm = end - at.position});
      }
    }
    return found;
  }
  const Vector2 tangent = turnedLeft(overlap.normal);
  const WallCorners corners = inWallAxes(outline, at, overlap);
  const auto add = [&](double along, double depth) {
    if (depth < -touchTolerance) return;
    const Vector2 onWall = along * tangent + overlap.offset * overlap.normal;
    found.add({.point = onWall, .arm = onWall - depth * overlap.normal - at.position});
  };
  for (const WallCorner& corner : corners) {
    if (corner.along < overlap.start - touchTolerance) continue;
    if (corner.along > overlap.end + touchTolerance) continue;
    add(corner.along, corner.depth);
  }
  for (const double place : {overlap.start, overlap.end}) add(place, depthAt(corners, place));
  return found;
}

}  // namespace bumper
