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
  const PlanarMotion motion = advanced(participant.body.motion, time - encounter.time());
  const Placement place(frame.origin, frame.yaw);
  PairBody body{.body = participant.body, .outline = participant.outline};
  body.body.motion = {.position = frame.origin + place.turned(motion.position),
                      .yaw = frame.yaw + motion.yaw,
                      .velocity = place.turned(motion.velocity),
                      .yawRate = motion.yawRate};
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
    const double depth = pair.depth - allowedOverlap;
    if (!(depth > 0.0)) continue;
    const auto& [firstNumber, secondNumber, firstFrame, secondFrame, settings] = pair.given;
    PairBody first = bodyOf(firstNumber, firstFrame, 0.0);
    PairBody second = bodyOf(secondNumber, secondFrame, 0.0);
    Vector2 normal = separation(first.outline, first.body.motion.placement(), second.outline,
                                second.body.motion.placement())
                         .normal;
    const PairContact contact = pairContact(first, second, 0.0);
    if (!contact.normal.isZero(0.0)) normal = contact.normal;
    Member& a = member(firstNumber);
    Member& b = member(secondNumber);
    const Vector2 own = Placement({}, firstFrame.yaw).turnedBack(normal);
    const Vector2 other = Placement({}, secondFrame.yaw).turnedBack(normal);
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
  const PairBody first = bodyOf(pair.given.first, pair.given.firstFrame, time);
  const PairBody second = bodyOf(pair.given.second, pair.given.secondFrame, time);
  const double distance = separation(first.outline, first.body.motion.placement(), second.outline,
                                     second.body.motion.placement())
                              .distance;
  pair.known = true;
  pair.touches = distance <= (pair.next == time ? sweptTolerance : touchTolerance);
  pair.distance = distance;
  pair.depth = std::max(-distance, 0.0);
  if (pair.touches) {
    pair.contact = pairContact(first, second, pair.given.settings->penetrationTime);
  }
}

// When a pair may touch or approach next, after everything at `time` has been answered.
double Island::nextLook(const Pair& pair, double time) const {
  if (isHeld(pair)) return never;
  const double from = std::max(time, pair.ignoredUntil);
  if (!(from < step_)) return never;
  const PairBody first = bodyOf(pair.given.first, pair.given.firstFrame, from);
  const PairBody second = bodyOf(pair.given.second, pair.given.secondFrame, from);
  if (from == time && pair.known && pair.touches) {
    const double pause =
        leastTime(unseenOverlap, pair.contact.speed, gapAcceleration(first, second));
    return time + std::max(pause, shortestPause(*pair.given.settings, step_));
  }
  if (from == time && pair.known &&
      pair.distance > fastestClosing(first, second) * (step_ - from) + sweptTolerance) {
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
    answer(*pair, time, Rebound::as_set);
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
    for (Pair& pair : pairs_) {
      pair.known &= &member(pair.given.first) != &each && &member(pair.given.second) != &each;
    }
  }
}

// Of the pairs with a vehicle involved the one that approaches fastest; null if none does.
Island::Pair* Island::fastestPair(double time) {
  Pair* fastest = nullptr;
  double speed = restTolerance;
  for (Pair& pair : pairs_) {
    if (!member(pair.given.first).involved && !member(pair.given.second).involved) continue;
    if (isHeld(pair) || (pair.ignoredUntil > time)) continue;
    if (!pair.known) look(pair, time);
    const bool isSliver = pair.contact.share < 1.0 && pair.answers > 0;
    if (!pair.touches || isSliver || !(pair.contact.speed > speed)) continue;
    speed = pair.contact.speed;
    fastest = &pair;
  }
  return fastest;
}

void Island::answer(Pair& pair, double time, Rebound rebound) {
  const auto& [firstNumber, secondNumber, firstFrame, secondFrame, settings] = pair.given;
  involve(firstNumber, time);
  involve(secondNumber, time);
  const PairBody first = bodyOf(firstNumber, firstFrame, time);
  const PairBody second = bodyOf(secondNumber, secondFrame, time);
  PairImpact impact;
  impact.time = time;
  impact.pair = static_cast<int>(&pair - pairs_.data());
  impact.impact = pair.contact.impact(pair.depth);
  impact.response = respondTo(pair.contact, first.body, second.body, *settings, rebound);
  const PlanarImpulse& whole = impact.response.impulse;
  const auto act = [&](int number, const PairFrame& frame, const Vector2& arm, double sign) {
    const PlanarImpulse own{.linear = sign * Placement({}, frame.yaw).turnedBack(whole.linear),
                            .angular = sign * cross(arm, whole.linear)};
    Member& each = member(number);
    each.encounter->participant().body.apply(own);
    each.impulse += own;
    each.changed = true;
    for (Pair& other : pairs_) {
      other.known &= other.given.first != number && other.given.second != number;
    }
  };
  act(firstNumber, firstFrame, pair.contact.arm, 1.0);
  act(secondNumber, secondFrame, pair.contact.otherArm, -1.0);
  impacts_.push_back(impact);
  ++pair.answers;
  ++answers_;
}

// All contacts of the vehicles that touch one involved act at once.
void Island::answerTogether(double time) {
  for (bool grew = true; grew;) {
    grew = false;
    for (Pair& pair : pairs_) {
      const bool first = member(pair.given.first).involved;
      const bool second = member(pair.given.second).involved;
      if ((!first && !second) || isHeld(pair)) continue;
      if (!pair.known) look(pair, time);
      if (!pair.touches || first == second) continue;
      involve(first ? pair.given.second : pair.given.first, time);
      grew = true;
    }
  }
  jointBodies_.clear();
  jointContacts_.clear();
  owners_.clear();
  for (std::size_t i = 0; i < memberCount_; ++i) {
    jointBodies_.push_back(members_[i].body());
    Member& each = members_[i];
    if (!each.involved || each.encounter->isHeld()) continue;
    const std::span<const TouchingPoint> points = each.encounter->instant().touchingPoints();
    for (std::size_t k = 0; k < points.size(); ++k) {
      jointContacts_.push_back({.body = i, .normal = points[k].normal, .arm = points[k].arm});
      owners_.push_back({.member = static_cast<int>(i), .wall = k});
    }
  }
  for (Pair& pair : pairs_) {
    if (!pair.known || !pair.touches || isHeld(pair)) continue;
    const Member& a = member(pair.given.first);
    if (!a.involved || pair.contact.normal.isZero(0.0)) continue;
    const Placement own({}, pair.given.firstFrame.yaw);
    const Placement other({}, pair.given.secondFrame.yaw);
    for (const Vector2& end : pair.contact.ends) {
      const Vector2 aside = end - pair.contact.point;
      jointContacts_.push_back({.body = static_cast<std::size_t>(pair.given.first),
                                .normal = own.turnedBack(pair.contact.normal),
                                .arm = own.turnedBack(pair.contact.arm + aside),
                                .otherBody = static_cast<std::size_t>(pair.given.second),
                                .otherNormal = other.turnedBack(-pair.contact.normal),
                                .otherArm = other.turnedBack(pair.contact.otherArm + aside)});
      owners_.push_back({.pair = static_cast<int>(&pair - pairs_.data()), .aside = aside});
    }
  }
  const JointApproach::Result result = joint_.solve(jointBodies_, jointContacts_);
  const std::size_t firstImpact = impacts_.size();
  for (std::size_t i = 0; i < result.impulses.size(); ++i) {
    if (!(result.impulses[i] > 0.0)) continue;
    const Owner& owner = owners_[i];
    // Between these impulses no motion existed: what all of them dissipate is shared.
    const double weight = result.impulses[i] * std::max(-result.speeds[i], 0.0);
    const double change = result.weight > 0.0 ? result.energyChange * weight / result.weight : 0.0;
    if (owner.pair < 0) {
      member(owner.member)
          .encounter->instant()
          .takePart(owner.wall, {.normal = result.impulses[i]}, change, time);
      continue;
    }
    Pair& pair = pairs_[static_cast<std::size_t>(owner.pair)];
    const PairBody first = bodyOf(pair.given.first, pair.given.firstFrame, time);
    const PairBody second = bodyOf(pair.given.second, pair.given.secondFrame, time);
    PairImpact impact;
    impact.time = time;
    impact.pair = owner.pair;
    impact.impact = pair.contact.impact(pair.depth);
    for (Vector2* place : {&impact.impact.point, &impact.impact.arm, &impact.impact.otherArm}) {
      *place += owner.aside;
    }
    impact.response = plainResponse(
        impact.impact, first.body, second.body,
        onVehicle({.normal = result.impulses[i]}, impact.impact.normal, impact.impact.arm));
    const double energy = first.body.energy() + second.body.energy();
    impact.response.approachSpeed = -result.speeds[i];
    impact.response.contact.energyChange = change;
    impact.response.energyRatio = energy > 0.0 ? std::max(1.0 + change / energy, 0.0) : 1.0;
    if (impacts_.size() > firstImpact) impacts_.back().isPartOfNext = true;
    impacts_.push_back(impact);
    const JointContact& contact = jointContacts_[i];
    const auto act = [&](std::size_t number, const Vector2& normal, const Vector2& arm) {
      const Vector2 linear = result.impulses[i] * normal;
      const PlanarImpulse own{.linear = linear, .angular = cross(arm, linear)};
      members_[number].encounter->participant().body.apply(own);
      members_[number].impulse += own;
    };
    act(contact.body, contact.normal, contact.arm);
    act(contact.otherBody, contact.otherNormal, contact.otherArm);
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
    if (!member(pair.given.first).involved && !member(pair.given.second).involved) continue;
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
