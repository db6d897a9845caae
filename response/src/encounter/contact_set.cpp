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
bool leadsUpFrom(const Manifold& wall, const Overlap& front) {
  const auto height = [&](const Vector2& point) { return front.normal.dot(point) - front.offset; };
  const Overlap& inside = wall.overlap;
  const double lowest = std::min(height(inside.insideFrom), height(inside.insideTo));
  const double highest = std::max(height(wall.segment.start), height(wall.segment.end));
  return lowest >= -behindTolerance && highest > behindTolerance &&
         highest > inLine * (wall.segment.end - wall.segment.start).norm();
}

// From the one to the other, of which it has a share; without its speed.
Approach between(const Approach& one, const Approach& other, double share) {
  const auto mean = [share](const Vector2& a, const Vector2& b) -> Vector2 {
    return a + share * (b - a);
  };
  return {.contact = {.point = mean(one.contact.point, other.contact.point),
                      .arm = mean(one.contact.arm, other.contact.arm)},
          .normal = mean(one.normal, other.normal).normalized()};
}

}  // namespace

std::optional<Vector2> endAt(const Segment& wall, const Vector2& place) {
  const double toStart = (wall.start - place).norm();
  const double toEnd = (wall.end - place).norm();
  if (std::min(toStart, toEnd) > jointWidth) return std::nullopt;
  return toStart < toEnd ? wall.start : wall.end;
}

void ContactSet::begin(std::span<const Segment> segments, std::span<const Surface> surfaces) {
  surfaces_ = surfaces;
  manifolds_.clear();
  time_ = 0.0;
  anyMoves_ = false;
  given_ = merge_.merge(segments, surfaces, vehicle_.body.motion.position);
  for (const Segment& wall : given_) {
    manifolds_.push_back({.segment = wall});
    const Surface& surface = surfaceOf(manifolds_.back());
    manifolds_.back().passed = surface.entered;
    anyMoves_ |= surface.moves;
  }
}

PlanarBody ContactSet::bodyOf(const Manifold& wall) const {
  const Surface& surface = surfaceOf(wall);
  if (!surface.moves) return {};
  return {.motion = advanced(surface.motion, time_)};
}

Segment ContactSet::segmentAt(const Manifold& wall, double time) const {
  const Surface& surface = surfaceOf(wall);
  const Segment& given = givenSegment(wall);
  if (!surface.moves || time == 0.0) return given;
  return carried(given, surface.motion.placement(), advanced(surface.motion, time).placement());
}

int ContactSet::pieceAt(const Manifold& wall, const Vector2& point) const {
  const Surface& surface = surfaceOf(wall);
  if (!surface.moves) return merge_.pieceAt(wall.segment, point);
  const Placement start = surface.motion.placement();
  const Vector2 local = advanced(surface.motion, time_).placement().local(point);
  return merge_.pieceAt(givenSegment(wall), start.position + start.turned(local));
}

void ContactSet::moveWalls() {
  if (!anyMoves_) return;
  for (Manifold& wall : manifolds_) {
    if (surfaceOf(wall).moves) wall.segment = segmentAt(wall, time_);
  }
}

void ContactSet::update(double time) {
  place_ = vehicle_.body.motion.placement();
  time_ = time;
  moveWalls();
  for (Manifold& wall : manifolds_) setOverlap(wall, overlapWith(wall.segment, time));
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
  if (overlap) {
    wall.overlap = *overlap;
  } else {
    wall.answered.yielding = 0.0;
  }
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
  if (wall.isPost()) return touch;
  // A wall that the outline was put into has the normal that the paper gives it; one whose back is
  // solid only if the mass centre is in front.
  const bool mayBeIn = !touch && wall.solid && wall.normal.dot(place_.position - wall.start) > 0.0;
  if (time == 0.0 && (mayBeIn || (touch && touch->depth > slidingDepth))) {
    std::optional<Overlap> face = findOverlap(vehicle_.outline, place_, wall);
    if (touch || (face && face->depth > slidingDepth)) return face;
  }
  if (!touch) return touch;
  if (touch->byEnd && isShielded(*touch)) {
    // The corner of two walls, one of which it touches; or nothing that could be touched.
    std::optional<Overlap> face = findFaceTouch(vehicle_.outline, place_, wall);
    if (face && time > 0.0 && face->depth > slidingDepth) return std::nullopt;
    return face;
  }
  return touch;
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
    if (!isBehind(wall.overlap, other.overlap) || leadsUpFrom(wall, other.overlap)) return false;
    if (!isBehind(other.overlap, wall.overlap)) return true;
    // Each behind the other: a convex corner. The vehicle entered through the one touched last.
    const double own = sinceTouch(wall);
    const double others = sinceTouch(other);
    return own > others || (own == others && &wall > &other);
  });
}

// The vehicle as it moves relative to a wall.
Participant ContactSet::seenFrom(const Manifold& wall) const {
  if (!surfaceOf(wall).moves) return vehicle_;
  Participant seen = vehicle_;
  const PlanarMotion walls = bodyOf(wall).motion;
  seen.body.motion.velocity -= velocityAt(walls, seen.body.motion.position - walls.position);
  seen.body.motion.yawRate -= walls.yawRate;
  return seen;
}

double ContactSet::gapAcceleration(const Manifold& wall) const {
  const Participant seen = seenFrom(wall);
  if (!turns(wall)) return seen.gapAcceleration();
  // A frame that turns sees the mass centre on a curve.
  const PlanarMotion walls = bodyOf(wall).motion;
  const double spin = std::abs(walls.yawRate);
  const double away = (seen.body.motion.position - walls.position).norm();
  return seen.gapAcceleration() + spin * (2.0 * seen.body.motion.velocity.norm() + spin * away);
}

ContactSet::Forecast ContactSet::forecast(const Manifold& wall, double time) const {
  const Surface& surface = surfaceOf(wall);
  if (!surface.moves) return {.segment = wall.segment, .overlap = wall.overlap};
  const Placement before = bodyOf(wall).motion.placement();
  const Placement after = advanced(surface.motion, time).placement();
  Forecast result{.segment = segmentAt(wall, time),
                  .overlap = carried(wall.overlap, before, after)};
  // Its normal points to the side that the vehicle comes from.
  result.segment.solid = true;
  return result;
}

// Of the outline's point, as seen from the wall.
Vector2 ContactSet::relativeVelocity(const Manifold& wall, const ContactPoint& contact) const {
  Vector2 velocity = velocityAt(vehicle_.body.motion, contact.arm);
  if (!surfaceOf(wall).moves) return velocity;
  const PlanarMotion motion = bodyOf(wall).motion;
  return velocity - velocityAt(motion, contact.point - motion.position);
}

double ContactSet::speedOf(const Manifold& wall, const Approach& at) const {
  const PlanarMotion motion = bodyOf(wall).motion;
  return at.normal.dot(velocityAt(motion, at.contact.point - motion.position));
}

Approach ContactSet::approach(const Manifold& wall, const ContactPoint& contact,
                              const Vector2& normal) const {
  return {contact, normal, -relativeVelocity(wall, contact).dot(normal)};
}

Approach ContactSet::touching(const Manifold& wall, const Answer& answered) const {
  const std::span<const ContactPoint> points = wall.points.all();
  const auto approachAt = [&](const ContactPoint& point) {
    if (answered.yielding == 0.0) return approach(wall, point, wall.overlap.normal);
    const Approach at =
        between({.contact = point, .normal = wall.overlap.normal}, answered.at, answered.yielding);
    return approach(wall, at.contact, at.normal);
  };
  Approach best = approachAt(points.front());
  if (best.speed > restTolerance) return best;
  for (const ContactPoint& other : points.subspan(1)) {
    const Approach point = approachAt(other);
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
    return Answer{.at = approach(struck,
                                 contactPoint(outline, place_, struck.segment, touch, penetration),
                                 touch.normal)};
  };
  const Yielding yielding =
      yieldingOf(*this, struck, first.contact.point, first.normal, outline, place_);
  const bool yields = yielding.share > 0.0;
  if (struck.segment.isPost() || (penetration <= 0.0 && !yields)) return alone();
  // Back to where they touched, and on from there for the penetration time.
  double reached = touch.depth - moveTo(touch, place_.position, penetration);
  reached -= yielding.share * std::max(reached - yielding.reach, 0.0);
  Placement pose = place_;
  pose.position += touch.depth * touch.normal + yielding.aside;
  Vector2 onwards = Vector2::Zero();
  if (reached > 0.0) {
    onwards = reached / first.speed * relativeVelocity(struck, first.contact);
  }
  // An impulse makes it slower, and no less engaged.
  const Answer& before = struck.answered;
  if (before.yielding > 0.0) onwards += yielding.share * (before.onwards - onwards);
  pose.position += onwards;
  const EngagedContact engaged = engagedContact(*this, struck, {outline, pose}, yielding.share);
  if (yields && !engaged.meets) {
    return {.at = {.contact = first.contact, .normal = first.normal},
            .yielding = yielding.share,
            .onwards = onwards,
            .meets = false};
  }
  if (!engaged.meets || engaged.share == 0.0) return alone();
  // Walls that go on and turn to the side go over into one wall that ends; at a vertex that is
  // touched none of them is that one.
  const Answer end = alone();
  const Approach whole{.contact = engaged.contact, .normal = engaged.normal};
  Approach at = between(end.at, whole, engaged.share);
  if (touch.byEnd) at.contact = engaged.contact;
  return {.at = approach(struck, at.contact, at.normal),
          .yielding = yielding.share,
          .onwards = onwards};
}

}  // namespace bumper
