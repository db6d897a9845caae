#include "bumper/response/collision_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace bumper {

namespace {

// Pieces of one wall meet within this, m, and their normals within this sine.
constexpr double mergeDistance = 1e-3;
constexpr double mergeOffset = 1e-4;
constexpr double mergeSine = 1e-4;

// A contact that approaches more slowly than this, m/s, is at rest to rounding.
constexpr double restTolerance = 1e-9;

// From this many impacts in one step on, none rebounds, so that they come to an end.
constexpr std::size_t plasticAfter = 8;

// A wall's line seen from the vehicle: the side of its normal is the vehicle's.
struct Line {
  Vector2 normal;
  Vector2 tangent;
  double offset;
  double start;
  double end;
};

Line lineOf(const WallSegment& wall, const Vector2& centre) {
  const bool behind = (centre - wall.start).dot(wall.normal) < 0.0;
  const Vector2 normal = behind ? Vector2(-wall.normal) : wall.normal;
  const Vector2 tangent = turnedLeft(normal);
  const auto [start, end] = std::minmax({tangent.dot(wall.start), tangent.dot(wall.end)});
  return {normal, tangent, normal.dot(wall.start), start, end};
}

WallSegment oriented(const WallSegment& wall, const Vector2& centre) {
  WallSegment result = wall;
  const Line line = lineOf(wall, centre);
  result.normal = line.normal;
  if (line.tangent.dot(wall.start) > line.tangent.dot(wall.end)) {
    std::swap(result.start, result.end);
  }
  return result;
}

bool continues(const WallSegment& wall, const WallSegment& piece) {
  if (wall.settings != piece.settings) return false;
  if (std::abs(cross(wall.normal, piece.normal)) > mergeSine) return false;
  if (wall.normal.dot(piece.normal) < 0.0) return false;
  if (std::abs(wall.normal.dot(piece.start - wall.start)) > mergeOffset) return false;
  if (std::abs(wall.normal.dot(piece.end - wall.start)) > mergeOffset) return false;
  const Vector2 tangent = turnedLeft(wall.normal);
  return tangent.dot(piece.start - wall.end) <= mergeDistance &&
         tangent.dot(wall.start - piece.end) <= mergeDistance;
}

// The piece of wall at a place on a merged line, for its number.
int wallAt(std::span<const WallSegment> walls, const Overlap& overlap, const Vector2& point) {
  int nearest = -1;
  double best = std::numeric_limits<double>::infinity();
  for (const WallSegment& wall : walls) {
    if (std::abs(cross(wall.normal, overlap.normal)) > mergeSine) continue;
    const Vector2 along = wall.end - wall.start;
    const double length2 = along.squaredNorm();
    const double share =
        length2 > 0.0 ? std::clamp((point - wall.start).dot(along) / length2, 0.0, 1.0) : 0.0;
    const double distance = (point - wall.start - share * along).squaredNorm();
    if (distance < best || (distance == best && wall.id < nearest)) {
      best = distance;
      nearest = wall.id;
    }
  }
  return nearest;
}

double approachSpeed(const PlanarMotion& motion, const Vector2& arm, const Vector2& normal) {
  return -velocityAt(motion, arm).dot(normal);
}

// A point of the outline and how fast it goes into the wall, m/s.
struct Approach {
  ContactPoint contact;
  double speed = 0.0;
};

Approach approachAt(const Outline& outline, const PlanarMotion& motion, const Overlap& overlap,
                    double penetration) {
  const ContactPoint contact =
      contactPoint(outline, motion.position, motion.yaw, overlap, penetration);
  return {contact, approachSpeed(motion, contact.arm, overlap.normal)};
}

// Of the point of first touch and the corners behind the wall: the first that approaches if it
// does, else the fastest corner.
Approach touchingApproach(const Outline& outline, const PlanarMotion& motion,
                          const Overlap& overlap) {
  Approach best = approachAt(outline, motion, overlap, 0.0);
  if (best.speed > restTolerance) return best;
  const ContactPoints corners = cornersBehind(outline, motion.position, motion.yaw, overlap);
  for (std::size_t k = 0; k < corners.count; ++k) {
    const double speed = approachSpeed(motion, corners.points[k].arm, overlap.normal);
    if (speed > best.speed) best = {corners.points[k], speed};
  }
  return best;
}

// How long ago the wall was touched, s; infinite for one that is not approached.
double sinceTouch(const Outline& outline, const PlanarMotion& motion, const Overlap& overlap) {
  const double speed = touchingApproach(outline, motion, overlap).speed;
  return speed > restTolerance ? overlap.depth / speed : std::numeric_limits<double>::infinity();
}

}  // namespace

CollisionStep::CollisionStep() { impacts_.reserve(maxImpacts); }

void CollisionStep::mergeWalls(std::span<const WallSegment> walls, const Vector2& centre) {
  merged_.clear();
  for (const WallSegment& wall : walls) merged_.push_back(oriented(wall, centre));
  // An order that does not depend on the mesh's; along one line it is the order of the pieces.
  const auto key = [](const WallSegment& wall) {
    const Vector2 tangent = turnedLeft(wall.normal);
    return std::tuple(tangent.dot(wall.start), tangent.dot(wall.end), wall.normal.x(),
                      wall.normal.y(), wall.start.x(), wall.start.y(), wall.id);
  };
  std::sort(merged_.begin(), merged_.end(),
            [&key](const WallSegment& a, const WallSegment& b) { return key(a) < key(b); });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < merged_.size(); ++i) {
    const WallSegment piece = merged_[i];
    const auto end = merged_.begin() + static_cast<std::ptrdiff_t>(kept);
    const auto wall = std::find_if(merged_.begin(), end, [&piece](const WallSegment& candidate) {
      return continues(candidate, piece);
    });
    if (wall == end) {
      merged_[kept++] = piece;
      continue;
    }
    const Vector2 tangent = turnedLeft(wall->normal);
    if (tangent.dot(piece.end) > tangent.dot(wall->end)) wall->end = piece.end;
  }
  merged_.resize(kept);
}

void CollisionStep::findTouched(const Outline& outline, const PlanarMotion& motion) {
  touched_.clear();
  for (const WallSegment& wall : merged_) {
    const std::optional<Overlap> overlap = findOverlap(outline, motion.position, motion.yaw, wall);
    if (overlap) touched_.push_back({.overlap = *overlap, .settings = wall.settings});
  }
}

// What lies behind a wall that the outline is already in cannot be hit: its back, the ends of a
// slab, a second skin.
void CollisionStep::dropHidden(const Outline& outline, const PlanarMotion& motion) {
  constexpr double tolerance = 1e-6;  // m
  const auto behind = [](const Overlap& wall, const Overlap& front) {
    const Vector2 frontTangent = turnedLeft(front.normal);
    const auto hiddenAt = [&](double place) {
      const Vector2 point = place * turnedLeft(wall.normal) + wall.offset * wall.normal;
      const double along = frontTangent.dot(point);
      return front.normal.dot(point) <= front.offset + tolerance &&
             along >= front.start - tolerance && along <= front.end + tolerance;
    };
    return hiddenAt(wall.a) && hiddenAt(wall.b);
  };
  for (Touched& wall : touched_) {
    for (const Touched& other : touched_) {
      if (&wall == &other || !behind(wall.overlap, other.overlap)) continue;
      if (behind(other.overlap, wall.overlap)) {
        // Each behind the other: a convex corner. The vehicle came in over the one touched last.
        const double own = sinceTouch(outline, motion, wall.overlap);
        const double others = sinceTouch(outline, motion, other.overlap);
        if (own < others || (own == others && &wall < &other)) continue;
      }
      wall.hidden = true;
    }
  }
  std::erase_if(touched_, [](const Touched& wall) { return wall.hidden; });
}

// Walls that have not been struck yet come first, the one touched the longest time ago before the
// others; then any contact point of a struck wall that still approaches.
CollisionStep::Next CollisionStep::nextImpact(const Outline& outline, const PlanarMotion& motion) {
  Next next;
  bool nextIsNew = false;
  for (Touched& wall : touched_) {
    const Overlap& overlap = wall.overlap;
    if (wall.settings->method == Method::paper) {
      const Approach middle = approachAt(outline, motion, overlap, overlap.depth);
      if (wall.struck || middle.speed <= restTolerance) continue;
      const double urgency = overlap.depth / middle.speed;
      if (nextIsNew && urgency <= next.urgency) continue;
      next = {.wall = &wall, .contact = middle.contact, .urgency = urgency};
      nextIsNew = true;
      continue;
    }

    const Approach touch = touchingApproach(outline, motion, overlap);
    if (!wall.struck) {
      if (touch.speed <= restTolerance) continue;
      const double urgency = overlap.depth / touch.speed;
      if (nextIsNew && urgency <= next.urgency) continue;
      wall.penetration = touch.speed * wall.settings->penetrationTime;
      const Approach middle = approachAt(outline, motion, overlap, wall.penetration);
      next = {.wall = &wall,
              .contact = middle.speed > restTolerance ? middle.contact : touch.contact,
              .urgency = urgency};
      nextIsNew = true;
    } else if (!nextIsNew) {
      const Approach middle = approachAt(outline, motion, overlap, wall.penetration);
      const Approach& faster = middle.speed > touch.speed ? middle : touch;
      if (faster.speed <= restTolerance || faster.speed <= next.urgency) continue;
      next = {.wall = &wall, .contact = faster.contact, .urgency = faster.speed};
    }
  }
  return next;
}

StepOutcome CollisionStep::resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                                   std::span<const WallSegment> walls) {
  const Outline outline(vehicle);
  impacts_.clear();
  StepOutcome outcome;
  outcome.after = motion;

  mergeWalls(walls, motion.position);
  findTouched(outline, motion);
  dropHidden(outline, motion);

  while (true) {
    const Next next = nextImpact(outline, outcome.after);
    if (next.wall == nullptr) break;
    if (impacts_.size() == maxImpacts) {
      outcome.settled = false;
      break;
    }
    next.wall->struck = true;
    const Overlap& overlap = next.wall->overlap;
    const Impact impact{.wall = wallAt(walls, overlap, next.contact.point),
                        .point = next.contact.point,
                        .normal = overlap.normal,
                        .arm = next.contact.arm,
                        .depth = overlap.depth};
    const double rebound = impacts_.size() < plasticAfter ? 1.0 : 0.0;
    const ImpactResponse response = respond(impact, outcome.after, vehicle.mass, vehicle.yawInertia,
                                            *next.wall->settings, rebound);
    impacts_.push_back({impact, response});
    outcome.impulse.linear += response.impulse.linear;
    outcome.impulse.angular += response.impulse.angular;
    outcome.after = response.after;
    // The paper answers one impact in a step.
    if (next.wall->settings->method == Method::paper) break;
  }
  outcome.impacts = impacts_;
  return outcome;
}

}  // namespace bumper
