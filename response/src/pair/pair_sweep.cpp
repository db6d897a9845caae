#include "pair_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bumper/response/sweep.h"

namespace bumper {

namespace {

// The search ends this close before the touch, m: within touchTolerance, and beyond rounding.
constexpr double touching = 1e-11;

// An advance may pass a touch by so much, m: it is then found between both looks. What is no deeper
// and ends before the next look is none.
constexpr double unseenTouch = 1e-7;

// Bounds the work where they slide past each other.
constexpr int mostLooks = 200;

// The side of one of two outlines that separates them best.
struct SeparatingSide {
  PairSeparation apart{.distance = -std::numeric_limits<double>::infinity()};
  bool ofFirst = false;
};

SeparatingSide separatingSide(const Outline& first, const Placement& firstAt, const Outline& second,
                              const Placement& secondAt) {
  const PlanRectangle own = first.enlarged(0.0);
  const PlanRectangle other = second.enlarged(0.0);
  const Vector2 between = secondAt.position + secondAt.turned(other.middle) - firstAt.position -
                          firstAt.turned(own.middle);
  // How the axes of one project on those of the other.
  const double along = std::abs(firstAt.cosine * secondAt.cosine + firstAt.sine * secondAt.sine);
  const double across = std::abs(firstAt.cosine * secondAt.sine - firstAt.sine * secondAt.cosine);
  SeparatingSide best;
  const auto consider = [&](const Vector2& axis, double reach, bool ofFirst) {
    const double way = axis.dot(between);
    const double distance = std::abs(way) - reach;
    if (distance > best.apart.distance) {
      best = {.apart = {.distance = distance, .normal = way > 0.0 ? Vector2(-axis) : axis},
              .ofFirst = ofFirst};
    }
  };
  const auto bySides = [&](const Placement& at, const Vector2& half, const Vector2& others,
                           bool ofFirst) {
    consider({at.cosine, at.sine}, half.x() + along * others.x() + across * others.y(), ofFirst);
    consider({-at.sine, at.cosine}, half.y() + across * others.x() + along * others.y(), ofFirst);
  };
  bySides(secondAt, other.half, own.half, false);
  bySides(firstAt, own.half, other.half, true);
  return best;
}

struct PairFlight {
  const PairBody& first;
  const PairBody& second;
  double until;

  [[nodiscard]] SeparatingSide at(double time) const {
    return separatingSide(first.outline, first.placementAfter(time), second.outline,
                          second.placementAfter(time));
  }

  // For how long they certainly stay apart, or overlap no deeper than `unseenTouch`: until a corner
  // of one can reach the line of the side of the other, which turns.
  [[nodiscard]] double apartFor(const SeparatingSide& side, double time) const {
    const PairBody& owner = side.ofFirst ? first : second;
    const PairBody& other = side.ofFirst ? second : first;
    const Vector2 out = side.ofFirst ? Vector2(-side.apart.normal) : side.apart.normal;
    const PlanarMotion& motion = owner.body.motion;
    const PlanarMotion& others = other.body.motion;
    const Placement ownerAt = owner.placementAfter(time);
    const Placement at = other.placementAfter(time);
    const double turning = std::abs(motion.yawRate);
    const double spin = std::abs(others.yawRate);
    const double speed = (others.velocity - motion.velocity).norm() + spin * other.outline.radius();
    std::array<double, 4> heights;
    std::array<Vector2, 4> arms = other.outline.corners();
    for (std::size_t i = 0; i < arms.size(); ++i) {
      arms[i] = at.turned(arms[i]);
      heights[i] = out.dot(at.position + arms[i] - ownerAt.position);
    }
    // Of the side, from its owner's mass centre.
    const double reach = *std::min_element(heights.begin(), heights.end()) - side.apart.distance;
    double wait = never;
    for (std::size_t i = 0; i < arms.size(); ++i) {
      const Vector2 away = at.position + arms[i] - ownerAt.position;
      const Vector2 velocity =
          others.velocity + others.yawRate * turnedLeft(arms[i]) - motion.velocity;
      const double rate = out.dot(velocity) + motion.yawRate * turnedLeft(out).dot(away);
      const double acceleration = turning * turning * (away.norm() + speed * (until - time)) +
                                  2.0 * turning * speed + spin * spin * arms[i].norm();
      wait = std::min(wait, leastTime(heights[i] - reach + unseenTouch, -rate, acceleration));
    }
    return wait;
  }

  // Between a time when they are apart and one when they overlap: when they touch. By false
  // position; an end that stays counts half each time (Illinois), and the share keeps off both.
  [[nodiscard]] double touchBetween(double apart, double distance, double in, double depth) const {
    double weight = 1.0;
    for (int round = 0; round < 100 && distance > touching; ++round) {
      const double share = std::clamp(distance / (distance + weight * depth), 1e-3, 1.0 - 1e-9);
      const double time = apart + share * (in - apart);
      if (time <= apart || time >= in) break;
      const double now = at(time).apart.distance;
      if (now > 0.0) {
        apart = time;
        distance = now;
        weight *= 0.5;
      } else {
        in = time;
        depth = -now;
        weight = 1.0;
        if (depth <= touching) return time;
      }
    }
    return apart;
  }
};

}  // namespace

PairSeparation separation(const Outline& first, const Placement& firstAt, const Outline& second,
                          const Placement& secondAt) {
  return separatingSide(first, firstAt, second, secondAt).apart;
}

PairSeparation separation(const PairBody& first, const PairBody& second) {
  return separation(first.outline, first.body.motion.placement(), second.outline,
                    second.body.motion.placement());
}

double timeOfTouch(const PairBody& first, const PairBody& second, double until) {
  const PairFlight flight{.first = first, .second = second, .until = until};
  double time = 0.0;
  SeparatingSide now = flight.at(time);
  if (now.apart.distance > until * fastestClosing(first, second) + unseenTouch) return never;
  for (int look = 0; look < mostLooks; ++look) {
    if (now.apart.distance <= touching) return time;
    double next = time + flight.apartFor(now, time);
    // Is there a touch that the advance would pass?
    if (next > until) next = until;
    if (!(next > time)) return next < until ? time : never;
    const SeparatingSide then = flight.at(next);
    if (then.apart.distance < 0.0) {
      return flight.touchBetween(time, now.apart.distance, next, -then.apart.distance);
    }
    if (!(next < until)) return then.apart.distance <= touching ? until : never;
    time = next;
    now = then;
  }
  return time;
}

double fastestClosing(const PairBody& first, const PairBody& second) {
  return (first.body.motion.velocity - second.body.motion.velocity).norm() +
         std::abs(first.body.motion.yawRate) * first.outline.radius() +
         std::abs(second.body.motion.yawRate) * second.outline.radius();
}

double gapAcceleration(const PairBody& first, const PairBody& second) {
  const PlanarMotion& a = first.body.motion;
  const PlanarMotion& b = second.body.motion;
  const double turningA = std::abs(a.yawRate);
  const double turningB = std::abs(b.yawRate);
  const double speed = (a.velocity - b.velocity).norm();
  const double spin = turningA * first.outline.radius() + turningB * second.outline.radius();
  return 2.0 * std::max(turningA, turningB) * (speed + spin);
}

}  // namespace bumper
