#include "contact_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../engagement.h"
#include "../tolerances.h"
#include "bumper/response/sweep.h"
#include "engaged_contact.h"
#include "small_feature.h"

namespace bumper {

namespace {

constexpr double behindTolerance = 1e-6;  // m

// Whether what is inside the outline of one wall lies behind the face of another.
bool isBehind(const Overlap& wall, const Overlap& front) {
  if (front.byEnd) return false;
  const Vector2 tangent = turnedLeft(front.normal);
  const auto hiddenAt = [&](const Vector2& point) {
    const double along = tangent.dot(point);
    return front.normal.dot(point) <= front.offset + behindTolerance &&
           along >= front.start - behindTolerance && along <= front.end + behindTolerance;
  };
  return hiddenAt(wall.insideFrom) && hiddenAt(wall.insideTo);
}

// Whether what is inside the outline of one wall lies on the face of another, from where it rises:
// the second wall of an inside corner that is just reached.
bool risesFrom(const Manifold& wall, const Overlap& front) {
  const auto height = [&](const Vector2& point) { return front.normal.dot(point) - front.offset; };
  const Overlap& inside = wall.overlap;
  const double lowest = std::min(height(inside.insideFrom), height(inside.insideTo));
  const double highest = std::max(height(wall.segment.start), height(wall.segment.end));
  return lowest >= -behindTolerance && highest > behindTolerance &&
         highest > inLine * (wall.segment.end - wall.segment.start).norm();
}

}  // namespace

void ContactSet::begin(std::span<const Segment> segments, std::span<const Surface> surfaces) {
  surfaces_ = surfaces;
  manifolds_.clear();
  for (const Segment& wall : merge_.merge(segments, surfaces, vehicle_.body.motion.position)) {
    manifolds_.push_back({.segment = wall});
    manifolds_.back().passed = surfaceOf(manifolds_.back()).entered;
  }
}

void ContactSet::update(double time) {
  place_ = vehicle_.body.motion.placement();
  for (Manifold& wall : manifolds_) setOverlap(wall, overlapWith(wall.segment, time));
  finish();
}

void ContactSet::findWayOut() {
  if (!standsWithoutWayOut()) return;
  takeWayOut();
  finish();
}

void ContactSet::updateByFaces() {
  place_ = vehicle_.body.motion.placement();
  for (Manifold& wall : manifolds_) {
    setOverlap(wall, findOverlap(vehicle_.outline, place_, wall.segment));
  }
  finish();
}

void ContactSet::setOverlap(Manifold& wall, const std::optional<Overlap>& overlap) {
  wall.touched = overlap.has_value();
  wall.hidden = false;
  wall.struck = false;
  if (overlap) wall.overlap = *overlap;
}

void ContactSet::finish() {
  for (Manifold& wall : manifolds_) {
    if (!wall.touched) continue;
    wall.points = touchingPoints(vehicle_.outline, place_, wall.segment, wall.overlap);
  }
  // A wall hides others even if it is hidden itself.
  for (Manifold& wall : manifolds_) {
    wall.hidden = wall.touched && !wall.passed && isHidden(wall);
  }
}

std::optional<Overlap> ContactSet::overlapWith(const Segment& wall, double time) const {
  std::optional<Overlap> touch = findTouch(vehicle_.outline, place_, wall);
  if (!touch || wall.isPost()) return touch;
  // A wall that the outline was put into has the normal that the paper gives it.
  if (time == 0.0 && touch->depth > slidingDepth) {
    return findOverlap(vehicle_.outline, place_, wall);
  }
  if (touch->byEnd && isShielded(*touch)) {
    // The corner of two walls, one of which it touches; or nothing that could be touched.
    std::optional<Overlap> face = findFaceTouch(vehicle_.outline, place_, wall);
    if (face && time > 0.0 && face->depth > slidingDepth) return std::nullopt;
    return face;
  }
  return touch;
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
  if (wall.passed || !(wall.touched || isSideOfBody(wall.segment))) return std::nullopt;
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
  Vector2 way = Vector2::Zero();
  for (const Manifold& wall : manifolds_) {
    if (depthOfStanding(wall)) way += wayOut(vehicle_.outline, place_, wall.segment);
  }
  way = withoutLeadingThrough(way);
  const double length = way.norm();
  way = length > 0.0 ? Vector2(way / length) : place_.turned({-1.0, 0.0});
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

// An end from which another wall continues into the outline cannot be hit.
bool ContactSet::isShielded(const Overlap& end) const {
  const Vector2 place = end.deepest * turnedLeft(end.normal) + end.offset * end.normal;
  return std::any_of(manifolds_.begin(), manifolds_.end(), [&](const Manifold& wall) {
    if (surfaceOf(wall).entered) return false;
    const auto leadsIn = [&](const Vector2& from, const Vector2& to) {
      const double distance = (from - place).norm();
      return distance <= jointWidth && distance < (to - place).norm() &&
             end.normal.dot(to - from) > inLine * (to - from).norm();
    };
    return leadsIn(wall.segment.start, wall.segment.end) ||
           leadsIn(wall.segment.end, wall.segment.start);
  });
}

// What lies behind a wall that the outline is already in cannot be hit: its back, the ends of a
// slab, a second skin.
bool ContactSet::isHidden(const Manifold& wall) const {
  return std::any_of(manifolds_.begin(), manifolds_.end(), [&](const Manifold& other) {
    if (&wall == &other || !other.touched || other.passed) return false;
    if (!isBehind(wall.overlap, other.overlap) || risesFrom(wall, other.overlap)) return false;
    if (!isBehind(other.overlap, wall.overlap)) return true;
    // Each behind the other: a convex corner. The vehicle entered through the one touched last.
    const double own = sinceTouch(wall);
    const double others = sinceTouch(other);
    return own > others || (own == others && &wall > &other);
  });
}

Approach ContactSet::approach(const ContactPoint& contact, const Vector2& normal) const {
  return {contact, normal, -velocityAt(vehicle_.body.motion, contact.arm).dot(normal)};
}

Approach ContactSet::touching(const Manifold& wall) const {
  const std::span<const ContactPoint> points = wall.points.all();
  Approach best = approach(points.front(), wall.overlap.normal);
  if (best.speed > restTolerance) return best;
  for (const ContactPoint& other : points.subspan(1)) {
    const Approach point = approach(other, wall.overlap.normal);
    if (point.speed > best.speed) best = point;
  }
  return best;
}

double ContactSet::sinceTouch(const Manifold& wall, double speed) {
  return std::max(wall.overlap.depth - touchTolerance, 0.0) / speed;
}

// Infinite for a wall that is not approached.
double ContactSet::sinceTouch(const Manifold& wall) const {
  const double speed = touching(wall).speed;
  return speed > restTolerance ? sinceTouch(wall, speed) : std::numeric_limits<double>::infinity();
}

Answer ContactSet::answerTo(const Manifold& struck, const Approach& first) const {
  const Overlap& touch = struck.overlap;
  const double penetration = first.speed * settingsOf(struck).penetrationTime;
  const Outline& outline = vehicle_.outline;
  const auto alone = [&] {
    return Answer{.at = approach(contactPoint(outline, place_, struck.segment, touch, penetration),
                                 touch.normal)};
  };
  const Yielding yielding =
      yieldingOf(*this, struck, first.contact.point, first.normal, outline, place_);
  const bool yields = yielding.share > 0.0;
  if (struck.segment.isPost() || (penetration <= 0.0 && !yields)) return alone();
  // Back to where they touched, and on from there for the penetration time.
  double reached = touch.depth - moveTo(touch, place_.position, penetration);
  if (yields) reached = std::min(reached, yielding.reach);
  Placement pose = place_;
  pose.position += touch.depth * touch.normal + yielding.aside;
  if (reached > 0.0) {
    pose.position += reached / first.speed * velocityAt(vehicle_.body.motion, first.contact.arm);
  }
  const EngagedContact engaged = engagedContact(*this, struck, {outline, pose}, yielding.share);
  if (yields && !engaged.meets) {
    return {
        .at = {.contact = first.contact, .normal = first.normal}, .yields = true, .meets = false};
  }
  if (!engaged.meets || engaged.share == 0.0) return alone();
  // Walls that go on and turn to the side go over into one wall that ends; at a vertex that is
  // touched none of them is that one.
  const Answer end = alone();
  const auto between = [&](const Vector2& one, const Vector2& other) -> Vector2 {
    return one + engaged.share * (other - one);
  };
  ContactPoint contact = engaged.contact;
  if (!touch.byEnd) {
    contact = {.point = between(end.at.contact.point, contact.point),
               .arm = between(end.at.contact.arm, contact.arm)};
  }
  const Vector2 normal = between(end.at.normal, engaged.normal).normalized();
  return {.at = approach(contact, normal), .yields = yields};
}

}  // namespace bumper
