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

// The part of a wall inside an outline, as shares of its length; empty unless from < to.
struct Inside {
  double from = 0.0;
  double to = 1.0;
};

// Calls with each stretch of a wall inside, over which one side is the nearest: the side, the
// stretch as shares of the wall's length, and the distance at both of its ends. Distances to each
// side are in units of its own.
template <typename Call>
Inside forEachStretch(const std::array<double, 4>& units, const Outline& outline,
                      const Placement& at, const Segment& wall, const Call& call) {
  Inside inside;
  auto& [from, to] = inside;
  const Vector2 start = at.local(wall.start);
  const Vector2 along = at.turnedBack(wall.end - wall.start);
  const std::array<OutlineSide, 4> sides = outline.sides();
  std::array<Distance, 4> distances;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Distance toSide{.start = (sides[i].reach - sides[i].out.dot(start)) / units[i],
                          .change = -sides[i].out.dot(along) / units[i]};
    distances[i] = toSide;
    if (toSide.change > 0.0) {
      from = std::max(from, -toSide.start / toSide.change);
    } else if (toSide.change < 0.0) {
      to = std::min(to, -toSide.start / toSide.change);
    } else if (toSide.start < 0.0) {
      return {.from = 1.0, .to = 0.0};
    }
  }
  if (!(from < to)) return inside;

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
    call(nearest, until - share, std::max(distances[nearest].at(share), 0.0),
         std::max(distances[nearest].at(until), 0.0));
    if (next == nearest) break;
    share = until;
    nearest = next;
  }
  return inside;
}

}  // namespace

double depthInside(const Outline& outline, const Placement& at, const Vector2& point) {
  const Vector2 local = at.local(point);
  return -separationFrom(outline, local, local).distance;
}

Engagement engagement(const Outline& outline, const Placement& at, const Segment& wall) {
  Engagement result;
  const std::array<OutlineSide, 4> sides = outline.sides();
  const double length = at.turnedBack(wall.end - wall.start).norm();
  Vector2 push = Vector2::Zero();
  const Inside inside =
      forEachStretch({1.0, 1.0, 1.0, 1.0}, outline, at, wall,
                     [&](std::size_t side, double share, double first, double last) {
                       push -= 0.5 * (share * length) * (first + last) * sides[side].out;
                       result.depth = std::max({result.depth, first, last});
                     });
  if (!(inside.from < inside.to)) return result;
  result.length = (inside.to - inside.from) * length;
  result.moment =
      result.length * (wall.start + 0.5 * (inside.from + inside.to) * (wall.end - wall.start));
  result.push = at.turned(push);
  return result;
}

Vector2 wayOut(const Outline& outline, const Placement& at, const Segment& wall) {
  Segment sheet = wall;
  if (wall.isPost()) {
    // It counts as its diameter from side to side.
    sheet.start = wall.start - wall.radius * at.turned({0.0, 1.0});
    sheet.end = wall.start + wall.radius * at.turned({0.0, 1.0});
  }
  const std::array<OutlineSide, 4> sides = outline.sides();
  const std::array<double, 4> reaches = {outline.front, outline.rear, outline.halfWidth,
                                         outline.halfWidth};
  const double length = at.turnedBack(sheet.end - sheet.start).norm();
  Vector2 push = Vector2::Zero();
  forEachStretch(reaches, outline, at, sheet,
                 [&](std::size_t side, double share, double /*first*/, double /*last*/) {
                   push -= share * length / reaches[side] * sides[side].out;
                 });
  return at.turned(push);
}

}  // namespace bumper
