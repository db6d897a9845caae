#include "bumper/response/collision_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "simultaneous_contacts.h"

namespace bumper {

namespace {

// Pieces of one wall lie in one line within these. A crack between them no wider than that is
// bridged: nothing of a vehicle fits into it.
constexpr double crackWidth = 0.1;    // m
constexpr double mergeOffset = 1e-4;  // m
constexpr double mergeSine = 1e-4;

// Walls whose normals differ by less than this sine, 5°, and whose ends meet are hit as one.
constexpr double chainSine = 0.087;
constexpr double jointWidth = 1e-3;  // m

// Nothing moves so deep into a wall, m; an outline that is was put there, and nothing is known of
// how it came in.
constexpr double standsInDepth = 0.05;

// From this many impacts at one instant on, none rebounds; from the next many on they are solved
// together. Towards the end of what one step allows none rebounds either.
constexpr int plasticAfter = 8;
constexpr int togetherAfter = 16;
constexpr int plasticInStepAfter = 40;

// Solved together are the last impacts of a step, and those before which as many were not.
constexpr int mostTogether = (CollisionStep::maxAnswers - 1) / (togetherAfter + 1) + 1;
static_assert(CollisionStep::maxImpacts ==
              CollisionStep::maxAnswers +
                  mostTogether * (static_cast<int>(mostCarryingPoints) - 1));

// Part of a depth that is eased out in a step, and what is left in peace, m.
constexpr double easeOutShare = 0.2;
constexpr double easeOutDepth = 1e-4;

// What is found deeper than this within a step, m, was not touched anew: it slides, unless it
// approaches faster than it can have become since it was last looked at.
constexpr double slidingDepth = 10.0 * touchTolerance;

// Part of a step after which a touch without effect is looked at again.
constexpr double lookAgain = 0.01;

// What touches and does not approach may do so again, as the outline turns: it is looked at before
// it can be deeper than that in each other, m, but no more often than so many times in a step.
constexpr double unseenDepth = 1e-6;
constexpr double looksInStep = 12.0;

WallSegment oriented(const WallSegment& wall, const Vector2& centre) {
  WallSegment result = wall;
  if (wall.isPost()) {
    result.normal = Vector2::Zero();
    return result;
  }
  result.normal = normalTowards(wall, centre);
  const Vector2 tangent = turnedLeft(result.normal);
  if (tangent.dot(wall.start) > tangent.dot(wall.end)) std::swap(result.start, result.end);
  return result;
}

bool continues(const WallSegment& wall, const WallSegment& piece) {
  if (std::abs(cross(wall.normal, piece.normal)) > mergeSine) return false;
  if (wall.settings != piece.settings || wall.entered != piece.entered) return false;
  const bool breaks =
      wall.settings->law == Law::energy && wall.settings->energyRoot == EnergyRoot::break_through;
  if ((breaks || wall.entered) && wall.group != piece.group) return false;
  if (wall.isPost() || piece.isPost() || wall.solid != piece.solid) return false;
  if (wall.normal.dot(piece.normal) < 0.0) return false;
  if (std::abs(wall.normal.dot(piece.start - wall.start)) > mergeOffset) return false;
  if (std::abs(wall.normal.dot(piece.end - wall.start)) > mergeOffset) return false;
  const Vector2 tangent = turnedLeft(wall.normal);
  return tangent.dot(piece.start - wall.end) <= crackWidth &&
         tangent.dot(wall.start - piece.end) <= crackWidth;
}

}  // namespace

CollisionStep::CollisionStep() { impacts_.reserve(maxImpacts); }

double CollisionStep::reach(const VehicleParameters& vehicle, const PlanarMotion& motion,
                            double penetrationTime, double h) {
  // The fastest that a point of the outline can be with the energy there is.
  const double radius = Outline(vehicle).radius();
  const double energy = yawPlaneEnergy(motion, vehicle.mass, vehicle.yawInertia);
  const double fastest =
      std::sqrt(2.0 * energy * (1.0 / vehicle.mass + radius * radius / vehicle.yawInertia));
  return fastest * (h + penetrationTime) + maxEaseOut * h + 1e-6;
}

// The piece of wall at a place on a merged line, for its number.
int CollisionStep::wallAt(const Wall& wall, const Vector2& point) const {
  int nearest = -1;
  double best = std::numeric_limits<double>::infinity();
  for (const WallSegment& piece : given_) {
    if (piece.isPost() != wall.segment.isPost()) continue;
    if (std::abs(cross(piece.normal, wall.segment.normal)) > mergeSine) continue;
    const Vector2 along = piece.end - piece.start;
    const double length2 = along.squaredNorm();
    const double share =
        length2 > 0.0 ? std::clamp((point - piece.start).dot(along) / length2, 0.0, 1.0) : 0.0;
    const double distance = std::abs((point - piece.start - share * along).norm() - piece.radius);
    if (distance < best || (distance == best && piece.id < nearest)) {
      best = distance;
      nearest = piece.id;
    }
  }
  return nearest;
}

void CollisionStep::mergeWalls(std::span<const WallSegment> walls, const Vector2& centre) {
  oriented_.clear();
  order_.clear();
  for (const WallSegment& wall : walls) {
    order_.push_back({.piece = oriented_.size()});
    oriented_.push_back(oriented(wall, centre));
    order_.back().place = turnedLeft(oriented_.back().normal).dot(oriented_.back().start);
  }
  // An order that does not depend on the mesh's; along one line it is the order of the pieces.
  const auto others = [this](const Ordered& each) {
    const WallSegment& wall = oriented_[each.piece];
    return std::tuple(turnedLeft(wall.normal).dot(wall.end), wall.normal.x(), wall.normal.y(),
                      wall.start.x(), wall.start.y(), wall.id);
  };
  std::sort(order_.begin(), order_.end(), [&others](const Ordered& a, const Ordered& b) {
    return a.place != b.place ? a.place < b.place : others(a) < others(b);
  });
  walls_.clear();
  for (const Ordered& each : order_) {
    const WallSegment& piece = oriented_[each.piece];
    const auto wall = std::find_if(walls_.begin(), walls_.end(), [&piece](const Wall& candidate) {
      return continues(candidate.segment, piece);
    });
    if (wall == walls_.end()) {
      walls_.push_back({.segment = piece, .passed = piece.entered});
      continue;
    }
    WallSegment& whole = wall->segment;
    const Vector2 tangent = turnedLeft(whole.normal);
    // On the line itself: a touch is looked for along the line, and found at the segment.
    const double length = tangent.dot(piece.end - whole.start);
    if (length > tangent.dot(whole.end - whole.start)) whole.end = whole.start + length * tangent;
  }
}

// An end from which another wall leads further into the outline is no end that could be hit.
bool CollisionStep::isShielded(const Overlap& end) const {
  const Vector2 place = end.deepest * turnedLeft(end.normal) + end.offset * end.normal;
  return std::any_of(walls_.begin(), walls_.end(), [&](const Wall& wall) {
    if (wall.segment.entered) return false;
    const auto leadsIn = [&](const Vector2& from, const Vector2& to) {
      const double distance = (from - place).norm();
      return distance <= jointWidth && distance < (to - place).norm() &&
             end.normal.dot(to - from) > mergeSine * (to - from).norm();
    };
    return leadsIn(wall.segment.start, wall.segment.end) ||
           leadsIn(wall.segment.end, wall.segment.start);
  });
}

std::optional<Overlap> CollisionStep::overlapWith(const WallSegment& wall, double time) const {
  const auto byFace = [&] { return findOverlap(outline_, place_, wall); };
  if (wall.settings->method == Method::paper) return byFace();
  std::optional<Overlap> touch = findTouch(outline_, place_, wall);
  if (!touch || wall.isPost()) return touch;
  if (time == 0.0 && touch->depth > standsInDepth) return byFace();
  if (touch->byEnd && isShielded(*touch)) {
    // The corner of two walls, one of which it touches; or nothing that could be touched.
    std::optional<Overlap> face = byFace();
    if (face && time > 0.0 && face->depth > standsInDepth) return std::nullopt;
    return face;
  }
  return touch;
}

void CollisionStep::lookAround(double time) {
  place_ = motion_.placement();
  findTouched(time);
  findHidden();
}

void CollisionStep::findTouched(double time) {
  for (Wall& wall : walls_) {
    const std::optional<Overlap> overlap = overlapWith(wall.segment, time);
    wall.touched = overlap.has_value();
    wall.hidden = false;
    wall.struck = false;
    if (!overlap) continue;
    wall.overlap = *overlap;
    wall.points = touchingPoints(outline_, place_, wall.segment, *overlap);
  }
}

CollisionStep::Approach CollisionStep::approach(const ContactPoint& contact,
                                                const Vector2& normal) const {
  return {contact, normal, -velocityAt(motion_, contact.arm).dot(normal)};
}

// Of the point of first touch and what else touches: the first if it approaches, else the fastest.
CollisionStep::Approach CollisionStep::touching(const Wall& wall) const {
  const std::span<const ContactPoint> points = wall.points.all();
  Approach best = approach(points.front(), wall.overlap.normal);
  if (best.speed > restTolerance) return best;
  for (const ContactPoint& other : points.subspan(1)) {
    const Approach point = approach(other, wall.overlap.normal);
    if (point.speed > best.speed) best = point;
  }
  return best;
}

// How long ago the wall was touched, s; infinite for one that is not approached.
double CollisionStep::sinceTouch(const Wall& wall) const {
  const double speed = touching(wall).speed;
  return speed > restTolerance ? std::max(wall.overlap.depth - touchTolerance, 0.0) / speed
                               : std::numeric_limits<double>::infinity();
}

// The middle of the line of interference with a wall and the walls that go on from its ends with a
// slight bend, each counting by its length and the less the more it is bent. A wall that is not
// quite flat is hit like a flat one.
CollisionStep::Approach CollisionStep::middleOfChain(const Wall& struck, double penetration) const {
  const Overlap& first = struck.overlap;
  const auto alone = [&] {
    return approach(contactPoint(outline_, place_, struck.segment, first, penetration),
                    first.normal);
  };
  if (struck.segment.isPost() || penetration <= 0.0) return alone();
  Placement moved = place_;
  moved.position += moveTo(first, motion_.position, penetration) * first.normal;
  Vector2 middle = Vector2::Zero();
  Vector2 normal = Vector2::Zero();
  double total = 0.0;
  const auto facing = [&](const Wall& wall) -> Vector2 {
    return &wall == &struck ? first.normal : normalTowards(wall.segment, motion_.position);
  };
  const auto include = [&](const Wall& wall) {
    const Interference inside = interference(outline_, moved, wall.segment);
    const double bend = std::abs(cross(first.normal, facing(wall)));
    const double weight = inside.length() * std::max(0.0, 1.0 - bend / chainSine);
    if (inside.empty || weight == 0.0) return;
    middle += weight * inside.middle();
    normal += weight * facing(wall);
    total += weight;
  };
  include(struck);
  for (const bool forward : {true, false}) {
    const Wall* last = &struck;
    for (std::size_t length = 1; length < walls_.size(); ++length) {
      const Vector2 joint = forward ? last->segment.end : last->segment.start;
      const auto next = std::find_if(walls_.begin(), walls_.end(), [&](const Wall& wall) {
        return &wall != last && !wall.segment.entered &&
               wall.segment.settings == struck.segment.settings &&
               (joint - (forward ? wall.segment.start : wall.segment.end)).norm() <= jointWidth &&
               first.normal.dot(facing(wall)) > 0.0 &&
               std::abs(cross(first.normal, facing(wall))) < chainSine;
      });
      if (next == walls_.end()) break;
      include(*next);
      last = &*next;
    }
  }
  if (total == 0.0) return alone();
  middle /= total;
  return approach({.point = middle, .arm = middle - moved.position}, normal.normalized());
}

// What lies behind a wall that the outline is already in cannot be hit: its back, the ends of a
// slab, a second skin.
void CollisionStep::findHidden() {
  constexpr double tolerance = 1e-6;  // m
  const auto behind = [](const Overlap& wall, const Overlap& front) {
    if (front.byEnd) return false;
    const Vector2 tangent = turnedLeft(front.normal);
    const auto hiddenAt = [&](const Vector2& point) {
      const double along = tangent.dot(point);
      return front.normal.dot(point) <= front.offset + tolerance &&
             along >= front.start - tolerance && along <= front.end + tolerance;
    };
    return hiddenAt(wall.insideFrom) && hiddenAt(wall.insideTo);
  };
  const auto isHidden = [&](const Wall& wall) {
    return std::any_of(walls_.begin(), walls_.end(), [&](const Wall& other) {
      if (&wall == &other || !other.touched || other.passed) return false;
      if (!behind(wall.overlap, other.overlap)) return false;
      if (!behind(other.overlap, wall.overlap)) return true;
      // Each behind the other: a convex corner. The vehicle came in over the one touched last.
      const double own = sinceTouch(wall);
      const double others = sinceTouch(other);
      return own > others || (own == others && &wall > &other);
    });
  };
  // A wall hides others even if it is hidden itself.
  for (Wall& wall : walls_) wall.hidden = wall.touched && !wall.passed && isHidden(wall);
}

// Of the walls that have had no impulse yet the one that was touched the longest time ago.
CollisionStep::Next CollisionStep::firstNewWall() {
  Next next;
  double longest = -1.0;
  for (Wall& wall : walls_) {
    if (!wall.touched || wall.hidden || wall.struck || wall.passed) continue;
    const bool asPaper = wall.segment.settings->method == Method::paper;
    // The paper's point is the middle of the overlap as it is.
    const Approach first = asPaper ? approach(contactPoint(outline_, place_, wall.segment,
                                                           wall.overlap, wall.overlap.depth),
                                              wall.overlap.normal)
                                   : touching(wall);
    if (first.speed <= restTolerance) continue;
    const double since = std::max(wall.overlap.depth - touchTolerance, 0.0) / first.speed;
    if (since <= longest) continue;
    longest = since;
    wall.contact =
        asPaper ? first : middleOfChain(wall, first.speed * wall.segment.settings->penetrationTime);
    next = {.wall = &wall, .at = wall.contact.speed > restTolerance ? wall.contact : first};
  }
  return next;
}

// Of the walls that have had their impulse the one that some point still approaches fastest.
CollisionStep::Next CollisionStep::fastestStruckWall() {
  Next next;
  next.at.speed = restTolerance;
  for (Wall& wall : walls_) {
    if (!wall.struck || wall.passed) continue;
    for (const Approach& point :
         {touching(wall), approach(wall.contact.contact, wall.contact.normal)}) {
      if (point.speed > next.at.speed) next = {.wall = &wall, .at = point};
    }
  }
  return next;
}

void CollisionStep::record(const Wall& wall, const Approach& at, double time,
                           const ImpactResponse& response) {
  const Impact impact{.wall = wallAt(wall, at.contact.point),
                      .point = at.contact.point,
                      .normal = at.normal,
                      .arm = at.contact.arm,
                      .depth = std::max(wall.overlap.depth, 0.0)};
  impacts_.push_back({.time = time, .impact = impact, .response = response});
  motion_ = response.after;
}

void CollisionStep::answer(const Next& next, double time, Rebound rebound) {
  Wall& wall = *next.wall;
  const ResponseSettings& settings = *wall.segment.settings;
  const ImpactResponse response =
      respond({.normal = next.at.normal, .arm = next.at.contact.arm}, motion_, vehicle_.mass,
              vehicle_.yawInertia, settings, rebound);
  record(wall, next.at, time, response);
  wall.struck = true;
  ++answers_;
  for (Wall& other : walls_) {
    // The paper answers one impact in a step, and no more.
    if (settings.method == Method::paper)
      other.passed |= other.segment.settings->method == Method::paper;
    if (response.brokeThrough) {
      other.passed |= other.segment.group == wall.segment.group &&
                      other.segment.settings == wall.segment.settings;
    }
  }
}

// All that touches pushes at once. It is told as one impact after the other, of which each fits its
// own arm and all of them what they do together. The motions between them never were, and may be
// fast where walls face each other. So the approach speed is the one before them all, and the
// energy that they take together is told in shares that go by impulse and approach speed: none
// gains.
void CollisionStep::answerTogether(double time) {
  std::array<TouchingPoint, mostTouchingPoints> points;
  std::array<Next, mostTouchingPoints> owners;
  std::size_t count = 0;
  for (Wall& wall : walls_) {
    if (!wall.touched || wall.hidden || wall.passed) continue;
    const auto add = [&](const ContactPoint& contact) {
      if (count == points.size()) return;
      points[count] = {.normal = wall.overlap.normal, .arm = contact.arm};
      owners[count++] = {.wall = &wall, .at = approach(contact, wall.overlap.normal)};
    };
    for (const ContactPoint& point : wall.points.all()) add(point);
  }
  const double mass = vehicle_.mass;
  const double yawInertia = vehicle_.yawInertia;
  SharedImpulse impulse = endApproach(motion_, mass, yawInertia, std::span(points.data(), count));
  const std::span<CarryingPoint> shares = impulse.all();
  const auto speedAt = [&](const CarryingPoint& share) { return owners[share.point].at.speed; };
  for (auto next = shares.begin(); next != shares.end(); ++next) {
    std::iter_swap(next, std::max_element(next, shares.end(), [&](const auto& a, const auto& b) {
                     return speedAt(a) < speedAt(b);
                   }));
  }

  const PlanarMotion after = afterImpulse(motion_, impulse.sum, mass, yawInertia);
  double energy = yawPlaneEnergy(motion_, mass, yawInertia);
  const double change = yawPlaneEnergy(after, mass, yawInertia) - energy;
  const auto weightOf = [&](const CarryingPoint& share) {
    return share.impulse * std::max(speedAt(share), 0.0);
  };
  double weight = 0.0;
  for (const CarryingPoint& share : shares) weight += weightOf(share);

  PlanarImpulse left = impulse.sum;
  for (const CarryingPoint& share : shares) {
    const auto& [wall, at] = owners[share.point];
    const bool last = &share == &shares.back();
    // The last one takes what rounding leaves.
    const PlanarImpulse part =
        last ? left : onVehicle({.normal = share.impulse}, at.normal, at.contact.arm);
    left.linear -= part.linear;
    left.angular -= part.angular;
    ImpactResponse response = plainResponse({.normal = at.normal, .arm = at.contact.arm}, motion_,
                                            mass, yawInertia, part);
    if (last) response.after = after;
    response.approachSpeed = at.speed;
    response.contact.energyChange = change * weightOf(share) / weight;
    const double kept = std::max(energy + response.contact.energyChange, 0.0);
    response.energyRatio = energy > 0.0 ? kept / energy : 1.0;
    energy = kept;
    record(*wall, at, time, response);
    impacts_.back().isPartOfNext = !last;
  }
  ++answers_;
}

// Applies impulses until nothing that touches approaches.
CollisionStep::Settled CollisionStep::settle(double time) {
  for (int count = 0;; ++count) {
    Next next = firstNewWall();
    if (next.wall == nullptr) next = fastestStruckWall();
    if (next.wall == nullptr) return count > 0 ? Settled::by_impulses : Settled::without_impulse;
    const bool last = answers_ + 1 == maxAnswers;
    if (last || count >= togetherAfter) {
      answerTogether(time);
      return last ? Settled::for_now : Settled::by_impulses;
    }
    const Overlap& overlap = next.wall->overlap;
    const bool slides = time > 0.0 && overlap.byEnd && overlap.depth > slidingDepth &&
                        next.at.speed <= gapAcceleration() * step_ / looksInStep;
    const bool tooMany = count >= plasticAfter || (!slides && answers_ >= plasticInStepAfter);
    Rebound rebound = slides ? Rebound::elastic : Rebound::as_set;
    if (tooMany) rebound = Rebound::none;
    answer(next, time, rebound);
    impacts_.back().slides = slides;
  }
}

// Of all walls that the outline stands in: the velocity that takes it out a little.
Vector2 CollisionStep::easeOut(double h) const {
  Vector2 velocity = Vector2::Zero();
  for (const Wall& wall : walls_) {
    if (!wall.touched || wall.hidden || wall.passed) continue;
    if (wall.segment.settings->method == Method::paper) continue;
    const double depth = wall.overlap.depth - easeOutDepth;
    if (depth <= 0.0) continue;
    const double wanted = std::min(easeOutShare * depth / h, maxEaseOut);
    const double missing = wanted - velocity.dot(wall.overlap.normal);
    if (missing > 0.0) velocity += missing * wall.overlap.normal;
  }
  const double speed = velocity.norm();
  return speed > maxEaseOut ? Vector2(maxEaseOut / speed * velocity) : velocity;
}

// The most that the rate of any gap can change by itself, m/s².
double CollisionStep::gapAcceleration() const {
  const double turning = std::abs(motion_.yawRate);
  return turning * (2.0 * motion_.velocity.norm() + turning * outline_.radius());
}

// How long a wall that is touched can be left alone, s: none of the points that touch can approach
// before, or be deeper than `unseenDepth`.
double CollisionStep::quietTime(const Wall& wall, double h) const {
  const double bend = gapAcceleration();
  if (wall.hidden) return leastTime(unseenDepth, 0.0, bend);
  const Overlap& overlap = wall.overlap;
  const Vector2 tangent = turnedLeft(overlap.normal);
  double time = never;
  const auto include = [&](const ContactPoint& contact) {
    const Vector2 velocity = velocityAt(motion_, contact.arm);
    const double along = tangent.dot(contact.point);
    const bool isCorner =
        !overlap.byEnd && std::min(along - overlap.start, overlap.end - along) > touchTolerance;
    // Turning draws a corner away from the wall as long as it lies on the wall's side of the mass
    // centre; at the step's end, too.
    const double highest =
        overlap.normal.dot(contact.arm) + std::abs(motion_.yawRate) * h * outline_.radius();
    if (!isCorner || highest > 0.0) {
      time = std::min(time, leastTime(unseenDepth, -overlap.normal.dot(velocity), bend));
    }
  };
  for (const ContactPoint& point : wall.points.all()) include(point);
  return time;
}

// How long all that touches now can be left alone, s.
double CollisionStep::pause(double h) const {
  double time = never;
  for (const Wall& wall : walls_) {
    if (wall.touched && !wall.passed) time = std::min(time, quietTime(wall, h));
  }
  return std::max(time, h / looksInStep);
}

// The next touch after `from`, and its wall; null if there is none before `until`.
CollisionStep::NextTouch CollisionStep::nextTouch(double from, double until) {
  NextTouch next{.time = until, .wall = nullptr};
  const Sweep sweep(outline_, motion_);
  for (Wall& wall : walls_) {
    if (wall.passed || wall.segment.settings->method == Method::paper) continue;
    const double start = std::max(from, wall.unheardOf);
    if (start > next.time) continue;
    // motion_ is the motion at `from`.
    const double time =
        from + sweep.timeOfTouch(wall.segment, wall.touched ? &wall.overlap : nullptr, start - from,
                                 next.time - from);
    if (time <= next.time) next = {.time = time, .wall = &wall};
  }
  return next;
}

std::span<const SpeculativeContact> CollisionStep::speculativeContacts(const PlanarMotion& motion,
                                                                       const PlanarMotion& after,
                                                                       double distance, double h) {
  speculative_.begin(outline_, motion, after, distance, h);
  motion_ = motion;
  lookAround(0.0);
  const double fastest = motion.velocity.norm() + std::abs(motion.yawRate) * outline_.radius();
  for (const Wall& wall : walls_) {
    const ResponseSettings& settings = *wall.segment.settings;
    const bool breaks =
        settings.law == Law::energy && settings.energyRoot == EnergyRoot::break_through;
    if (settings.method == Method::paper || breaks || wall.hidden) continue;
    // A long force pulse lets the vehicle in.
    const double depth =
        wall.segment.entered ? wall.segment.depth : enteredDepth(fastest, settings.contactTime);
    speculative_.addWall(wall.segment, wall.touched ? &wall.overlap : nullptr, depth);
  }
  return speculative_.all();
}

StepOutcome CollisionStep::resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                                   std::span<const WallSegment> walls, double h) {
  vehicle_ = vehicle;
  outline_ = Outline(vehicle);
  motion_ = motion;
  step_ = h;
  given_ = walls;
  impacts_.clear();
  answers_ = 0;
  StepOutcome outcome;
  mergeWalls(walls, motion_.position);

  lookAround(0.0);
  if (h > 0.0) {
    outcome.shift.velocity = easeOut(h);
    if (!outcome.shift.velocity.isZero(0.0)) {
      motion_.position += h * outcome.shift.velocity;
      lookAround(0.0);
    }
  }

  double time = 0.0;
  Settled settled = settle(time);
  while (settled != Settled::for_now && h > 0.0) {
    const double look = time + pause(h);
    const NextTouch next = nextTouch(time, std::min(look, h));
    if (next.wall == nullptr && look >= h) break;
    motion_ = advanced(motion_, next.time - time);
    time = next.time;
    lookAround(time);
    settled = settle(time);
    if (settled == Settled::without_impulse && next.wall != nullptr) {
      next.wall->unheardOf = time + lookAgain * h;
    }
  }
  for (const StepImpact& impact : impacts_) outcome.impulse += impact.response.impulse;
  outcome.impacts = impacts_;
  outcome.settled = settled != Settled::for_now;
  if (outcome.settled || !(h > 0.0)) {
    outcome.after = advanced(motion_, h - time);
  } else {
    // Where it would go is not known: it waits.
    outcome.after = motion_;
    const double share = (h - time) / h;
    outcome.shift.velocity -= share * motion_.velocity;
    outcome.shift.yawRate -= share * motion_.yawRate;
  }
  return outcome;
}

}  // namespace bumper
