#include "engagement.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "separation.h"

namespace bumper {

namespace {

// The distance to a side along a wall: at its start, and its change to the wall's end.
struct Distance {
  double start = 0.0;
  double change = 0.0;

  [[nodiscard]] double at(double share) const { return start + share * change; }
};

}  // namespace

double depthInside(const Outline& outline, const Placement& at, const Vector2& point) {
  const Vector2 local = at.local(point);
  return -separationFrom(outline, local, local).distance;
}

namespace {

// An engagement with the distance to each side in units of its own, and its push with d for ½ d².
struct Engagements {
  Engagement squared;
  Vector2 linear = Vector2::Zero();
};

Engagements engagementIn(const std::array<double, 4>& units, const Outline& outline,
                         const Placement& at, const Segment& wall) {
  Engagements both;
  Engagement& result = both.squared;
  const Vector2 start = at.local(wall.start);
  const Vector2 along = at.turnedBack(wall.end - wall.start);
  const std::array<OutlineSide, 4> sides = outline.sides();
  std::array<Distance, 4> distances;
  double from = 0.0;
  double to = 1.0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Distance toSide{.start = (sides[i].reach - sides[i].out.dot(start)) / units[i],
                          .change = -sides[i].out.dot(along) / units[i]};
    distances[i] = toSide;
    if (toSide.change > 0.0) {
      from = std::max(from, -toSide.start / toSide.change);
    } else if (toSide.change < 0.0) {
      to = std::min(to, -toSide.start / toSide.change);
    } else if (toSide.start < 0.0) {
      return both;
    }
  }
  if (!(from < to)) return both;

  const double length = along.norm();
  result.length = (to - from) * length;
  result.moment = result.length * (wall.start + 0.5 * (from + to) * (wall.end - wall.start));
  // The distance to the nearest side is concave along the wall: sides take turns in order of
  // decreasing change.
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const double mine = distances[i].at(from);
    const double best = distances[nearest].at(from);
    if (mine < best || (mine == best && distances[i].change < distances[nearest].change)) {
      nearest = i;
    }
  }
  Vector2 push = Vector2::Zero();
  Vector2 linear = Vector2::Zero();
  for (double share = from; share < to;) {
    double until = to;
    std::size_t next = nearest;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const double closing = distances[nearest].change - distances[i].change;
      if (closing <= 0.0) continue;
      const double meets =
          std::max((distances[i].start - distances[nearest].start) / closing, share);
      if (meets < until) {
        until = meets;
        next = i;
      }
    }
    const double first = std::max(distances[nearest].at(share), 0.0);
    const double last = std::max(distances[nearest].at(until), 0.0);
    const double part = (until - share) * length;
    push -= 0.5 * part * (first + last) / units[nearest] * sides[nearest].out;
    linear -= part / units[nearest] * sides[nearest].out;
    result.depth = std::max({result.depth, first, last});
    if (next == nearest) break;
    share = until;
    nearest = next;
  }
  result.push = at.turned(push);
  both.linear = at.turned(linear);
  return both;
}

}  // namespace

Engagement engagement(const Outline& outline, const Placement& at, const Segment& wall) {
  return engagementIn({1.0, 1.0, 1.0, 1.0}, outline, at, wall).squared;
}

Vector2 wayOut(const Outline& outline, const Placement& at, const Segment& wall) {
  const std::array<double, 4> reaches = {outline.front, outline.rear, outline.halfWidth,
                                         outline.halfWidth};
  if (!wall.isPost()) return engagementIn(reaches, outline, at, wall).linear;
  // A post counts as its diameter from side to side.
  Segment across = wall;
  across.start = wall.start - wall.radius * at.turned({0.0, 1.0});
  across.end = wall.start + wall.radius * at.turned({0.0, 1.0});
  return engagementIn(reaches, outline, at, across).linear;
}

}  // namespace bumper
