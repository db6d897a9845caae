#include "bumper/response/contact_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace bumper {

namespace {

// Points of the outline that lie within this of the deepest one touch the wall together, m: a side
// is flush if its ends differ by less.
constexpr double touchTolerance = 1e-9;

// An interval along a wall's line; empty if low > high.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  [[nodiscard]] bool empty() const { return low > high; }
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void limit(double from, double to) {
    low = std::max(low, from);
    high = std::min(high, to);
  }
};

// The outline in a wall's own axes: along it, and into it.
struct WallCorner {
  double along = 0.0;
  double depth = 0.0;
};
using WallCorners = std::array<WallCorner, 4>;

WallCorners inWallAxes(const Outline& outline, const Vector2& position, double yaw,
                       const Vector2& normal, double offset) {
  const Vector2 tangent = turnedLeft(normal);
  const std::array<Vector2, 4> corners = outline.corners();
  WallCorners result;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2 corner = position + rotated(corners[k], yaw);
    result[k] = {.along = tangent.dot(corner), .depth = offset - normal.dot(corner)};
  }
  return result;
}

// Where the outline's edges cross the line at a depth, from the first to the last crossing.
Interval atDepth(const WallCorners& corners, double depth) {
  Interval inside;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const WallCorner& a = corners[k];
    const WallCorner& b = corners[(k + 1) % corners.size()];
    if (a.depth == depth) inside.include(a.along);
    if ((a.depth < depth) != (b.depth < depth) && a.depth != b.depth) {
      const double share = (depth - a.depth) / (b.depth - a.depth);
      inside.include(a.along + share * (b.along - a.along));
    }
  }
  return inside;
}

// The deepest point of the outline between two places along the wall.
double deepestBetween(const WallCorners& corners, double from, double to) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const WallCorner& a = corners[k];
    const WallCorner& b = corners[(k + 1) % corners.size()];
    if (from <= a.along && a.along <= to) deepest = std::max(deepest, a.depth);
    for (const double place : {from, to}) {
      if ((a.along < place) != (b.along < place)) {
        const double share = (place - a.along) / (b.along - a.along);
        deepest = std::max(deepest, a.depth + share * (b.depth - a.depth));
      }
    }
  }
  return deepest;
}

}  // namespace

std::array<Vector2, 4> Outline::corners() const {
  return {Vector2(front, halfWidth), Vector2(-rear, halfWidth), Vector2(-rear, -halfWidth),
          Vector2(front, -halfWidth)};
}

Overlap lineOf(const WallSegment& wall, const Vector2& position) {
  Overlap line;
  const bool behind = (position - wall.start).dot(wall.normal) < 0.0;
  line.normal = behind ? Vector2(-wall.normal) : wall.normal;
  line.offset = line.normal.dot(wall.start);
  const Vector2 tangent = turnedLeft(line.normal);
  std::tie(line.start, line.end) = std::minmax({tangent.dot(wall.start), tangent.dot(wall.end)});
  return line;
}

std::optional<Overlap> findOverlap(const Outline& outline, const Vector2& position, double yaw,
                                   const WallSegment& wall) {
  Overlap overlap = lineOf(wall, position);
  const WallCorners corners = inWallAxes(outline, position, yaw, overlap.normal, overlap.offset);
  Interval cut = atDepth(corners, 0.0);
  cut.limit(overlap.start, overlap.end);
  if (cut.empty()) return std::nullopt;
  overlap.a = cut.low;
  overlap.b = cut.high;

  overlap.depth = std::max(deepestBetween(corners, overlap.start, overlap.end), 0.0);
  Interval touch = atDepth(corners, overlap.depth - touchTolerance);
  touch.limit(overlap.start, overlap.end);
  overlap.deepest = touch.empty() ? cut.middle() : touch.middle();
  return overlap;
}

double moveTo(const Overlap& overlap, const Vector2& position, double penetration) {
  const double centreDepth = overlap.offset - overlap.normal.dot(position);
  const double most = std::max(overlap.depth - centreDepth, touchTolerance);
  return overlap.depth - std::clamp(penetration, touchTolerance, most);
}

Interference interference(const Outline& outline, const Vector2& position, double yaw,
                          const Overlap& overlap) {
  Interval inside =
      atDepth(inWallAxes(outline, position, yaw, overlap.normal, overlap.offset), 0.0);
  inside.limit(overlap.start, overlap.end);
  if (inside.empty()) return {};
  const Vector2 point =
      inside.middle() * turnedLeft(overlap.normal) + overlap.offset * overlap.normal;
  return {.empty = false,
          .length = inside.high - inside.low,
          .middle = {.point = point, .arm = point - position}};
}

ContactPoint contactPoint(const Outline& outline, const Vector2& position, double yaw,
                          const Overlap& overlap, double penetration) {
  const Vector2 moved = position + moveTo(overlap, position, penetration) * overlap.normal;
  const Interference inside = interference(outline, moved, yaw, overlap);
  if (!inside.empty) return inside.middle;
  const Vector2 point =
      overlap.deepest * turnedLeft(overlap.normal) + overlap.offset * overlap.normal;
  return {.point = point, .arm = point - moved};
}

ContactPoints cornersBehind(const Outline& outline, const Vector2& position, double yaw,
                            const Overlap& overlap) {
  const Vector2 tangent = turnedLeft(overlap.normal);
  ContactPoints found;
  for (const WallCorner& corner :
       inWallAxes(outline, position, yaw, overlap.normal, overlap.offset)) {
    if (corner.depth < 0.0 || corner.along < overlap.start || corner.along > overlap.end) continue;
    const Vector2 onWall = corner.along * tangent + overlap.offset * overlap.normal;
    found.points[found.count++] = {.point = onWall,
                                   .arm = onWall - corner.depth * overlap.normal - position};
  }
  return found;
}

}  // namespace bumper
