#include "pair_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bumper/response/sweep.h"

namespace bumper {

namespace {

// The search ends this close before the touch, m: within touchTolerance, and beyond rounding.
constexpr double closed = 1e-11;

// After so many advances the rest is found by interpolation, m away at most.
constexpr int mostAdvances = 4;
constexpr double nearEnough = 0.05;

// A guess goes no further than so many safe advances: not to a second touch beyond the first.
constexpr double farthestGuess = 3.0;

// An advance may pass a touch by so much, m: it is then found between both looks. What is no deeper
// and ends before the next look is none.
constexpr double unseenTouch = 1e-7;

// Bounds the work where they slide past each other.
constexpr int mostLooks = 200;

struct PairFlight {
  const PairBody& first;
  const PairBody& second;

  [[nodiscard]] PairSeparation at(double time) const {
    return separation(first.outline, first.placementAfter(time), second.outline,
                      second.placementAfter(time));
  }

  // For how long they certainly stay apart, or overlap no deeper than `unseenTouch`, along a fixed
  // direction that separates them now.
  [[nodiscard]] double apartFor(const PairSeparation& now, double time) const {
    struct Corner {
      double height;
      double rate;
      double acceleration;
    };
    const auto cornersOf = [&](const PairBody& body) {
      const Placement at = body.placementAfter(time);
      const double turning = body.body.motion.yawRate;
      std::array<Corner, 4> result;
      const std::array<Vector2, 4> corners = body.outline.corners();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector2 arm = at.turned(corners[i]);
        result[i] = {.height = now.normal.dot(at.position + arm),
                     .rate = now.normal.dot(body.body.motion.velocity + turning * turnedLeft(arm)),
                     .acceleration = turning * turning * arm.norm()};
      }
      return result;
    };
    double wait = never;
    const std::array<Corner, 4> below = cornersOf(second);
    for (const Corner& a : cornersOf(first)) {
      for (const Corner& b : below) {
        wait = std::min(wait, leastTime(a.height - b.height + unseenTouch, b.rate - a.rate,
                                        a.acceleration + b.acceleration));
      }
    }
    return wait;
  }

  // Between a time when they are apart and one when they overlap: when they touch.
  [[nodiscard]] double touchBetween(double apart, double distance, double in, double depth) const {
    double weight = 1.0;  // Illinois
    for (int round = 0; round < 100 && distance > closed; ++round) {
      const double share = std::clamp(distance / (distance + weight * depth), 1e-3, 1.0 - 1e-9);
      const double time = apart + share * (in - apart);
      if (time <= apart || time >= in) break;
      const double now = at(time).distance;
      if (now > 0.0) {
        apart = time;
        distance = now;
        weight *= 0.5;
      } else {
        in = time;
        depth = -now;
        weight = 1.0;
        if (depth <= closed) return time;
      }
    }
    return apart;
  }
};

}  // namespace

PairSeparation separation(const Outline& first, const Placement& firstAt, const Outline& second,
                          const Placement& secondAt) {
  const PlanRectangle own = first.enlarged(0.0);
  const PlanRectangle other = second.enlarged(0.0);
  const Vector2 between = secondAt.position + secondAt.turned(other.middle) - firstAt.position -
                          firstAt.turned(own.middle);
  // How the axes of one project on those of the other.
  const double along = std::abs(firstAt.cosine * secondAt.cosine + firstAt.sine * secondAt.sine);
  const double across = std::abs(firstAt.cosine * secondAt.sine - firstAt.sine * secondAt.cosine);
  PairSeparation best{.distance = -std::numeric_limits<double>::infinity()};
  const auto consider = [&](const Vector2& axis, double reach) {
    const double way = axis.dot(between);
    const double distance = std::abs(way) - reach;
    if (distance > best.distance) {
      best = {.distance = distance, .normal = way > 0.0 ? Vector2(-axis) : axis};
    }
  };
  const auto bySides = [&](const Placement& at, const Vector2& half, const Vector2& others) {
    consider({at.cosine, at.sine}, half.x() + along * others.x() + across * others.y());
    consider({-at.sine, at.cosine}, half.y() + across * others.x() + along * others.y());
  };
  bySides(secondAt, other.half, own.half);
  bySides(firstAt, own.half, other.half);
  return best;
}

double timeOfTouch(const PairBody& first, const PairBody& second, double until) {
  const PairFlight flight{.first = first, .second = second};
  double time = 0.0;
  PairSeparation now = flight.at(time);
  if (now.distance > until * fastestClosing(first, second) + unseenTouch) return never;
  double rate = 0.0;
  for (int look = 0; look < mostLooks; ++look) {
    if (now.distance <= closed) return time;
    double next = time + flight.apartFor(now, time);
    if (next > until) {
      // Not even a touch that the advance would pass?
      if (!(flight.at(until).distance < 0.0)) return never;
      next = until;
    } else if (look >= mostAdvances && now.distance < nearEnough && rate > 0.0) {
      const double in =
          std::min({time + 1.5 * now.distance / rate, time + farthestGuess * (next - time), until});
      const double depth = -flight.at(in).distance;
      if (depth > 0.0) return flight.touchBetween(time, now.distance, in, depth);
    }
    if (!(next > time)) return time;
    const PairSeparation then = flight.at(next);
    if (then.distance < 0.0) return flight.touchBetween(time, now.distance, next, -then.distance);
    rate = (now.distance - then.distance) / (next - time);
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
