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

// Walls whose normals differ by less than this sine, 5°, and whose ends meet are hit as one.
constexpr double chainSine = 0.087;

// A contact that approaches more slowly than this, m/s, is at rest to rounding.
constexpr double restTolerance = 1e-9;

// From this many impacts in one step on, none rebounds, so that they come to an end.
constexpr std::size_t plasticAfter = 8;

WallSegment oriented(const WallSegment& wall, const Vector2& centre) {
  WallSegment result = wall;
  result.normal = lineOf(wall, centre).normal;
  const Vector2 tangent = turnedLeft(result.normal);
  if (tangent.dot(wall.start) > tangent.dot(wall.end)) std::swap(result.start, result.end);
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

void CollisionStep::findTouched() {
  walls_.clear();
  for (const WallSegment& merged : merged_) {
    Wall wall{.overlap = lineOf(merged, motion_.position),
              .settings = merged.settings,
              .startPoint = merged.start,
              .endPoint = merged.end,
              .contact = {}};
    const std::optional<Overlap> overlap =
        findOverlap(outline_, motion_.position, motion_.yaw, merged);
    if (overlap) {
      wall.overlap = *overlap;
      wall.touched = true;
    }
    walls_.push_back(wall);
  }
}

CollisionStep::Approach CollisionStep::approach(const ContactPoint& contact,
                                                const Vector2& normal) const {
  return {contact, normal, -velocityAt(motion_, contact.arm).dot(normal)};
}

// Of the point of first touch and the corners behind the wall: the first if it approaches, else the
// fastest corner.
CollisionStep::Approach CollisionStep::touching(const Wall& wall) const {
  const Overlap& overlap = wall.overlap;
  Approach best =
      approach(contactPoint(outline_, motion_.position, motion_.yaw, overlap, 0.0), overlap.normal);
  if (best.speed > restTolerance) return best;
  const ContactPoints corners = cornersBehind(outline_, motion_.position, motion_.yaw, overlap);
  for (std::size_t k = 0; k < corners.count; ++k) {
    const Approach corner = approach(corners.points[k], overlap.normal);
    if (corner.speed > best.speed) best = corner;
  }
  return best;
}

// How long ago the wall was touched, s; infinite for one that is not approached.
double CollisionStep::sinceTouch(const Wall& wall) const {
  const double speed = touching(wall).speed;
  return speed > restTolerance ? wall.overlap.depth / speed
                               : std::numeric_limits<double>::infinity();
}

// The middle of the line of interference with a wall and the walls that go on from its ends with a
// slight bend, each counting by its length and the less the more it is bent. A wall that is not
// quite flat is hit like a flat one.
CollisionStep::Approach CollisionStep::middleOfChain(const Wall& struck, double penetration) const {
  const Overlap& first = struck.overlap;
  const Vector2 moved =
      motion_.position + moveTo(first, motion_.position, penetration) * first.normal;
  ContactPoint sum{.point = Vector2::Zero(), .arm = Vector2::Zero()};
  Vector2 normal = Vector2::Zero();
  double total = 0.0;
  const auto include = [&](const Wall& wall) {
    const Interference inside = interference(outline_, moved, motion_.yaw, wall.overlap);
    const double bend = std::abs(cross(first.normal, wall.overlap.normal));
    const double weight = inside.length * std::max(0.0, 1.0 - bend / chainSine);
    if (inside.empty || weight == 0.0) return;
    sum.point += weight * inside.middle.point;
    sum.arm += weight * inside.middle.arm;
    normal += weight * wall.overlap.normal;
    total += weight;
  };
  include(struck);
  for (const bool forward : {true, false}) {
    const Wall* last = &struck;
    for (std::size_t length = 1; length < walls_.size(); ++length) {
      const Vector2 joint = forward ? last->endPoint : last->startPoint;
      const auto next = std::find_if(walls_.begin(), walls_.end(), [&](const Wall& wall) {
        return &wall != last && wall.settings == struck.settings &&
               (joint - (forward ? wall.startPoint : wall.endPoint)).norm() <= mergeDistance &&
               first.normal.dot(wall.overlap.normal) > 0.0 &&
               std::abs(cross(first.normal, wall.overlap.normal)) < chainSine;
      });
      if (next == walls_.end()) break;
      include(*next);
      last = &*next;
    }
  }
  if (total == 0.0) {
    return approach(contactPoint(outline_, motion_.position, motion_.yaw, first, penetration),
                    first.normal);
  }
  return approach({.point = sum.point / total, .arm = sum.arm / total}, normal.normalized());
}

// What lies behind a wall that the outline is already in cannot be hit: its back, the ends of a
// slab, a second skin.
void CollisionStep::findHidden() {
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
  const auto isHidden = [&](const Wall& wall) {
    return std::any_of(walls_.begin(), walls_.end(), [&](const Wall& other) {
      if (&wall == &other || !other.touched || !behind(wall.overlap, other.overlap)) return false;
      if (!behind(other.overlap, wall.overlap)) return true;
      // Each behind the other: a convex corner. The vehicle came in over the one touched last.
      const double own = sinceTouch(wall);
      const double others = sinceTouch(other);
      return own > others || (own == others && &wall > &other);
    });
  };
  // A wall hides others even if it is hidden itself.
  for (Wall& wall : walls_) wall.hidden = wall.touched && isHidden(wall);
}

// Of the walls that have had no impulse yet the one that was touched the longest time ago.
CollisionStep::Next CollisionStep::firstNewWall() {
  Next next;
  double longest = -1.0;
  for (Wall& wall : walls_) {
    if (!wall.touched || wall.hidden || wall.struck) continue;
    const bool asPaper = wall.settings->method == Method::paper;
    // The paper's point is the middle of the overlap as it is.
    const Approach first = asPaper ? approach(contactPoint(outline_, motion_.position, motion_.yaw,
                                                           wall.overlap, wall.overlap.depth),
                                              wall.overlap.normal)
                                   : touching(wall);
    if (first.speed <= restTolerance || wall.overlap.depth / first.speed <= longest) continue;
    longest = wall.overlap.depth / first.speed;
    wall.contact =
        asPaper ? first : middleOfChain(wall, first.speed * wall.settings->penetrationTime);
    next = {.wall = &wall, .at = wall.contact.speed > restTolerance ? wall.contact : first};
  }
  return next;
}

// Of the walls that have had their impulse the one that some point still approaches fastest.
CollisionStep::Next CollisionStep::fastestStruckWall() {
  Next next;
  next.at.speed = restTolerance;
  for (Wall& wall : walls_) {
    if (!wall.struck || wall.passed || wall.settings->method == Method::paper) continue;
    for (const Approach& point :
         {touching(wall), approach(wall.contact.contact, wall.contact.normal)}) {
      if (point.speed > next.at.speed) next = {.wall = &wall, .at = point};
    }
  }
  return next;
}

StepOutcome CollisionStep::resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                                   std::span<const WallSegment> walls) {
  outline_ = Outline(vehicle);
  motion_ = motion;
  impacts_.clear();
  StepOutcome outcome;

  mergeWalls(walls, motion_.position);
  findTouched();
  findHidden();

  while (true) {
    Next next = firstNewWall();
    if (next.wall == nullptr) next = fastestStruckWall();
    if (next.wall == nullptr) break;
    if (impacts_.size() == maxImpacts) {
      outcome.settled = false;
      break;
    }
    const ResponseSettings& settings = *next.wall->settings;
    const Impact impact{.wall = wallAt(walls, next.wall->overlap, next.at.contact.point),
                        .point = next.at.contact.point,
                        .normal = next.at.normal,
                        .arm = next.at.contact.arm,
                        .depth = next.wall->overlap.depth};
    const double rebound = impacts_.size() < plasticAfter ? 1.0 : 0.0;
    const ImpactResponse response =
        respond(impact, motion_, vehicle.mass, vehicle.yawInertia, settings, rebound);
    impacts_.push_back({impact, response});
    outcome.impulse += response.impulse;
    motion_ = response.after;

    next.wall->struck = true;
    next.wall->passed = response.brokeThrough;
    if (settings.method == Method::paper) {
      // The paper answers one impact in a step.
      for (Wall& wall : walls_) wall.struck |= wall.settings->method == Method::paper;
    }
  }
  outcome.impacts = impacts_;
  outcome.after = motion_;
  return outcome;
}

}  // namespace bumper
