#include "bumper/response/contact_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

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

// The outline in a wall's own axes: along it, and into it.
struct WallCorner {
  double along = 0.0;
  double depth = 0.0;
};
using WallCorners = std::array<WallCorner, 4>;

WallCorners inWallAxes(const Outline& outline, const Placement& at, const Overlap& line) {
  const Vector2 tangent = turnedLeft(line.normal);
  const double along = tangent.dot(at.position);
  const double depth = line.offset - line.normal.dot(at.position);
  // How the vehicle's axes lie to the wall.
  const Vector2 forward = at.turned({1.0, 0.0});
  const double cosine = tangent.dot(forward);
  const double sine = line.normal.dot(forward);
  const std::array<Vector2, 4> corners = outline.corners();
  WallCorners result;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2& corner = corners[k];
    result[k] = {.along = along + cosine * corner.x() - sine * corner.y(),
                 .depth = depth - sine * corner.x() - cosine * corner.y()};
  }
  return result;
}

// The same wall from its other side.
void turnRound(Overlap& line, WallCorners& corners) {
  line.normal = -line.normal;
  line.offset = -line.offset;
  line.start = -std::exchange(line.end, -line.start);
  for (WallCorner& corner : corners) corner = {.along = -corner.along, .depth = -corner.depth};
}

// How deep the outline's boundary lies at a place along the wall; −∞ beside the outline.
double depthAt(const WallCorners& corners, double place) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const WallCorner& a = corners[k];
    const WallCorner& b = corners[(k + 1) % corners.size()];
    if ((a.along < place) == (b.along < place)) continue;
    const double share = (place - a.along) / (b.along - a.along);
    deepest = std::max(deepest, a.depth + share * (b.depth - a.depth));
  }
  return deepest;
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

// The outline's four sides: unit normal outwards in the vehicle's frame, and how far out.
struct Side {
  Vector2 out;
  double reach;
};
std::array<Side, 4> sidesOf(const Outline& outline) {
  return {Side{.out = {1.0, 0.0}, .reach = outline.front},
          {.out = {-1.0, 0.0}, .reach = outline.rear},
          {.out = {0.0, 1.0}, .reach = outline.halfWidth},
          {.out = {0.0, -1.0}, .reach = outline.halfWidth}};
}

// The side over which the places, in the vehicle's frame, stand out most; negative: they are
// inside.
struct Separation {
  std::size_t side = 0;
  double distance = -std::numeric_limits<double>::infinity();
};
Separation separationFrom(const Outline& outline, const Vector2& a, const Vector2& b) {
  // In the order of sidesOf().
  const std::array<double, 4> distances = {
      std::min(a.x(), b.x()) - outline.front, -std::max(a.x(), b.x()) - outline.rear,
      std::min(a.y(), b.y()) - outline.halfWidth, -std::max(a.y(), b.y()) - outline.halfWidth};
  const auto* most = std::max_element(distances.begin(), distances.end());
  return {.side = static_cast<std::size_t>(most - distances.begin()), .distance = *most};
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
  constexpr double mostSine = 0.087;   // 5°
  constexpr double mostDepth = 0.05;   // m
  constexpr double leastDepth = 1e-8;  // m: less is a touch
  if (depth < leastDepth || depth > mostDepth || std::abs(cross(out, face.normal)) > mostSine)
    return false;
  return std::any_of(corners.begin(), corners.end(), [&](const WallCorner& corner) {
    return face.start <= corner.along && corner.along <= face.end &&
           corner.depth >= -touchTolerance && corner.depth < mostDepth;
  });
}

std::optional<Overlap> touchPost(const Outline& outline, const Placement& at,
                                 const WallSegment& post) {
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
    normal = -sidesOf(outline)[inside.side].out;
    depth = post.radius - inside.distance;
  }
  normal = at.turned(normal);
  return touchAtPoint(normal, post.start + post.radius * normal, depth);
}

}  // namespace

double Outline::radius() const { return Vector2(std::max(front, rear), halfWidth).norm(); }

std::array<Vector2, 4> Outline::corners() const {
  return {Vector2(front, halfWidth), Vector2(-rear, halfWidth), Vector2(-rear, -halfWidth),
          Vector2(front, -halfWidth)};
}

Vector2 normalTowards(const WallSegment& wall, const Vector2& position) {
  const bool behind = !wall.solid && (position - wall.start).dot(wall.normal) < 0.0;
  return behind ? Vector2(-wall.normal) : wall.normal;
}

Overlap lineOf(const WallSegment& wall, const Vector2& position) {
  Overlap line;
  line.normal = normalTowards(wall, position);
  line.offset = line.normal.dot(wall.start);
  const Vector2 tangent = turnedLeft(line.normal);
  std::tie(line.start, line.end) = std::minmax({tangent.dot(wall.start), tangent.dot(wall.end)});
  return line;
}

Interference interference(const Outline& outline, const Placement& at, const WallSegment& wall) {
  const Vector2 start = at.local(wall.start);
  const Vector2 along = at.turnedBack(wall.end - wall.start);
  double from = 0.0;
  double to = 1.0;
  for (const Side& side : sidesOf(outline)) {
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
                                   const WallSegment& wall) {
  const Interference inside = interference(outline, at, wall);
  if (inside.empty) return std::nullopt;
  Overlap overlap = lineOf(wall, at.position);
  measure(overlap, inWallAxes(outline, at, overlap), inside);
  overlap.depth = std::max(overlap.depth, 0.0);
  return overlap;
}

std::optional<Overlap> findTouch(const Outline& outline, const Placement& at,
                                 const WallSegment& wall) {
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
      !liesAlong(corners, face, at.turned(sidesOf(outline)[outside.side].out), -outside.distance)) {
    // The end that is the deeper in that side, or the middle if both are.
    const Side side = sidesOf(outline)[outside.side];
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

ContactPoint contactPoint(const Outline& outline, const Placement& at, const WallSegment& wall,
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

ContactPoints touchingPoints(const Outline& outline, const Placement& at, const WallSegment& wall,
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
