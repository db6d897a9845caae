// The impulses at one instant: which contact is next, and which impulse it gets.

#include "instant.h"

#include <algorithm>

#include "../tolerances.h"
#include "bumper/response/collision_step.h"
#include "bumper/response/sweep.h"

namespace bumper {

namespace {

constexpr int maxAnswers = CollisionStep::maxAnswers;

// From this many impacts at one instant on, none rebounds; from the next number on they are solved
// together. Near the limit of one step none rebounds either.
constexpr int plasticAfter = 8;
constexpr int togetherAfter = 16;
constexpr int plasticInStepAfter = 40;

// Times that differ by less, s, do so by rounding.
constexpr double atOnceTime = 1e-12;

// Solved together are the last impacts of a step, and those before which as many were not.
constexpr int mostTogether = (maxAnswers - 1) / (togetherAfter + 1) + 1;
static_assert(CollisionStep::maxImpacts ==
              maxAnswers + mostTogether * (static_cast<int>(mostCarryingPoints) - 1));

}  // namespace

void takeShare(ImpactResponse& response, double before, double change) {
  response.contact.energyChange = change;
  response.energyRatio = before > 0.0 ? std::max(before + change, 0.0) / before : 1.0;
}

Instant::Instant(Participant& vehicle, ContactSet& contacts)
    : vehicle_(vehicle), contacts_(contacts) {
  impacts_.reserve(CollisionStep::maxImpacts);
}

void Instant::begin(double step) {
  step_ = step;
  answers_ = 0;
  impacts_.clear();
}

Settled Instant::settle(double time, Effort effort) {
  for (int count = 0;; ++count) {
    Next next = firstNewWall();
    if (next.wall == nullptr) next = fastestStruckWall();
    if (next.wall == nullptr) return count > 0 ? Settled::by_impulses : Settled::without_impulse;
    const bool last = answers_ + 1 == maxAnswers;
    if (last || count >= togetherAfter) {
      answerTogether(time);
      return last ? Settled::for_now : Settled::by_impulses;
    }
    // Unless it approaches faster than it can have become since it was last looked at.
    const Overlap& overlap = next.wall->overlap;
    const bool slides =
        time > 0.0 && overlap.byEnd && overlap.depth > freshDepth &&
        next.at.speed <= contacts_.gapAcceleration(*next.wall) * step_ / looksInStep;
    const bool tooMany = effort == Effort::plastic || count >= plasticAfter ||
                         (!slides && answers_ >= plasticInStepAfter);
    Rebound rebound = slides ? Rebound::elastic : Rebound::as_set;
    if (tooMany) rebound = Rebound::none;
    answer(next, time, rebound);
    impacts_.back().slides = slides;
  }
}

// Of the walls that have had no impulse yet the one that was touched the longest time ago; of walls
// that were touched at once, as at a vertex, the one that faces the outline the most.
Instant::Next Instant::firstNewWall() {
  Next next;
  double longest = -1.0;
  double mostFacing = 0.0;
  for (Manifold& wall : contacts_.all()) {
    if (!wall.touched || wall.hidden || wall.struck || wall.passed) continue;
    const Approach first = contacts_.touching(wall);
    if (first.speed <= restTolerance) continue;
    const double since = ContactSet::sinceTouch(wall, first.speed);
    const double facing = std::abs(wall.segment.normal.dot(first.normal));
    const bool atOnce = std::abs(since - longest) <= atOnceTime;
    if (atOnce ? facing <= mostFacing : since < longest) continue;
    wall.answered = contacts_.answerTo(wall, first);
    Approach at = wall.answered.at;
    if (at.speed <= restTolerance && wall.answered.yielding == 0.0) at = first;
    if (!wall.answered.meets || at.speed <= restTolerance) continue;
    longest = since;
    mostFacing = facing;
    next = {.wall = &wall, .at = at};
  }
  return next;
}

// Of the walls that have had their impulse the one that some point still approaches fastest.
Instant::Next Instant::fastestStruckWall() {
  Next next;
  next.at.speed = restTolerance;
  for (Manifold& wall : contacts_.all()) {
    if (!wall.struck || wall.passed) continue;
    const auto consider = [&](const Approach& point) {
      if (point.speed > next.at.speed) next = {.wall = &wall, .at = point};
    };
    const Approach& answered = wall.answered.at;
    consider(contacts_.approach(wall, answered.contact, answered.normal));
    consider(contacts_.touching(wall, wall.answered));
  }
  return next;
}

// … without what only a record needs.
Impact Instant::impactAt(const Manifold& wall, const Approach& at) const {
  return {.point = at.contact.point,
          .normal = at.normal,
          .arm = at.contact.arm,
          .otherArm = at.contact.point - contacts_.bodyOf(wall).motion.position};
}

void Instant::answer(const Next& next, double time, Rebound rebound) {
  Manifold& wall = *next.wall;
  const ImpactResponse response =
      respond(impactAt(wall, next.at), vehicle_.body, contacts_.bodyOf(wall),
              contacts_.settingsOf(wall), rebound);
  record(wall, next.at, time, response);
  wall.struck = true;
  ++answers_;
  if (!response.brokeThrough) return;
  for (Manifold& other : contacts_.all()) {
    other.passed |= other.segment.surface == wall.segment.surface &&
                    isOneWall(other.segment, next.at.contact.point, next.at.normal);
  }
}

std::span<const TouchingPoint> Instant::touchingPoints() {
  std::size_t count = 0;
  for (Manifold& wall : contacts_.all()) {
    if (!wall.touched || wall.hidden || wall.passed) continue;
    const auto add = [&](const Approach& at) {
      if (count == points_.size()) return;
      points_[count] = {
          .normal = at.normal, .arm = at.contact.arm, .wallSpeed = contacts_.speedOf(wall, at)};
      owners_[count++] = {.wall = &wall, .at = at};
    };
    const Answer answer = contacts_.answerTo(wall, contacts_.touching(wall));
    if (answer.yielding > 0.0) {
      if (answer.meets) add(answer.at);
      continue;
    }
    for (const ContactPoint& contact : wall.points.all()) {
      add(contacts_.approach(wall, contact, wall.overlap.normal));
    }
  }
  return {points_.data(), count};
}

void Instant::takePart(std::size_t point, const ContactImpulse& impulse, double energyChange,
                       double time) {
  const auto& [wall, at] = owners_[point];
  const double energy = contacts_.seenFrom(*wall).body.energy();
  ImpactResponse response =
      plainResponse(impactAt(*wall, at), vehicle_.body, contacts_.bodyOf(*wall),
                    onVehicle(impulse, at.normal, at.contact.arm));
  response.approachSpeed = at.speed;
  takeShare(response, energy, energyChange);
  record(*wall, at, time, response);
}

// All contacts act at once. They are reported as successive impacts, each consistent with its own
// arm, and their sum with the total: the energy they dissipate is shared by impulse and approach
// speed.
void Instant::answerTogether(double time) {
  const std::span<const TouchingPoint> points = touchingPoints();
  const PlanarBody before = vehicle_.body;
  SharedImpulse impulse = endApproach(before, points);
  const std::span<CarryingPoint> shares = impulse.all();
  const auto speedAt = [&](const CarryingPoint& share) { return owners_[share.point].at.speed; };
  for (auto next = shares.begin(); next != shares.end(); ++next) {
    std::iter_swap(next, std::max_element(next, shares.end(), [&](const auto& a, const auto& b) {
                     return speedAt(a) < speedAt(b);
                   }));
  }

  PlanarBody after = before;
  after.apply(impulse.sum);
  double energy = before.energy();
  const auto weightOf = [&](const CarryingPoint& share) {
    return share.impulse * std::max(speedAt(share), 0.0);
  };
  double weight = 0.0;
  for (const CarryingPoint& share : shares) weight += weightOf(share);
  // As seen from walls that move the approach ends at each of the points.
  const bool anyMoves = contacts_.anyMoves();
  const double change = anyMoves ? -0.5 * weight : after.energy() - energy;

  PlanarImpulse left = impulse.sum;
  for (const CarryingPoint& share : shares) {
    const auto& [wall, at] = owners_[share.point];
    const bool last = &share == &shares.back();
    // The last one absorbs the rounding.
    const PlanarImpulse part =
        last ? left : onVehicle({.normal = share.impulse}, at.normal, at.contact.arm);
    left.linear -= part.linear;
    left.angular -= part.angular;
    ImpactResponse response =
        plainResponse(impactAt(*wall, at), vehicle_.body, contacts_.bodyOf(*wall), part);
    if (last) response.after = after.motion;
    response.approachSpeed = at.speed;
    if (anyMoves) energy = contacts_.seenFrom(*wall).body.energy();
    takeShare(response, energy, change * weightOf(share) / weight);
    energy = std::max(energy + response.contact.energyChange, 0.0);
    record(*wall, at, time, response);
    impacts_.back().isPartOfNext = !last;
  }
  ++answers_;
}

void Instant::record(const Manifold& wall, const Approach& at, double time,
                     const ImpactResponse& response) {
  Impact impact = impactAt(wall, at);
  impact.wall = contacts_.pieceAt(wall, at.contact.point);
  impact.depth = std::max(wall.overlap.depth, 0.0);
  impacts_.push_back({.time = time, .impact = impact, .response = response});
  vehicle_.body.motion = response.after;
}

}  // namespace bumper
