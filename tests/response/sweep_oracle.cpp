#include "sweep_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bumper::tests {
namespace {

// A flight that comes no nearer than the wall's distance allows needs few looks; one that slides
// along a wall needs many, and is given up.
constexpr int mostLooks = 30'000;
// A dip into the wall between two looks may stay unseen if it is shallower than this, m.
constexpr Real shortestWay = 1e-7L;

Plane turnedBy(const Plane& v, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

Plane nearestOnSegment(const Plane& p, const Plane& a, const Plane& b) {
  const Real length2 = (b - a).squaredNorm();
  if (length2 == 0.0L) return a;
  return a + std::clamp((p - a).dot(b - a) / length2, 0.0L, 1.0L) * (b - a);
}

/// The rectangle in its own frame.
struct Box {
  Real front, rear, halfWidth;

  explicit Box(const Outline& outline)
      : front(outline.front), rear(-Real{outline.rear}), halfWidth(outline.halfWidth) {}
  [[nodiscard]] Plane nearest(const Plane& p) const {
    return {std::clamp(p.x(), rear, front), std::clamp(p.y(), -halfWidth, halfWidth)};
  }
  [[nodiscard]] std::array<Plane, 4> corners() const {
    return {Plane(front, halfWidth), Plane(rear, halfWidth), Plane(rear, -halfWidth),
            Plane(front, -halfWidth)};
  }
};

/// A direction along which the two might be apart, and how far they are.
struct Axis {
  Real gap = 0.0L;
  Plane normal = Plane::Zero();
  bool side = false;
};

/// The sides of the box against the points a and b.
std::array<Axis, 4> sides(const Box& box, const Plane& a, const Plane& b) {
  return {Axis{std::min(a.x(), b.x()) - box.front, {-1.0L, 0.0L}, true},
          Axis{box.rear - std::max(a.x(), b.x()), {1.0L, 0.0L}, true},
          Axis{std::min(a.y(), b.y()) - box.halfWidth, {0.0L, -1.0L}, true},
          Axis{-box.halfWidth - std::max(a.y(), b.y()), {0.0L, 1.0L}, true}};
}

/// Of the rectangle's points from the mass centre, m.
Real farthest(const Outline& outline) {
  return std::hypot(Real{std::max(outline.front, outline.rear)}, Real{outline.halfWidth});
}

/// The soonest that a height of this rate, whose rate falls by no more than `bend` per second, can
/// be 0.
Real soonestDown(Real height, Real rate, Real bend) {
  if (height <= 0.0L) return 0.0L;
  const Real root = std::sqrt(rate * rate + 2.0L * bend * height);
  return root > rate ? 2.0L * height / (root - rate) : std::numeric_limits<Real>::infinity();
}

/// How long the rectangle stays beyond the wall along a direction of the plane, at least: no corner
/// is accelerated more than on the outermost circle.
Real staysBeyond(const Outline& outline, const Flight& flight, const Segment& wall, Real time,
                 const Plane& away) {
  const Plane centre = flight.positionAt(time);
  const Real bend = flight.yawRate * flight.yawRate * farthest(outline);
  const Real front =
      std::max(away.dot(wall.start.cast<Real>()), away.dot(wall.end.cast<Real>())) + wall.radius;
  Real least = std::numeric_limits<Real>::infinity();
  for (const Plane& corner : placed(outline, centre, flight.yawAt(time))) {
    const Plane arm = corner - centre;
    const Plane velocity = flight.velocity + flight.yawRate * Plane(-arm.y(), arm.x());
    least = std::min(least, soonestDown(away.dot(corner) - front, away.dot(velocity), bend));
  }
  return least;
}

/// How long the wall stays beside one and the same side of the rectangle, at least, until `until`:
/// in the rectangle's frame its points are accelerated by Coriolis and the turn.
Real staysBeside(const Outline& outline, const Flight& flight, const Segment& wall, Real time,
                 Real until) {
  const Box box(outline);
  const Real yaw = flight.yawAt(time), speed = flight.velocity.norm();
  const Plane velocity = turnedBy(flight.velocity, -yaw);
  std::array<Real, 4> least{};
  least.fill(std::numeric_limits<Real>::infinity());
  for (const Vector2& end : {wall.start, wall.end}) {
    const Plane p = turnedBy(end.cast<Real>() - flight.positionAt(time), -yaw);
    const Plane rate = -velocity - flight.yawRate * Plane(-p.y(), p.x());
    const Real bend = 2.0L * std::abs(flight.yawRate) * speed +
                      flight.yawRate * flight.yawRate * (p.norm() + speed * (until - time));
    const std::array<Axis, 4> beside = sides(box, p, p);
    for (std::size_t k = 0; k < 4; ++k) {
      least[k] = std::min(
          least[k], soonestDown(beside[k].gap - wall.radius, -beside[k].normal.dot(rate), bend));
    }
  }
  return *std::max_element(least.begin(), least.end());
}

}  // namespace

Separation separation(const Outline& outline, const Plane& position, Real yaw,
                      const Segment& wall) {
  const Box box(outline);
  const Plane a = turnedBy(wall.start.cast<Real>() - position, -yaw);
  const Plane b = turnedBy(wall.end.cast<Real>() - position, -yaw);
  Separation result;

  if (wall.isPost()) {
    const Plane nearest = box.nearest(a);
    const Real distance = (nearest - a).norm();
    result.arm = turnedBy(nearest, yaw);
    result.alongSide = true;
    if (distance > 0.0L) {
      result.gap = distance - wall.radius;
      result.normal = turnedBy((nearest - a) / distance, yaw);
      result.away = result.normal;
      result.secondDepth = std::numeric_limits<Real>::infinity();
      return result;
    }
  }

  std::array<Axis, 6> axes;
  std::size_t count = 0;
  for (const Axis& axis : sides(box, a, b)) axes[count++] = axis;
  const Plane along = b - a;
  if (along.squaredNorm() > 0.0L) {
    const Plane n = Plane(-along.y(), along.x()).normalized();
    Real lowest = std::numeric_limits<Real>::infinity(), highest = -lowest;
    for (const Plane& corner : box.corners()) {
      lowest = std::min(lowest, n.dot(corner - a));
      highest = std::max(highest, n.dot(corner - a));
    }
    axes[count++] = {lowest, n, false};
    axes[count++] = {-highest, -n, false};
  }
  const auto wider = [](const Axis& p, const Axis& q) { return p.gap > q.gap; };
  Axis* const last = axes.data() + count;
  std::iter_swap(axes.data(), std::min_element(axes.data(), last, wider));
  result.normal = turnedBy(axes[0].normal, yaw);
  result.alongSide = axes[0].side;
  if (axes[0].gap <= 0.0L) {
    std::sort(axes.data(), last, wider);
    result.gap = axes[0].gap - wall.radius;
    result.secondDepth = -axes[1].gap + wall.radius;
    return result;
  }

  // Apart: the nearest points are a corner and a point of the segment, or an end and a point of the
  // box.
  result.gap = std::numeric_limits<Real>::infinity();
  const auto consider = [&](const Plane& onBox, const Plane& onWall) {
    const Real distance = (onBox - onWall).norm();
    if (distance >= result.gap) return;
    result.gap = distance;
    result.arm = turnedBy(onBox, yaw);
    result.away = turnedBy((onBox - onWall) / distance, yaw);
  };
  for (const Plane& corner : box.corners()) consider(corner, nearestOnSegment(corner, a, b));
  for (const Plane& end : {a, b}) consider(box.nearest(end), end);
  return result;
}

Real Flight::fastest(const Outline& outline) const {
  return velocity.norm() + std::abs(yawRate) * farthest(outline);
}

Separation separationAt(const Outline& outline, const Flight& flight, const Segment& wall,
                        Real time) {
  return separation(outline, flight.positionAt(time), flight.yawAt(time), wall);
}

FirstTouch firstTouch(const Outline& outline, const PlanarMotion& motion, const Segment& wall,
                      Real from, Real until, Start start) {
  const Flight flight(motion);
  const Real fastest = flight.fastest(outline);
  FirstTouch result;
  result.nearest = std::numeric_limits<Real>::infinity();
  bool isClear = start == Start::apart;
  Real time = from, apart = from;
  for (int look = 0; look < mostLooks; ++look) {
    const Separation now = separationAt(outline, flight, wall, time);
    if (!isClear) {
      isClear = now.gap > clear;
    } else if (now.gap <= 0.0L) {
      // Between `apart` and `time`.
      Real before = apart, after = time;
      while (true) {
        const Real middle = 0.5L * (before + after);
        if (middle <= before || middle >= after) break;
        (separationAt(outline, flight, wall, middle).gap > 0.0L ? before : after) = middle;
      }
      result.kind = FirstTouch::Kind::touch;
      result.time = after;
      const Real earlier = std::max(from, before - 1e-7L / fastest);
      result.at = separationAt(outline, flight, wall, before);
      if (before > earlier) {
        result.approach =
            (separationAt(outline, flight, wall, earlier).gap - result.at.gap) / (before - earlier);
      }
      return result;
    }
    if (isClear) {
      apart = time;
      result.nearest = std::min(result.nearest, now.gap);
    }
    if (time >= until || fastest == 0.0L) return result;
    Real wait = shortestWay / fastest;
    if (now.gap > clear) {
      wait = std::max({wait, staysBeyond(outline, flight, wall, time, now.away),
                       staysBeside(outline, flight, wall, time, until)});
    }
    time = std::min(until, time + wait);
  }
  result.kind = FirstTouch::Kind::undecided;
  return result;
}

Real deepestIn(const Outline& outline, const PlanarMotion& motion, const Segment& wall, Real from,
               Real until) {
  constexpr int looks = 500;
  const Flight flight(motion);
  Real deepest = -std::numeric_limits<Real>::infinity();
  for (int i = 0; i <= looks; ++i) {
    const Real time = from + (until - from) * i / looks;
    deepest = std::max(deepest, -separationAt(outline, flight, wall, time).gap);
  }
  return deepest;
}

}  // namespace bumper::tests
