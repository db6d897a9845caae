#include "bumper/response/touch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "separation.h"
#include "tolerances.h"
#include "wall_axes.h"

namespace bumper {

namespace {

// An interval along a wall's line; empty if low > high.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// The same wall from its other side.
void turnRound(Overlap& line, WallCorners& corners) {
  line.normal = -line.normal;
  line.offset = -line.offset;
  line.start = -std::exchange(line.end, -line.start);
  for (WallCorner& corner : corners) corner = {.along = -corner.along, .depth = -corner.depth};
}

// The deepest point of the outline over the wall.
double deepestOver(const WallCorners& corners, const Overlap& wall) {
  double deepest = std::max(depthAt(corners, wall.start), depthAt(corners, wall.end));
  for (const WallCorner& corner : corners) {
    if (wall.start - touchTolerance <= corner.along && corner.along <= wall.end + touchTolerance) {
      deepest = std::max(deepest, corner.depth);
    }
  }
  return deepest;
}

// Depth, deepest place and line of interference with a face that the outline is known to reach.
void measure(Overlap& face, const WallCorners& corners, const Interference& inside) {
  face.depth = deepestOver(corners, face);
  Interval touch;
  const auto include = [&](double along, double depth) {
    if (depth >= face.depth - touchTolerance) touch.include(along);
  };
  for (const WallCorner& corner : corners) {
    if (corner.along < face.start - touchTolerance) continue;
    if (corner.along > face.end + touchTolerance) continue;
    include(std::clamp(corner.along, face.start, face.end), corner.depth);
  }
  for (const double end : {face.start, face.end}) include(end, depthAt(corners, end));
  face.deepest = touch.middle();
  const Vector2 foot = face.offset * face.normal;
  const Vector2 tangent = turnedLeft(face.normal);
  face.insideFrom = inside.empty ? Vector2(foot + touch.low * tangent) : inside.from;
  face.insideTo = inside.empty ? Vector2(foot + touch.high * tangent) : inside.to;
}

// An end of a wall, or a post, at a point of the outline.
Overlap touchAtPoint(const Vector2& normal, const Vector2& point, double depth) {
  Overlap touch;
  touch.normal = normal;
  touch.offset = normal.dot(point);
  touch.deepest = turnedLeft(normal).dot(point);
  touch.start = touch.end = touch.deepest;
  touch.insideFrom = touch.insideTo = point;
  touch.depth = depth;
  touch.byEnd = true;
  return touch;
}

// An end that has slid into a side which is nearly parallel to the wall, and corners that are
// behind the wall's face: the side lies along the wall.
bool liesAlong(const WallCorners& corners, const Overlap& face, const Vector2& out, double depth) {
  if (depth < freshDepth || depth > slidingDepth) return false;
  if (std::abs(cross(out, face.normal)) > nearlyInLine) return false;
  return std::any_of(corners.begin(), corners.end(), [&](const WallCorner& corner) {
    return face.start <= corner.along && corner.along <= face.end &&
           corner.depth >= -touchTolerance && corner.depth < slidingDepth;
  });
}

std::optional<Overlap> touchPost(const Outline& outline, const Placement& at, const Segment& post) {
  const Vector2 centre = at.local(post.start);
  const Vector2 nearest(std::clamp(centre.x(), -outline.rear, outline.front),
                        std::clamp(centre.y(), -outline.halfWidth, outline.halfWidth));
  const double distance = (nearest - centre).norm();
  if (distance - post.radius > touchTolerance) return std::nullopt;
  Vector2 normal;
  double depth = 0.0;
  if (distance > 0.0) {
    normal = (nearest - centre) / distance;
    depth = post.radius - distance;
  } else {
    const Separation inside = separationFrom(outline, centre, centre);
    normal = -outline.sides()[inside.side].out;
    depth = post.radius - inside.distance;
  }
  normal = at.turned(normal);
  return touchAtPoint(normal, post.start + post.radius * normal, depth);
}

}  // namespace

Vector2 normalTowards(const Segment& wall, const Vector2& position) {
  const bool behind = !wall.solid && (position - wall.start).dot(wall.normal) < 0.0;
  return behind ? Vector2(-wall.normal) : wall.normal;
}

Overlap lineOf(const Segment& wall, const Vector2& position) {
  Overlap line;
  line.normal = normalTowards(wall, position);
  line.offset = line.normal.dot(wall.start);
  const Vector2 tangent = turnedLeft(line.normal);
  std::tie(line.start, line.end) = std::minmax({tangent.dot(wall.start), tangent.dot(wall.end)});
  return line;
}

Overlap carried(const Overlap& overlap, const Placement& before, const Placement& after) {
  const auto place = [&](const Vector2& point) -> Vector2 {
    return after.position + after.turned(before.local(point));
  };
  const Vector2 origin =
      overlap.offset * overlap.normal + overlap.start * turnedLeft(overlap.normal);
  Overlap result = overlap;
  result.normal = after.turned(before.turnedBack(overlap.normal));
  const Vector2 moved = place(origin);
  result.offset = result.normal.dot(moved);
  result.start = turnedLeft(result.normal).dot(moved);
  result.end = result.start + (overlap.end - overlap.start);
  result.deepest = result.start + (overlap.deepest - overlap.start);
  result.insideFrom = place(overlap.insideFrom);
  result.insideTo = place(overlap.insideTo);
  return result;
}

Interference interference(const Outline& outline, const Placement& at, const Segment& wall) {
  const Vector2 start = at.local(wall.start);
  const Vector2 along = at.turnedBack(wall.end - wall.start);
  double from = 0.0;
  double to = 1.0;
  for (const OutlineSide& side : outline.sides()) {
    // Inside where over + share · rate ≤ 0.
    const double over = side.out.dot(start) - side.reach;
    const double rate = side.out.dot(along);
    if (rate == 0.0) {
      if (over > 0.0) return {};
    } else if (rate > 0.0) {
      to = std::min(to, -over / rate);
    } else {
      from = std::max(from, -over / rate);
    }
  }
  if (from > to) return {};
  return {.empty = false,
          .from = wall.start + from * (wall.end - wall.start),
          .to = wall.start + to * (wall.end - wall.start)};
}

std::optional<Overlap> findOverlap(const Outline& outline, const Placement& at,
                                   const Segment& wall) {
  const Interference inside = interference(outline, at, wall);
  if (inside.empty) return std::nullopt;
  Overlap overlap = lineOf(wall, at.position);
  measure(overlap, inWallAxes(outline, at, overlap), inside);
  overlap.depth = std::max(overlap.depth, 0.0);
  return overlap;
}

std::optional<Overlap> findFaceTouch(const Outline& outline, const Placement& at,
                                     const Segment& wall) {
  Overlap face = lineOf(wall, at.position);
  measure(face, inWallAxes(outline, at, face), interference(outline, at, wall));
  if (!(face.depth >= -touchTolerance)) return std::nullopt;
  return face;
}

std::optional<Overlap> findTouch(const Outline& outline, const Placement& at, const Segment& wall) {
  if (wall.isPost()) return touchPost(outline, at, wall);

  const Vector2 start = at.local(wall.start);
  const Vector2 end = at.local(wall.end);
  const Separation outside = separationFrom(outline, start, end);
  if (outside.distance > touchTolerance) return std::nullopt;

  // Which face of the wall the outline is less deep in.
  Overlap face = lineOf(wall, wall.start + wall.normal);
  WallCorners corners = inWallAxes(outline, at, face);
  const auto [highest, lowest] = std::minmax_element(
      corners.begin(), corners.end(),
      [](const WallCorner& a, const WallCorner& b) { return a.depth < b.depth; });
  const double inFront = -lowest->depth;
  const double behind = highest->depth;
  if (std::max(inFront, wall.solid ? inFront : behind) > touchTolerance) return std::nullopt;
  if (!wall.solid && behind > inFront) {
    turnRound(face, corners);
  }
  const double faceDistance = wall.solid ? inFront : std::max(inFront, behind);

  const Interference inside = interference(outline, at, wall);
  if (outside.distance > faceDistance + touchTolerance &&
      !liesAlong(corners, face, at.turned(outline.sides()[outside.side].out), -outside.distance)) {
    // The end that is the deeper in that side, or the middle if both are.
    const OutlineSide side = outline.sides()[outside.side];
    const double atStart = side.out.dot(start) - side.reach;
    const double atEnd = side.out.dot(end) - side.reach;
    Vector2 point = atStart < atEnd ? wall.start : wall.end;
    if (std::abs(atStart - atEnd) <= touchTolerance) {
      point = inside.empty ? Vector2(0.5 * (wall.start + wall.end)) : inside.middle();
    }
    const Vector2 normal = at.turned(-side.out);
    if (wall.solid && normal.dot(wall.normal) < 0.0) return std::nullopt;
    Overlap touch = touchAtPoint(normal, point, -outside.distance);
    if (!inside.empty) {
      touch.insideFrom = inside.from;
      touch.insideTo = inside.to;
    }
    return touch;
  }

  measure(face, corners, inside);
  if (!(face.depth >= -touchTolerance)) return std::nullopt;
  return face;
}

}  // namespace bumper
