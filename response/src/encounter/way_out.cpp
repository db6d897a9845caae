// The way out of walls that an outline was put into: a spawn, a teleport, a gate that closes, or
// what a long force pulse allows.

#include <algorithm>

#include "../engagement.h"
#include "../tolerances.h"
#include "contact_set.h"

namespace bumper {

void ContactSet::findWayOut() {
  if (!standsWithoutWayOut()) return;
  takeWayOut();
  finish();
}

// Whether a solid wall is the side of a body that has another side in the outline, too.
bool ContactSet::isSideOfBody(const Segment& wall) const {
  const auto isIn = [&](const Segment& each) {
    return !interference(vehicle_.outline, place_, each).empty;
  };
  return wall.solid && isIn(wall) &&
         std::any_of(manifolds_.begin(), manifolds_.end(), [&](const Manifold& other) {
           const Segment& side = other.segment;
           return side.solid && side.normal.dot(wall.normal) < -0.5 &&
                  wall.normal.dot(wall.start - side.start) > 0.0 && isIn(side);
         });
}

// How deep the outline stands in a wall, m, on the shortest way out, whichever side is solid.
std::optional<double> ContactSet::depthOfStanding(const Manifold& wall) const {
  if (wall.passed || (wall.touched && wall.overlap.depth <= slidingDepth)) return std::nullopt;
  if (!wall.touched && !isSideOfBody(wall.segment)) return std::nullopt;
  Segment sheet = wall.segment;
  sheet.solid = false;
  const std::optional<Overlap> touch = findTouch(vehicle_.outline, place_, sheet);
  if (!touch || touch->depth <= slidingDepth) return std::nullopt;
  return touch->depth;
}

// Whether the normals of the walls that the outline was put into lead nowhere: they oppose each
// other, or an end is the shorter way out.
bool ContactSet::standsWithoutWayOut() const {
  constexpr double opposing = -0.5;  // cosine
  Vector2 first = Vector2::Zero();
  for (const Manifold& wall : manifolds_) {
    const std::optional<double> depth = depthOfStanding(wall);
    if (!depth || wall.hidden) continue;
    if (!wall.touched) return true;
    if (wall.overlap.depth > *depth + touchTolerance) return true;
    if (first.dot(wall.overlap.normal) < opposing) return true;
    if (first.isZero(0.0)) first = wall.overlap.normal;
  }
  return false;
}

// Not through a wall to whose one side the mass centre is, unless two such walls oppose each other.
Vector2 ContactSet::withoutLeadingThrough(const Vector2& way) const {
  Vector2 kept = way;
  for (const Manifold& wall : manifolds_) {
    if (wall.segment.isPost() || !depthOfStanding(wall)) continue;
    if (depthInside(vehicle_.outline, place_, wall.segment.start) > 0.0) continue;
    if (depthInside(vehicle_.outline, place_, wall.segment.end) > 0.0) continue;
    const Vector2 facing = normalTowards(wall.segment, place_.position);
    kept -= std::min(kept.dot(facing), 0.0) * facing;
  }
  return kept.norm() > 0.1 * way.norm() ? kept : way;
}

// All walls that the outline stands in have one normal, the way out of all of them.
void ContactSet::takeWayOut() {
  constexpr double undecided = 1e-6;
  Vector2 way = Vector2::Zero();
  double most = 0.0;
  for (const Manifold& wall : manifolds_) {
    if (!depthOfStanding(wall)) continue;
    const Vector2 each = wayOut(vehicle_.outline, place_, wall.segment);
    way += each;
    most = std::max(most, each.norm());
  }
  way = withoutLeadingThrough(way);
  const double length = way.norm();
  way = length > undecided * most ? Vector2(way / length) : place_.turned({0.0, 1.0});
  for (Manifold& wall : manifolds_) {
    const std::optional<double> depth = depthOfStanding(wall);
    if (!depth) continue;
    const Interference inside = interference(vehicle_.outline, place_, wall.segment);
    const bool isPoint = wall.segment.isPost() || inside.empty;
    const Vector2 middle = isPoint ? wall.segment.start : inside.middle();
    Overlap overlap{.normal = way, .offset = way.dot(middle)};
    overlap.deepest = turnedLeft(way).dot(middle);
    overlap.start = overlap.end = overlap.deepest;
    overlap.insideFrom = overlap.insideTo = middle;
    overlap.depth = *depth;
    overlap.byEnd = true;
    setOverlap(wall, overlap);
  }
}

}  // namespace bumper
