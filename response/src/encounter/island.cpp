// The timeline of several vehicles: the next look at a wall or at a pair, impulses there until
// nothing approaches, and on, until the step ends.

#include "island.h"

#include <algorithm>
#include <cmath>

#include "../pair/pair_response.h"
#include "../pair/pair_sweep.h"
#include "bumper/response/sweep.h"

namespace bumper {

namespace {

// Fraction of the overlap recovered in a step, and the slop that is kept, m.
constexpr double easedShare = 0.2;
constexpr double allowedOverlap = 1e-4;

// A pair that touches and does not approach is looked at again before it can be deeper by this, m,
// and not sooner than after this part of the penetration time, or of the step.
constexpr double unseenOverlap = 1e-5;
constexpr double lookAtPairAgain = 0.1;
constexpr double lookAgainInStep = 0.01;

// At the time of a touch that was computed they are no further apart, m.
constexpr double sweptTolerance = 1e-7;

// From so many answers to a pair at one instant on, and in a step for each vehicle, all contacts
// are solved together. Walls then do not rebound from the next number on.
constexpr int pairTogetherAfter = 1;
constexpr int wallsPlasticAfter = 4;
constexpr int mostInStep = 64;

double shortestPause(const ResponseSettings& settings, double h) {
  return settings.penetrationTime > 0.0 ? lookAtPairAgain * settings.penetrationTime
                                        : lookAgainInStep * h;
}

}  // namespace

PairBody Island::bodyOf(int number, const PairFrame& frame, double time) const {
  const Encounter& encounter = *member(number).encounter;
  const Participant& participant = encounter.participant();
  PairBody body{.body = participant.body, .outline = participant.outline};
  body.body.motion = frame.inPlane(advanced(participant.body.motion, time - encounter.time()));
  return body;
}

bool Island::isHeld(const Pair& pair) const {
  return member(pair.given.first).encounter->isHeld() ||
         member(pair.given.second).encounter->isHeld();
}

void Island::resolve(std::span<const IslandMember> members, std::span<const IslandPair> pairs,
                     double h) {
  begin(members, pairs, h);
  for (std::size_t i = 0; i < memberCount_; ++i) involve(static_cast<int>(i), 0.0);
  for (double time = 0.0;;) {
    settle(time);
    if (!(h > 0.0)) return;
    double next = h;
    for (std::size_t i = 0; i < memberCount_; ++i) next = std::min(next, members_[i].next);
    for (const Pair& pair : pairs_) next = std::min(next, pair.next);
    if (!(next < h)) return;
    time = next;
    for (std::size_t i = 0; i < memberCount_; ++i) {
      if (members_[i].next <= time) involve(static_cast<int>(i), time);
    }
    for (Pair& pair : pairs_) {
      if (pair.next > time) continue;
      involve(pair.given.first, time);
      involve(pair.given.second, time);
    }
  }
}

void Island::begin(std::span<const IslandMember> members, std::span<const IslandPair> pairs,
                   double h) {
  step_ = h;
  answers_ = 0;
  impacts_.clear();
  memberCount_ = members.size();
  if (members_.size() < memberCount_) members_.resize(memberCount_);
  pairs_.clear();
  for (const IslandPair& pair : pairs) pairs_.emplace_back().given = pair;
  for (std::size_t i = 0; i < memberCount_; ++i) {
    Member& each = members_[i];
    each.eased = Vector2::Zero();
    each.impulse = {};
    each.involved = each.changed = false;
    each.next = never;
    const IslandMember& given = members[i];
    each.encounter->place(freeBody(given.vehicle, given.motion), Outline(given.vehicle));
  }
  if (h > 0.0) easeApart();
  for (std::size_t i = 0; i < memberCount_; ++i) {
    const IslandMember& given = members[i];
    members_[i].encounter->begin(freeBody(given.vehicle, given.motion), Outline(given.vehicle),
                                 given.walls, h, members_[i].eased);
  }
  for (Pair& pair : pairs_) {
    pair.known = pair.known && !member(pair.given.first).encounter->wasShifted() &&
                 !member(pair.given.second).encounter->wasShifted();
  }
}

// Velocities that ease overlapping pairs apart, shared by their masses.
void Island::easeApart() {
  constexpr double most = CollisionStep::maxRecoverySpeed;
  for (Pair& pair : pairs_) {
    look(pair, 0.0);
    const double depth = pair.depth() - allowedOverlap;
    if (!(depth > 0.0)) continue;
    Vector2 normal = pairContact(firstOf(pair, 0.0), secondOf(pair, 0.0), 0.0).normal;
    if (normal.isZero(0.0)) normal = pair.apart.normal;
    Member& a = member(pair.given.first);
    Member& b = member(pair.given.second);
    const Vector2 own = pair.given.firstFrame.turnedBack(normal);
    const Vector2 other = pair.given.secondFrame.turnedBack(normal);
    const double wanted = std::min(easedShare * depth / step_, most);
    const double missing = wanted - (a.eased.dot(own) - b.eased.dot(other));
    if (!(missing > 0.0)) continue;
    const double ownPart = 1.0 / a.body().mass;
    const double itsPart = 1.0 / b.body().mass;
    const double both = ownPart + itsPart;
    if (!(both > 0.0)) continue;
    a.eased += missing * ownPart / both * own;
    b.eased -= missing * itsPart / both * other;
  }
  for (std::size_t i = 0; i < memberCount_; ++i) {
    const double speed = members_[i].eased.norm();
    if (speed > most) members_[i].eased *= most / speed;
  }
}

// Where two vehicles are, and their contact if they touch.
void Island::look(Pair& pair, double time) {
  const PairBody first = firstOf(pair, time);
  const PairBody second = secondOf(pair, time);
  pair.known = true;
  pair.apart = separation(first, second);
  pair.touches = pair.apart.distance <= (pair.next == time ? sweptTolerance : touchTolerance);
  if (pair.touches) {
    pair.contact = pairContact(first, second, pair.given.settings->penetrationTime);
  }
}

// When a pair may touch or approach next, after everything at `time` has been answered.
double Island::nextLook(const Pair& pair, double time) const {
  if (isHeld(pair)) return never;
  const double from = std::max(time, pair.ignoredUntil);
  if (!(from < step_)) return never;
  const PairBody first = firstOf(pair, from);
  const PairBody second = secondOf(pair, from);
  if (from == time && pair.known && pair.touches) {
    const double pause =
        leastTime(unseenOverlap, pair.contact.speed, gapAcceleration(first, second));
    return time + std::max(pause, shortestPause(*pair.given.settings, step_));
  }
  if (from == time && pair.known &&
      pair.apart.distance > fastestClosing(first, second) * (step_ - from) + sweptTolerance) {
    return never;
  }
  const double wait = timeOfTouch(first, second, step_ - from);
  return wait < never ? from + wait : never;
}

void Island::involve(int number, double time) {
  Member& each = member(number);
  if (each.involved) return;
  each.involved = each.changed = true;
  if (time > each.encounter->time() && !each.encounter->isHeld()) each.encounter->advanceTo(time);
}

// Ends all approach at one instant: of the vehicles involved, and of those that they touch.
void Island::settle(double time) {
  for (Pair& pair : pairs_) pair.answers = 0;
  const int most = 4 * static_cast<int>(std::min<std::size_t>(pairs_.size(), 64));
  const int mostAnswers = mostInStep * static_cast<int>(memberCount_);
  for (int count = 0;; ++count) {
    settleWalls(count);
    Pair* pair = fastestPair(time);
    if (pair == nullptr) break;
    if (pair->answers >= pairTogetherAfter || count >= most || answers_ >= mostAnswers) {
      answerTogether(time);
      break;
    }
    answer(*pair, time);
  }
  forgetInstant(time);
}

void Island::settleWalls(int answers) {
  for (std::size_t i = 0; i < memberCount_; ++i) {
    Member& each = members_[i];
    if (!each.changed || each.encounter->isHeld()) continue;
    each.changed = false;
    const std::size_t before = each.encounter->instant().impacts().size();
    each.encounter->settle(answers >= wallsPlasticAfter ? Effort::plastic : Effort::as_set);
    if (each.encounter->instant().impacts().size() == before) continue;
    for (Pair& pair : pairs_) pair.known &= !pair.isOf(static_cast<int>(i));
  }
}

// Of the pairs with a vehicle involved the one that approaches fastest; null if none does.
Island::Pair* Island::fastestPair(double time) {
  Pair* fastest = nullptr;
  double speed = restTolerance;
  for (Pair& pair : pairs_) {
    if (!isInvolved(pair) || isHeld(pair) || pair.ignoredUntil > time) continue;
    if (!pair.known) look(pair, time);
    const bool isSliver = pair.contact.share < 1.0 && pair.answers > 0;
    if (!pair.touches || isSliver || !(pair.contact.speed > speed)) continue;
    speed = pair.contact.speed;
    fastest = &pair;
  }
  return fastest;
}

void Island::push(int number, const PlanarImpulse& impulse) {
  Member& each = member(number);
  each.encounter->participant().body.apply(impulse);
  each.impulse += impulse;
  each.changed = true;
  for (Pair& pair : pairs_) pair.known &= !pair.isOf(number);
}

void Island::act(const PairImpact& impact) {
  const IslandPair& pair = pairs_[static_cast<std::size_t>(impact.pair)].given;
  const Vector2& linear = impact.response.impulse.linear;
  push(pair.first, pair.firstFrame.onMember(linear, impact.impact.arm));
  push(pair.second, pair.secondFrame.onMember(-linear, impact.impact.otherArm));
  impacts_.push_back(impact);
}

void Island::answer(Pair& pair, double time) {
  involve(pair.given.first, time);
  involve(pair.given.second, time);
  PairImpact impact;
  impact.time = time;
  impact.pair = numberOf(pair);
  impact.impact = pair.contact.impact(pair.depth());
  impact.response = respondTo(pair.contact, firstOf(pair, time).body, secondOf(pair, time).body,
                              *pair.given.settings);
  act(impact);
  ++pair.answers;
  ++answers_;
}

// Those that touch one involved are involved.
void Island::involveTouching(double time) {
  for (bool grew = true; grew;) {
    grew = false;
    for (Pair& pair : pairs_) {
      if (!isInvolved(pair) || isHeld(pair)) continue;
      if (!pair.known) look(pair, time);
      const bool first = member(pair.given.first).involved;
      if (!pair.touches || first == member(pair.given.second).involved) continue;
      involve(first ? pair.given.second : pair.given.first, time);
      grew = true;
    }
  }
}

// The contacts of those involved, with walls and with each other.
void Island::collectContacts() {
  jointBodies_.clear();
  jointContacts_.clear();
  owners_.clear();
  for (std::size_t i = 0; i < memberCount_; ++i) {
    jointBodies_.push_back(members_[i].body());
    Member& each = members_[i];
    if (!each.involved || each.encounter->isHeld()) continue;
    const std::span<const TouchingPoint> points = each.encounter->instant().touchingPoints();
    for (std::size_t k = 0; k < points.size(); ++k) {
      jointContacts_.push_back({.body = i,
                                .normal = points[k].normal,
                                .arm = points[k].arm,
                                .wallSpeed = points[k].wallSpeed});
      owners_.push_back({.member = static_cast<int>(i), .wall = k});
    }
  }
  for (const Pair& pair : pairs_) {
    if (!pair.known || !pair.touches || isHeld(pair) || !member(pair.given.first).involved ||
        pair.contact.normal.isZero(0.0)) {
      continue;
    }
    const auto& [first, second, own, other, settings] = pair.given;
    for (const Vector2& end : pair.contact.ends) {
      const Vector2 aside = end - pair.contact.point;
      jointContacts_.push_back({.body = static_cast<std::size_t>(first),
                                .normal = own.turnedBack(pair.contact.normal),
                                .arm = own.turnedBack(pair.contact.arm + aside),
                                .otherBody = static_cast<std::size_t>(second),
                                .otherNormal = other.turnedBack(-pair.contact.normal),
                                .otherArm = other.turnedBack(pair.contact.otherArm + aside)});
      owners_.push_back({.pair = numberOf(pair), .aside = aside});
    }
  }
}

// All contacts of the vehicles that touch one involved act at once. Between their impulses no
// motion existed: what all of them dissipate is shared by impulse and approach speed.
void Island::answerTogether(double time) {
  involveTouching(time);
  collectContacts();
  const JointApproach::Result result = joint_.solve(jointBodies_, jointContacts_);
  const std::size_t firstImpact = impacts_.size();
  for (std::size_t i = 0; i < result.impulses.size(); ++i) {
    const ContactImpulse impulse{.normal = result.impulses[i]};
    if (!(impulse.normal > 0.0)) continue;
    const double weight = impulse.normal * std::max(-result.speeds[i], 0.0);
    const double change = result.weight > 0.0 ? result.energyChange * weight / result.weight : 0.0;
    const Owner& owner = owners_[i];
    if (owner.pair < 0) {
      member(owner.member).encounter->instant().takePart(owner.wall, impulse, change, time);
      continue;
    }
    const Pair& pair = pairs_[static_cast<std::size_t>(owner.pair)];
    const PairBody first = firstOf(pair, time);
    const PairBody second = secondOf(pair, time);
    PairImpact impact;
    impact.time = time;
    impact.pair = owner.pair;
    impact.impact = pair.contact.impact(pair.depth());
    for (Vector2* place : {&impact.impact.point, &impact.impact.arm, &impact.impact.otherArm}) {
      *place += owner.aside;
    }
    impact.response = plainResponse(impact.impact, first.body, second.body,
                                    onVehicle(impulse, impact.impact.normal, impact.impact.arm));
    impact.response.approachSpeed = -result.speeds[i];
    takeShare(impact.response, first.body.energy() + second.body.energy(), change);
    if (impacts_.size() > firstImpact) impacts_.back().isPartOfNext = true;
    act(impact);
  }
  ++answers_;
  for (Pair& pair : pairs_) pair.known = false;
}

// After the last impulse at an instant: when those involved are looked at next.
void Island::forgetInstant(double time) {
  const bool tooMany = answers_ >= 2 * mostInStep * static_cast<int>(memberCount_);
  for (std::size_t i = 0; i < memberCount_; ++i) {
    Member& each = members_[i];
    if (!each.involved) continue;
    if (tooMany) each.encounter->hold();
    each.next = each.encounter->isHeld() ? never : each.encounter->nextLook(step_);
    if (!(each.next < step_)) each.next = never;
  }
  for (Pair& pair : pairs_) {
    if (!isInvolved(pair)) continue;
    if (!pair.known && !isHeld(pair)) look(pair, time);
    const bool isDue = pair.next == time && pair.answers == 0;
    if (pair.touches && (isDue || pair.contact.share < 1.0 || pair.contact.speed > restTolerance)) {
      pair.ignoredUntil = time + shortestPause(*pair.given.settings, step_);
    }
    pair.next = nextLook(pair, time);
    pair.known = false;
  }
  for (std::size_t i = 0; i < memberCount_; ++i) members_[i].involved = members_[i].changed = false;
}

StepOutcome Island::outcome(std::size_t member) const {
  const Member& each = members_[member];
  StepOutcome outcome = each.encounter->finish();
  outcome.impulse += each.impulse;
  return outcome;
}

std::span<const SpeculativeContact> Island::speculativeContacts(std::size_t member,
                                                                const PlanarMotion& motion,
                                                                const PlanarMotion& after,
                                                                double distance, double h) {
  return members_[member].encounter->speculativeContacts(motion, after, distance, h);
}

}  // namespace bumper
