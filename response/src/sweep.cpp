#include "bumper/response/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tolerances.h"

namespace bumper {

namespace {

// Points in contact that separate more slowly than this, m/s, slide.
constexpr double slidingSpeed = 1e-3;

// Bounds the work where two points separate and touch repeatedly.
constexpr int maxLooks = 200;

// A distance between two points along a direction, and how fast it changes, m/s.
struct Gap {
  double distance = 0.0;
  double rate = 0.0;
  double aside = 0.0;  // how far the points are from being opposite each other; ≤ 0: they are

  [[nodiscard]] bool counts() const { return aside <= 0.0; }
};

// The vehicle at one time, and its mass centre's velocity, as seen from the walls.
struct Stage : Placement {
  Vector2 velocity = Vector2::Zero();
};

// The motion as seen from the walls, and values shared by all evaluations. Walls that turn see the
// mass centre on a curve.
struct Flight {
  const PlanarMotion& motion;
  const Vector2& pivot;
  double spin;                // of the walls
  double turning;             // |yaw rate|
  double from;                // when the search begins
  double speed = 0.0;         // the mass centre is no faster
  double acceleration = 0.0;  // … and its velocity changes no faster
  Stage first{};              // at `from`

  [[nodiscard]] Stage at(double time) const {
    Stage stage{{motion.position + time * motion.velocity, motion.yaw + time * motion.yawRate},
                motion.velocity};
    if (spin == 0.0) return stage;
    const Placement walls(Vector2::Zero(), time * spin);
    const Vector2 arm = walls.turnedBack(stage.position - pivot);
    stage.position = pivot + arm;
    stage.velocity = walls.turnedBack(motion.velocity) - spin * turnedLeft(arm);
    return stage;
  }
  // Of a point of the outline.
  [[nodiscard]] Vector2 velocityAt(const Stage& stage, const Vector2& arm) const {
    return stage.velocity + motion.yawRate * turnedLeft(arm);
  }
};

// The first time at which a gap closes. Conservative advancement: `speed` bounds its rate and
// `acceleration` its acceleration, so that no touch between two evaluations is missed.
template <typename GapOf>
double firstClosed(const Flight& flight, const GapOf& gapOf, double speed, double acceleration,
                   double until) {
  constexpr double closed = 0.5 * touchTolerance;
  const double from = flight.from;
  const double shortest = (until - from) / maxLooks;
  Gap gap = gapOf(flight.first);
  if (gap.distance > speed * (until - from)) return never;
  double time = from;
  for (int look = 0; look < maxLooks; ++look) {
    // Before they touch they have to be opposite each other, neither apart nor overlapping.
    double wait = std::max(gap.aside, 0.0) / speed;
    if (gap.distance > closed) {
      wait = std::max(wait, leastTime(gap.distance, -gap.rate, acceleration));
    } else if (gap.distance < -touchTolerance) {
      wait = std::max({wait, leastTime(closed - gap.distance, gap.rate, acceleration), shortest});
    } else if (!gap.counts()) {
      wait = std::max(wait, shortest);
    } else if (gap.rate < -restTolerance) {
      // The last advance fell short by rounding.
      return std::clamp(time - gap.distance / gap.rate, from, until);
    } else {
      // They separate, and may approach again; sliding is handled elsewhere.
      if (acceleration == 0.0 || gap.rate < slidingSpeed) return never;
      wait = 2.0 * gap.rate / acceleration;
    }
    const double next = time + wait;
    if (!(next <= until)) return never;
    if (next == time) {
      // Closer than the resolution of time: this is the touch.
      if (!gap.counts() || gap.rate >= -restTolerance) return never;
      return time;
    }
    time = next;
    gap = gapOf(flight.at(time));
  }
  return never;
}

// A corner of the outline and a face of the wall. `front` is 1 if the corner comes from the
// normal's side, −1 from the other.
double cornerOnFace(const Flight& flight, const Vector2& corner, const Segment& wall, double front,
                    double until) {
  const Vector2 normal = front * wall.normal;
  const Vector2 tangent = turnedLeft(normal);
  const double start = tangent.dot(wall.start);
  const double end = tangent.dot(wall.end);
  const double low = std::min(start, end) - touchTolerance;
  const double high = std::max(start, end) + touchTolerance;
  const double offset = normal.dot(wall.start);
  const auto gapOf = [&](const Stage& at) {
    const Vector2 arm = at.turned(corner);
    const Vector2 place = at.position + arm;
    const double along = tangent.dot(place);
    return Gap{.distance = normal.dot(place) - offset,
               .rate = normal.dot(flight.velocityAt(at, arm)),
               .aside = std::max(low - along, along - high)};
  };
  const double swing = flight.turning * corner.norm();
  return firstClosed(flight, gapOf, flight.speed + swing,
                     flight.turning * swing + flight.acceleration, until);
}

// A point of the barrier, or the middle of a post, and a side of the outline.
double pointOnSide(const Flight& flight, const Vector2& point, const Segment& wall,
                   const Vector2& out, double reach, double low, double high, double until) {
  const Vector2 along = turnedLeft(out);
  const double farthest = (point - flight.motion.position).norm() +
                          flight.speed * std::max(std::abs(flight.from), std::abs(until));
  const double fastest = flight.speed + flight.turning * farthest;
  const auto gapOf = [&](const Stage& at) {
    const Vector2 local = at.local(point);
    const Vector2 rate = -at.turnedBack(at.velocity) - flight.motion.yawRate * turnedLeft(local);
    const double place = along.dot(local);
    Gap gap{.distance = out.dot(local) - reach - wall.radius,
            .rate = out.dot(rate),
            .aside = std::max(low - place, place - high)};
    if (wall.solid) {
      // A side that faces the inside has to turn first.
      const double inwards = at.turned(out).dot(wall.normal);
      if (inwards > 0.0) gap.aside = std::max(gap.aside, fastest * inwards / flight.turning);
    }
    return gap;
  };
  return firstClosed(
      flight, gapOf, fastest,
      flight.turning * (2.0 * flight.speed + flight.turning * farthest) + flight.acceleration,
      until);
}

// A corner of the outline and the round of a post.
double cornerOnPost(const Flight& flight, const Vector2& corner, const Segment& post,
                    double until) {
  const auto gapOf = [&](const Stage& at) {
    const Vector2 arm = at.turned(corner);
    const Vector2 away = at.position + arm - post.start;
    const double distance = away.norm();
    return Gap{.distance = distance - post.radius,
               .rate = distance > 0.0 ? away.dot(flight.velocityAt(at, arm)) / distance : 0.0,
               .aside = 0.0};
  };
  const double swing = flight.turning * corner.norm();
  const double speed = flight.speed + swing;
  return firstClosed(flight, gapOf, speed,
                     flight.turning * swing + speed * speed / post.radius + flight.acceleration,
                     until);
}

// Whether a distance with an initial `rate` and a maximum `acceleration` keeps its sign for `time`
// seconds. Its lower bound is concave, so that its minimum is at the beginning or the end.
bool keepsSign(double distance, double rate, double acceleration, double time) {
  constexpr double open = 2.0 * touchTolerance;
  if (distance < 0.0) {
    distance = -distance;
    rate = -rate;
  }
  return distance > open && distance + (rate - 0.5 * acceleration * time) * time > open;
}

}  // namespace

double leastTime(double distance, double rate, double acceleration) {
  const double root = std::sqrt(rate * rate + 2.0 * acceleration * distance);
  if (rate > 0.0) return 2.0 * distance / (root + rate);
  return acceleration > 0.0 ? (root - rate) / acceleration : never;
}

Sweep::Sweep(const Outline& outline, const PlanarMotion& motion, const PlanarMotion& walls)
    : outline_(outline),
      motion_(motion),
      pivot_(walls.position),
      spin_(walls.yawRate),
      start_(motion.placement()) {
  motion_.velocity -= walls.velocity;
  motion_.yawRate -= walls.yawRate;
  speed_ = motion_.velocity.norm();
}

double Sweep::timeOfTouch(const Segment& wall, const Overlap* touch, double from,
                          double until) const {
  Flight flight{.motion = motion_,
                .pivot = pivot_,
                .spin = spin_,
                .turning = std::abs(motion_.yawRate),
                .from = from,
                .speed = speed_};
  if (spin_ != 0.0) {
    const double straight = flight.speed;
    const double farthest = (motion_.position - pivot_).norm() + straight * until;
    flight.speed += std::abs(spin_) * farthest;
    flight.acceleration = std::abs(spin_) * (2.0 * straight + std::abs(spin_) * farthest);
  }
  flight.first = from == 0.0 && spin_ == 0.0 ? Stage{start_, motion_.velocity} : flight.at(from);
  const double fastest = flight.speed + flight.turning * outline_.radius();
  const double way = fastest * (until - from) + 2.0 * touchTolerance;
  const PlanRectangle bounds = outline_.enlarged(way + wall.radius);
  const Vector2 start = flight.first.local(wall.start);
  const Vector2 end = flight.first.local(wall.end);
  if (bounds.misses(start, end)) return never;

  double first = until;
  bool found = false;
  const auto consider = [&](double time) {
    if (time > first) return;
    first = time;
    found = true;
  };

  const bool inFace = touch != nullptr && !touch->byEnd;
  const Vector2 middle = 0.5 * (wall.start + wall.end);
  const double halfLength = 0.5 * std::abs(cross(wall.normal, wall.end - wall.start));
  for (const Vector2& corner : outline_.corners()) {
    if (wall.isPost()) {
      consider(cornerOnPost(flight, corner, wall, first));
      continue;
    }
    const Vector2 arm = flight.first.turned(corner);
    const Vector2 place = flight.first.position + arm;
    double height = wall.normal.dot(place - wall.start);
    if (std::abs(height) > way) continue;
    const double rate = wall.normal.dot(flight.velocityAt(flight.first, arm));
    const double acceleration =
        flight.turning * flight.turning * outline_.radius() + flight.acceleration;
    if (keepsSign(height, rate, acceleration, until - from)) continue;
    if (std::abs(cross(wall.normal, place - middle)) > halfLength + way) continue;
    // A corner comes from the side that it is on, unless it penetrates slightly.
    double front = 1.0;
    if (inFace) {
      front = touch->normal.dot(wall.normal) < 0.0 ? -1.0 : 1.0;
    } else if (!wall.solid) {
      if (std::abs(height) <= (touch != nullptr ? slidingDepth : touchTolerance)) {
        height = wall.normal.dot(flight.first.position - wall.start);
      }
      front = height < 0.0 ? -1.0 : 1.0;
    }
    consider(cornerOnFace(flight, corner, wall, front, first));
  }

  const std::array<OutlineSide, 4> sides = outline_.sides();
  const auto considerSides = [&](const Vector2& point, const Vector2& local) {
    // As seen from the turning vehicle the point moves no faster than that.
    const double farthest = local.norm() + way;
    const double itsWay =
        (flight.speed + flight.turning * farthest) * (until - from) + 2.0 * touchTolerance;
    const Vector2 rate =
        -flight.first.turnedBack(flight.first.velocity) - motion_.yawRate * turnedLeft(local);
    const double acceleration =
        flight.turning * (2.0 * flight.speed + flight.turning * farthest) + flight.acceleration;
    for (const OutlineSide& side : sides) {
      const double away = side.out.dot(local) - side.reach - wall.radius;
      const double along = turnedLeft(side.out).dot(local);
      if (std::abs(away) > itsWay || std::max(side.low - along, along - side.high) > itsWay) {
        continue;
      }
      if (keepsSign(away, side.out.dot(rate), acceleration, until - from)) continue;
      consider(pointOnSide(flight, point, wall, side.out, side.reach, side.low - touchTolerance,
                           side.high + touchTolerance, first));
    }
  };
  if (!bounds.misses(start, start)) considerSides(wall.start, start);
  if (!wall.isPost() && !bounds.misses(end, end)) considerSides(wall.end, end);
  if (!found) return never;
  return first;
}

}  // namespace bumper
