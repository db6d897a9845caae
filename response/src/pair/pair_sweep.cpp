#include "pair_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bumper/response/sweep.h"
#include "convex_polygon.h"

namespace bumper {

namespace {

// The search ends this close before the touch, m: within touchTolerance, and beyond rounding.
constexpr double closed = 1e-11;

// After so many advances the rest is found by interpolation, m away at most.
constexpr int mostAdvances = 6;
constexpr double nearEnough = 0.05;

// Bounds the work where they slide past each other.
constexpr int mostLooks = 200;

std::array<Vector2, 4> cornersAt(const Outline& outline, const Placement& at) {
  std::array<Vector2, 4> corners = outline.corners();
  for (Vector2& corner : corners) corner = at.position + at.turned(corner);
  return corners;
}

// Improves `best` by the sides of one outline, as seen from the other's corners.
void bySides(const Outline& outline, const Placement& at, const std::array<Vector2, 4>& others,
             double sign, PairSeparation& best) {
  for (const FaceLine& face : faceLines(outline, at)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector2& corner : others) nearest = std::min(nearest, face.normal.dot(corner));
    const double distance = nearest - face.offset;
    if (distance > best.distance) best = {.distance = distance, .normal = sign * face.normal};
  }
}

struct PairFlight {
  const PairBody& first;
  const PairBody& second;

  [[nodiscard]] PairSeparation at(double time) const {
    return separation(first.outline, first.placementAfter(time), second.outline,
                      second.placementAfter(time));
  }

  // For how long they certainly stay apart along a fixed direction that separates them now.
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
        wait = std::min(
            wait, leastTime(a.height - b.height, b.rate - a.rate, a.acceleration + b.acceleration));
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
  PairSeparation best{.distance = -std::numeric_limits<double>::infinity()};
  bySides(second, secondAt, cornersAt(first, firstAt), 1.0, best);
  bySides(first, firstAt, cornersAt(second, secondAt), -1.0, best);
  return best;
}

double timeOfTouch(const PairBody& first, const PairBody& second, double until) {
  const PairFlight flight{.first = first, .second = second};
  double time = 0.0;
  PairSeparation now = flight.at(time);
  double rate = 0.0;
  for (int look = 0; look < mostLooks; ++look) {
    if (now.distance <= closed) return time;
    const double wait = flight.apartFor(now, time);
    if (!(time + wait <= until)) return never;
    if (look >= mostAdvances && now.distance < nearEnough && rate > 0.0) {
      const double in = std::min(time + 1.5 * now.distance / rate, until);
      const double depth = -flight.at(in).distance;
      if (depth > 0.0) return flight.touchBetween(time, now.distance, in, depth);
    }
    const PairSeparation next = flight.at(time + wait);
    rate = wait > 0.0 ? (now.distance - next.distance) / wait : 0.0;
    if (!(time + wait > time)) return time;
    time += wait;
    now = next;
  }
  return time;
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
