#include "bumper/response/sweep.h"

#include <algorithm>
#include <cmath>

namespace bumper {

namespace {

// Points no deeper in each other than this, m, touch; deeper ones have nothing to do with each
// other along this direction.
constexpr double touchingDepth = 0.01;

// Points that part more slowly than this, m/s, slide over each other; they are looked at again
// before they can be deeper than that in each other, m.
constexpr double slidingSpeed = 1e-3;
constexpr double slidingDepth = 0.002;

// Bounds the work where two points part and meet again and again.
constexpr int maxSteps = 200;

// A distance between two points along a direction, and how fast it changes, m/s.
struct Gap {
  double distance = 0.0;
  double rate = 0.0;
  bool counts = false;  // whether the points are really opposite each other
};

// What free flight does to the outline: place and turn at a time.
struct Flight {
  struct Pose {
    Vector2 centre;
    double cosine;
    double sine;
    double rate;  // yaw rate
    Vector2 velocity;

    [[nodiscard]] Vector2 turned(const Vector2& v) const {
      return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
    }
    [[nodiscard]] Vector2 turnedBack(const Vector2& v) const {
      return {cosine * v.x() + sine * v.y(), cosine * v.y() - sine * v.x()};
    }
  };
  [[nodiscard]] Pose at(double time) const {
    const double yaw = motion.yaw + time * motion.yawRate;
    return {.centre = motion.position + time * motion.velocity,
            .cosine = std::cos(yaw),
            .sine = std::sin(yaw),
            .rate = motion.yawRate,
            .velocity = motion.velocity};
  }

  Flight(const PlanarMotion& itsMotion, double itsFrom, double itsPause)
      : motion(itsMotion), from(itsFrom), pause(itsPause), first(at(from)) {}

  PlanarMotion motion;
  double from;
  double pause;
  Pose first;  // at `from`
};

// The first time at which a gap is closed and closing. `speed` bounds its rate, `bend` the rate's
// own rate, so that no touch between two looks can be missed. `inside`: the points may be in each
// other a little from the start.
template <typename GapOf>
double firstClosed(const Flight& flight, const GapOf& gapOf, double speed, double bend, bool inside,
                   double until) {
  constexpr double closed = 0.5 * touchTolerance;
  const double from = flight.from;
  Gap gap = gapOf(flight.first);
  if (gap.distance > speed * (until - from)) return never;
  double time = from;
  bool touching = inside && gap.distance > -touchingDepth;
  for (int step = 0; step < maxSteps; ++step) {
    // A touch begins where the gap closes, and lasts until it opens or the points pass each other.
    touching =
        gap.counts && gap.distance <= closed && (touching || gap.distance >= -touchTolerance);
    double wait = 0.0;
    if (gap.distance > closed) {
      // As long as it takes at least to close it.
      const double root = std::sqrt(gap.rate * gap.rate + 2.0 * bend * gap.distance);
      wait = gap.rate < 0.0 ? 2.0 * gap.distance / (root - gap.rate)
                            : (bend > 0.0 ? (root + gap.rate) / bend : never);
    } else if (!touching) {
      // As long as it takes at least to open it, and no less than brings the search to its end.
      wait = std::max((closed - gap.distance) / speed, (until - from) / maxSteps);
    } else if (gap.rate < -restTolerance) {
      // A last look from outside came short by rounding's worth.
      const double rest = gap.distance > -touchTolerance ? gap.distance / gap.rate : 0.0;
      return std::clamp(time - rest, from, until);
    } else {
      // They part, or slide over each other, and may approach again.
      wait = bend > 0.0 ? 2.0 * gap.rate / bend : never;
      if (gap.rate < slidingSpeed || gap.distance < -touchTolerance) {
        wait = std::max(wait, std::min(flight.pause, std::sqrt(2.0 * slidingDepth / bend)));
      }
    }
    const double next = time + wait;
    if (!(next <= until)) return never;
    // Closer than the next number: this is the touch.
    if (next == time) return gap.counts && gap.rate < -restTolerance ? time : never;
    time = next;
    gap = gapOf(flight.at(time));
  }
  return never;
}

// A corner of the outline and a face of the wall. `front` is 1 if the corner comes from the
// normal's side, −1 from the other.
double cornerOnFace(const Flight& flight, const Vector2& corner, const WallSegment& wall,
                    double front, bool inside, double until) {
  const Vector2 normal = front * wall.normal;
  const Vector2 tangent = turnedLeft(normal);
  const double start = tangent.dot(wall.start);
  const double end = tangent.dot(wall.end);
  const double low = std::min(start, end) - touchTolerance;
  const double high = std::max(start, end) + touchTolerance;
  const double offset = normal.dot(wall.start);
  const auto gapOf = [&](const Flight::Pose& pose) {
    const Vector2 arm = pose.turned(corner);
    const Vector2 place = pose.centre + arm;
    const double along = tangent.dot(place);
    return Gap{.distance = normal.dot(place) - offset,
               .rate = normal.dot(pose.velocity + pose.rate * turnedLeft(arm)),
               .counts = low <= along && along <= high};
  };
  const double radius = corner.norm();
  const double yawRate = std::abs(flight.motion.yawRate);
  return firstClosed(flight, gapOf, flight.motion.velocity.norm() + yawRate * radius,
                     yawRate * yawRate * radius, inside, until);
}

// A point of the barrier, or the middle of a post, and a side of the outline.
double pointOnSide(const Flight& flight, const Vector2& point, double radius, const Vector2& out,
                   double reach, double low, double high, bool inside, double until) {
  const Vector2 along = turnedLeft(out);
  const auto gapOf = [&](const Flight::Pose& pose) {
    const Vector2 local = pose.turnedBack(point - pose.centre);
    const Vector2 rate = -pose.turnedBack(pose.velocity) - pose.rate * turnedLeft(local);
    const double place = along.dot(local);
    return Gap{.distance = out.dot(local) - reach - radius,
               .rate = out.dot(rate),
               .counts = low <= place && place <= high};
  };
  const double speed = flight.motion.velocity.norm();
  const double yawRate = std::abs(flight.motion.yawRate);
  const double farthest = (point - flight.motion.position).norm() +
                          speed * std::max(std::abs(flight.from), std::abs(until));
  return firstClosed(flight, gapOf, speed + yawRate * farthest,
                     2.0 * yawRate * speed + yawRate * yawRate * farthest, inside, until);
}

// A corner of the outline and the round of a post.
double cornerOnPost(const Flight& flight, const Vector2& corner, const WallSegment& post,
                    bool inside, double until) {
  const auto gapOf = [&](const Flight::Pose& pose) {
    const Vector2 arm = pose.turned(corner);
    const Vector2 away = pose.centre + arm - post.start;
    const double distance = away.norm();
    const Vector2 velocity = pose.velocity + pose.rate * turnedLeft(arm);
    return Gap{.distance = distance - post.radius,
               .rate = distance > 0.0 ? away.dot(velocity) / distance : 0.0,
               .counts = true};
  };
  const double radius = corner.norm();
  const double yawRate = std::abs(flight.motion.yawRate);
  const double speed = flight.motion.velocity.norm() + yawRate * radius;
  return firstClosed(flight, gapOf, speed, yawRate * yawRate * radius + speed * speed / post.radius,
                     inside, until);
}

}  // namespace

PlanarMotion advanced(PlanarMotion motion, double time) {
  motion.position += time * motion.velocity;
  motion.yaw += time * motion.yawRate;
  return motion;
}

double timeOfTouch(const Outline& outline, const PlanarMotion& motion, const WallSegment& wall,
                   const Overlap* touch, double from, double until, double pause) {
  const Flight flight(motion, from, pause);
  double first = until;
  bool found = false;
  const auto consider = [&](double time) {
    if (time > first) return;
    first = time;
    found = true;
  };

  const bool inFace = touch != nullptr && !touch->byEnd;
  const bool inSide = touch != nullptr && touch->byEnd;
  for (const Vector2& corner : outline.corners()) {
    if (wall.isPost()) {
      consider(cornerOnPost(flight, corner, wall, inSide, first));
      continue;
    }
    // A corner comes from the side that it is on, unless it has gone in a little.
    double front = 1.0;
    if (inFace) {
      front = touch->normal.dot(wall.normal) < 0.0 ? -1.0 : 1.0;
    } else if (!wall.solid) {
      const Vector2 place = flight.first.centre + flight.first.turned(corner);
      double height = wall.normal.dot(place - wall.start);
      if (std::abs(height) <= touchTolerance) {
        height = wall.normal.dot(flight.first.centre - wall.start);
      }
      front = height < 0.0 ? -1.0 : 1.0;
    }
    consider(cornerOnFace(flight, corner, wall, front, inFace, first));
  }

  struct Side {
    Vector2 out;
    double reach, low, high;  // the span is along out turned left
  };
  const Side sides[] = {
      {{1.0, 0.0}, outline.front, -outline.halfWidth, outline.halfWidth},
      {{-1.0, 0.0}, outline.rear, -outline.halfWidth, outline.halfWidth},
      {{0.0, 1.0}, outline.halfWidth, -outline.front, outline.rear},
      {{0.0, -1.0}, outline.halfWidth, -outline.rear, outline.front},
  };
  for (const Side& side : sides) {
    consider(pointOnSide(flight, wall.start, wall.radius, side.out, side.reach,
                         side.low - touchTolerance, side.high + touchTolerance, inSide, first));
    if (wall.isPost()) continue;
    consider(pointOnSide(flight, wall.end, 0.0, side.out, side.reach, side.low - touchTolerance,
                         side.high + touchTolerance, inSide, first));
  }
  return found ? first : never;
}

}  // namespace bumper
