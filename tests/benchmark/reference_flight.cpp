#include "reference_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bumper/response/impact.h"

namespace bumper::benchmark {

namespace {

using Real = long double;
using Point = Eigen::Matrix<Real, 2, 1>;

// The law's own tolerances.
constexpr Real touchGap = 1e-9L;      // m: nearer is touching
constexpr Real closingSpeed = 1e-9L;  // m/s: slower is not approaching
constexpr int fullRestitution = 8;    // impulses of one instant before restitution is left out
constexpr int mostImpulses = 10000;   // of one instant
// A touching point that comes this much nearer without an instant has one.
constexpr Real sinkLimit = 2e-9L;  // m
// How far a wall's end that touches a side may have sunk, m.
constexpr Real deepestTouch = 5e-9L;
// A touching end that moves off slower than this and comes back presses, m/s.
constexpr Real restingSpeed = 1e-6L;
constexpr Real pressingStep = 1e-4L;    // s
constexpr Real stickingStep = 2e-5L;    // s; near the end of the slip
constexpr Real slowSlip = 0.1L;         // m/s
constexpr Real shortestPress = 1e-12L;  // s
// Coulomb friction of a pressing end is linear below this slip, m/s.
constexpr Real stickingSlip = 1e-3L;
// Below this a bracket of a root in time is not divided further, s.
constexpr Real shortestBracket = 1e-17L;

Point leftOf(const Point& v) { return {-v.y(), v.x()}; }

struct State {
  Point position;
  Real yaw = 0.0L;
  Point velocity;
  Real yawRate = 0.0L;
};

State toState(const PlanarMotion& motion) {
  return {.position = motion.position.cast<Real>(),
          .yaw = motion.yaw,
          .velocity = motion.velocity.cast<Real>(),
          .yawRate = motion.yawRate};
}

PlanarMotion toMotion(const State& state) {
  return {.position = state.position.cast<double>(),
          .yaw = static_cast<double>(state.yaw),
          .velocity = state.velocity.cast<double>(),
          .yawRate = static_cast<double>(state.yawRate)};
}

State drifted(State state, Real time) {
  state.position += state.velocity * time;
  state.yaw += state.yawRate * time;
  return state;
}

/// A state with its axes worked out.
struct Pose {
  explicit Pose(const State& from)
      : state(from), forward(std::cos(from.yaw), std::sin(from.yaw)), left(leftOf(forward)) {}

  [[nodiscard]] Point toWorld(const Point& own) const { return own.x() * forward + own.y() * left; }
  [[nodiscard]] Point toOwn(const Point& vector) const {
    return {vector.dot(forward), vector.dot(left)};
  }
  /// Whether a point of the vehicle is at a place, but for what is slid in the last moment.
  [[nodiscard]] bool isAt(const Point& own, const Point& place) const {
    constexpr Real moment = 1e-6L;  // m
    return (state.position + toWorld(own) - place).norm() < moment;
  }
  [[nodiscard]] Point velocityAt(const Point& arm) const {
    return state.velocity + state.yawRate * leftOf(arm);
  }

  State state;
  Point forward;
  Point left;
};

/// A pair that can meet: a corner of the outline and the wall's face, or an end of the wall and a
/// side of the outline.
struct Pair {
  bool isCorner = true;
  std::size_t point = 0;  // the corner, or the wall's end
  std::size_t side = 0;   // of an end
};

/// Distance and rate of a pair.
struct Distance {
  Real value = 0.0L;  // a corner's height over the wall's line, an end's over the side's
  Real rate = 0.0L;
};

class FlightComputer {
 public:
  FlightComputer(const VehicleParameters& vehicle, const StraightWall& wall,
                 const ResponseSettings& settings)
      : vehicle_(vehicle), settings_(settings) {
    const Real front = vehicle.massCentreToFront;
    const Real rear = vehicle.massCentreToRear;
    const Real half = 0.5L * static_cast<Real>(vehicle.width);
    corners_ = {Point(front, half), Point(-rear, half), Point(-rear, -half), Point(front, -half)};
    // Side k goes from corner k to corner k + 1: left, rear, right, front.
    outward_ = {Point(0.0L, 1.0L), Point(-1.0L, 0.0L), Point(0.0L, -1.0L), Point(1.0L, 0.0L)};
    reach_ = {half, rear, half, front};
    radius_ = corners_[0].norm() > corners_[1].norm() ? corners_[0].norm() : corners_[1].norm();
    ends_ = {wall.start.cast<Real>(), wall.end.cast<Real>()};
    length_ = (ends_[1] - ends_[0]).norm();
    along_ = (ends_[1] - ends_[0]) / length_;
    normal_ = leftOf(along_);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      pairs_[corner] = {.isCorner = true, .point = corner};
    }
    for (std::size_t k = 0; k < 8; ++k) {
      pairs_[4 + k] = {.isCorner = false, .point = k / 4, .side = k % 4};
    }
  }

  void fly(const PlanarMotion& start, Real duration) {
    state_ = toState(start);
    while (time_ < duration) {
      const std::optional<Trigger> next = nextMeeting(duration - time_);
      if (!next) break;
      meet(*next, duration - time_);
    }
    advance(duration - time_);
  }

  void flyForced(const PlanarMotion& start, Real duration, const ForceField& forces, Real step) {
    state_ = toState(start);
    while (time_ < duration) {
      const Real h = std::min(step, duration - time_);
      kick(forces, 0.5L * h);
      answerWhatTouches();
      const Real before = time_;
      const std::optional<Trigger> next = nextMeeting(h);
      if (!next) {
        advance(h);
      } else if (next->presses) {
        press(next->pair, h);
      } else {
        advance(next->time);
      }
      kick(forces, time_ - before - 0.5L * h);
      if (next && !next->presses) answer(next->pair);
    }
  }

  Flight take() {
    flight_.end = toMotion(state_);
    return std::move(flight_);
  }

 private:
  struct Trigger {
    Real time = 0.0L;
    Pair pair;
    bool presses = false;  ///< it stays in contact from now on
  };

  /// Where and along what the vehicle is pushed.
  struct Contact {
    Point arm;
    Point normal;
  };

  void advance(Real time) {
    state_ = drifted(state_, time);
    time_ += time;
  }

  /// The velocity after `time` under the forces at this place, by the midpoint rule.
  void kick(const ForceField& forces, Real time) {
    const auto kicked = [&](const State& at, Real span) {
      const PlanarForce force = forces(toMotion(at));
      State after = state_;
      after.velocity += force.force.cast<Real>() * (span / vehicle_.mass);
      after.yawRate += force.yawMoment * span / vehicle_.yawInertia;
      return after;
    };
    state_ = kicked(kicked(state_, 0.5L * time), time);
  }

  [[nodiscard]] Distance distance(const Pair& pair, const Pose& pose) const {
    if (pair.isCorner) {
      const Point arm = pose.toWorld(corners_[pair.point]);
      return {.value = normal_.dot(pose.state.position + arm - ends_[0]),
              .rate = normal_.dot(pose.velocityAt(arm))};
    }
    const Point outward = pose.toWorld(outward_[pair.side]);
    const Point arm = ends_[pair.point] - pose.state.position;
    return {.value = outward.dot(arm) - reach_[pair.side],
            .rate = -outward.dot(pose.velocityAt(arm))};
  }

  /// A bound of the distance's second derivative over `time`.
  [[nodiscard]] Real curvature(const Pair& pair, Real time) const {
    const Real turn = std::abs(state_.yawRate);
    if (pair.isCorner) return turn * turn * corners_[pair.point].norm();
    const Real speed = state_.velocity.norm();
    const Real farthest = (ends_[pair.point] - state_.position).norm() + speed * time;
    return turn * (2.0L * speed + turn * farthest);
  }

  /// Whether the corner is over the wall, or the end beside the side.
  [[nodiscard]] bool faces(const Pair& pair, const Pose& pose) const {
    if (pair.isCorner) {
      const Point place = pose.state.position + pose.toWorld(corners_[pair.point]);
      const Real at = along_.dot(place - ends_[0]);
      return at >= 0.0L && at <= length_;
    }
    const Point own = pose.toOwn(ends_[pair.point] - pose.state.position);
    const Point a = corners_[pair.side];
    const Point b = corners_[(pair.side + 1) % 4];
    const Real part = (own - a).dot(b - a) / (b - a).squaredNorm();
    return part >= 0.0L && part <= 1.0L;
  }

  /// +1 if the pair's distance counts as it is, −1 if the vehicle is on the wall's right.
  [[nodiscard]] Real sideOf(const Pair& pair, const Pose& pose, Real value) const {
    if (!pair.isCorner) return 1.0L;
    // A touching corner is on the mass centre's side.
    if (std::abs(value) <= touchGap) value = normal_.dot(pose.state.position - ends_[0]);
    return value < 0.0L ? -1.0L : 1.0L;
  }

  [[nodiscard]] bool touches(const Pair& pair, const Pose& pose, Real value) const {
    if (value > touchGap || !faces(pair, pose)) return false;
    if (value >= -touchGap) return true;
    if (pair.isCorner || value < -deepestTouch) return false;
    // Beside a corner an end is close behind two sides, and touches that which it is nearer to.
    return std::ranges::all_of(std::array<std::size_t, 3>{1, 2, 3}, [&](std::size_t next) {
      return distance({.isCorner = false, .point = pair.point, .side = (pair.side + next) % 4},
                      pose)
                 .value < value;
    });
  }

  /// Sign · distance + offset at a time from now.
  struct Curve {
    Pair pair;
    Real sign = 1.0L;
    Real offset = 0.0L;
  };

  [[nodiscard]] Distance at(const Curve& curve, Real time) const {
    const Distance raw = distance(curve.pair, Pose(drifted(state_, time)));
    return {.value = curve.sign * raw.value + curve.offset, .rate = curve.sign * raw.rate};
  }

  /// The first time from `from` on at which the curve, above 0 there, comes down to 0. Divides
  /// until the bound of the second derivative tells that there is none, or that the curve is
  /// monotone; misses no crossing.
  [[nodiscard]] std::optional<Real> descent(const Curve& curve, Real from, Real to) const {
    return descent(curve, curvature(curve.pair, to), from, at(curve, from).value, to,
                   at(curve, to).value);
  }

  [[nodiscard]] std::optional<Real> descent(const Curve& curve, Real bend, Real from,
                                            Real fromValue, Real to, Real toValue) const {
    const Real span = to - from;
    if (std::min(fromValue, toValue) > bend * span * span / 8.0L) return std::nullopt;
    const Real middle = from + 0.5L * span;
    const Distance half = at(curve, middle);
    if (std::abs(half.rate) >= 0.5L * bend * span) {
      if (half.rate >= 0.0L || toValue > 0.0L) return std::nullopt;
      return bisect(curve, from, to);
    }
    if (span < shortestBracket) return toValue > 0.0L ? std::nullopt : std::optional(to);
    const std::optional<Real> first = descent(curve, bend, from, fromValue, middle, half.value);
    return first ? first : descent(curve, bend, middle, half.value, to, toValue);
  }

  [[nodiscard]] Real bisect(const Curve& curve, Real above, Real below) const {
    while (true) {
      const Real middle = above + 0.5L * (below - above);
      if (middle <= above || middle >= below) return below;
      (at(curve, middle).value > 0.0L ? above : below) = middle;
    }
  }

  /// When this pair meets next.
  [[nodiscard]] std::optional<Trigger> meeting(const Pair& pair, const Pose& now,
                                               Real within) const {
    const Distance start = distance(pair, now);
    Curve curve{.pair = pair, .sign = sideOf(pair, now, start.value)};
    const Curve behind{.pair = pair, .sign = -1.0L};
    const Real value = curve.sign * start.value;
    const Real reach = within * (std::abs(start.rate) + 0.5L * within * curvature(pair, within));
    if (std::abs(value) > reach + touchGap) return std::nullopt;
    Real from = 0.0L;
    if (touches(pair, now, value)) {
      // It first has to leave. Or it hops, less than a touch is wide, or it goes on pressing.
      const bool rises = curve.sign * start.rate > restingSpeed;
      const Curve gone{.pair = pair, .sign = -curve.sign, .offset = touchGap + sinkLimit};
      const Curve back{
          .pair = pair, .sign = curve.sign, .offset = (rises ? 0.0L : sinkLimit) - value};
      const std::optional<Real> leaves = descent(gone, 0.0L, within);
      const std::optional<Real> returns = descent(back, 0.0L, leaves.value_or(within));
      if (returns) {
        const bool presses = !pair.isCorner && !rises && push(pair, state_).force > 0.0L;
        return Trigger{.time = presses ? 0.0L : *returns, .pair = pair, .presses = presses};
      }
      if (!leaves) return std::nullopt;
      from = *leaves;
    } else if (!pair.isCorner && value <= 0.0L) {
      // Behind this side's line, but beside the vehicle.
      const std::optional<Real> outside = descent(behind, 0.0L, within);
      if (!outside) return std::nullopt;
      from = *outside;
    }
    while (true) {
      const std::optional<Real> crossing = descent(curve, from, within);
      if (!crossing) return std::nullopt;
      const Pose then(drifted(state_, *crossing));
      if (faces(pair, then)) return Trigger{.time = *crossing, .pair = pair};
      // Past the wall's end or past the side. A corner may come back from the wall's other side.
      from = *crossing;
      if (pair.isCorner) {
        curve.sign = -curve.sign;
      } else {
        const std::optional<Real> outside = descent(behind, from, within);
        if (!outside) return std::nullopt;
        from = *outside;
      }
    }
  }

  [[nodiscard]] std::optional<Trigger> nextMeeting(Real within) const {
    const Pose now(state_);
    // Too far for anything to meet.
    const Real place = std::clamp(along_.dot(now.state.position - ends_[0]), Real{0.0L}, length_);
    const Real away = (now.state.position - ends_[0] - place * along_).norm();
    if (away > radius_ + state_.velocity.norm() * within + touchGap) return std::nullopt;
    std::optional<Trigger> first;
    for (const Pair& pair : pairs_) {
      const std::optional<Trigger> next = meeting(pair, now, first ? first->time : within);
      if (next && (!first || next->time < first->time)) first = next;
    }
    return first;
  }

  void meet(const Trigger& next, Real within) {
    if (next.presses) {
      press(next.pair, within);
    } else {
      advance(next.time);
      answer(next.pair);
    }
  }

  /// What a pressing end does to the motion: the force that keeps the side on it, with friction.
  struct Push {
    Real force = 0.0L;  // along the normal, N
    Real slip = 0.0L;   // m/s
    Point linear;
    Real moment = 0.0L;
  };

  [[nodiscard]] Push push(const Pair& pair, const State& state) const {
    const Pose pose(state);
    const Point outward = pose.toWorld(outward_[pair.side]);
    const Point normal = -outward;
    const Point tangent = leftOf(normal);
    const Point arm = ends_[pair.point] - state.position;
    const Real slip = tangent.dot(pose.velocityAt(arm));
    const Real friction = settings_.friction(0.0);
    const Real ratio = -friction * std::clamp(slip / stickingSlip, Real{-1.0L}, Real{1.0L});
    const Real armNormal = arm.dot(normal);
    const Real armTangent = arm.dot(tangent);
    const Real yield = 1.0L / vehicle_.mass + armTangent * armTangent / vehicle_.yawInertia -
                       ratio * armNormal * armTangent / vehicle_.yawInertia;
    const Real turn = state.yawRate;
    const Real acceleration =  // of the distance, without the force
        -2.0L * turn * state.velocity.dot(leftOf(outward)) - turn * turn * arm.dot(outward);
    Push result;
    result.slip = slip;
    result.force = -acceleration / yield;
    result.linear = std::max(result.force, Real{0.0L}) * (normal + ratio * tangent);
    result.moment = arm.x() * result.linear.y() - arm.y() * result.linear.x();
    return result;
  }

  /// Slides along a pressing end until it lets go, the side ends, or something else meets; by
  /// Runge and Kutta's method of fourth order.
  void press(const Pair& pair, Real within) {
    flight_.lasting = true;
    const Real until = time_ + within;
    Real h = pressingStep;
    while (time_ < until && h > shortestPress) {
      const bool slips = std::abs(push(pair, state_).slip) > slowSlip;
      h = std::min({h, until - time_, slips ? pressingStep : stickingStep});
      const auto rate = [&](const State& at) {
        const Push by = push(pair, at);
        return State{.position = at.velocity,
                     .yaw = at.yawRate,
                     .velocity = by.linear / vehicle_.mass,
                     .yawRate = by.moment / vehicle_.yawInertia};
      };
      const auto plus = [](State at, const State& by, Real times) {
        at.position += times * by.position;
        at.yaw += times * by.yaw;
        at.velocity += times * by.velocity;
        at.yawRate += times * by.yawRate;
        return at;
      };
      const State k1 = rate(state_);
      const State k2 = rate(plus(state_, k1, 0.5L * h));
      const State k3 = rate(plus(state_, k2, 0.5L * h));
      const State k4 = rate(plus(state_, k3, h));
      State next = state_;
      next = plus(next, k1, h / 6.0L);
      next = plus(next, k2, h / 3.0L);
      next = plus(next, k3, h / 3.0L);
      next = plus(next, k4, h / 6.0L);
      const std::optional<Pair> other = meetsAnother(pair, next);
      if (other || push(pair, next).force <= 0.0L || !faces(pair, Pose(next))) {
        h *= 0.5L;
        if (other && h <= shortestPress) return answer(*other);
        continue;
      }
      record(
          ends_[pair.point] - state_.position,
          {.linear = ((next.velocity - state_.velocity) * vehicle_.mass).cast<double>(),
           .angular = static_cast<double>((next.yawRate - state_.yawRate) * vehicle_.yawInertia)});
      state_ = next;
      time_ += h;
      flight_.impacts.back().after = toMotion(state_);
      h *= 2.0L;
    }
    // Over the edge of what ended it.
    advance(std::min(shortestPress, until - time_));
  }

  /// A pair that is apart now and has met in a state soon after, or touches now and then closes.
  [[nodiscard]] std::optional<Pair> meetsAnother(const Pair& pressing, const State& next) const {
    const Pose now(state_);
    const Pose then(next);
    for (const Pair& pair : pairs_) {
      if (pair.isCorner == pressing.isCorner && pair.point == pressing.point &&
          pair.side == pressing.side) {
        continue;
      }
      // Where the end slides off its side, the corner crosses the wall's line as it passes.
      if (pair.isCorner && then.isAt(corners_[pair.point], ends_[pressing.point])) continue;
      const Real before = distance(pair, now).value;
      const Distance after = distance(pair, then);
      if (!faces(pair, then)) continue;
      const Real sign = sideOf(pair, now, before);
      const bool touched = std::abs(before) <= touchGap;
      if (touched ? sign * after.value < -sinkLimit || sign * after.rate < -closingSpeed
                  : sign * before > 0.0L && sign * after.value <= 0.0L) {
        return pair;
      }
    }
    return std::nullopt;
  }

  void record(const Point& arm, const PlanarImpulse& impulse) {
    flight_.impacts.push_back({.time = static_cast<double>(time_),
                               .arm = arm.cast<double>(),
                               .impulse = impulse,
                               .after = {}});
  }

  /// Under forces: instants that begin because a touching point was pushed.
  void answerWhatTouches() {
    const Pose now(state_);
    std::optional<Pair> fastest;
    Real speed = closingSpeed;
    for (const Pair& pair : pairs_) {
      const Distance raw = distance(pair, now);
      const Real sign = sideOf(pair, now, raw.value);
      if (!touches(pair, now, sign * raw.value)) continue;
      if (-sign * raw.rate > speed) {
        speed = -sign * raw.rate;
        fastest = pair;
      }
    }
    if (fastest) answer(*fastest);
  }

  [[nodiscard]] Real approach(const Contact& contact) const {
    return -contact.normal.dot(Pose(state_).velocityAt(contact.arm));
  }

  /// The middle of the flush part of `side` that lies over the wall, if the side is flush there.
  [[nodiscard]] std::optional<Point> flushMiddle(std::size_t side, const Pose& pose) const {
    const Point a = pose.state.position + pose.toWorld(corners_[side]) - ends_[0];
    const Point b = pose.state.position + pose.toWorld(corners_[(side + 1) % 4]) - ends_[0];
    const Real placeA = along_.dot(a);
    const Real placeB = along_.dot(b);
    const Real from = std::max(std::min(placeA, placeB), Real{0.0L});
    const Real to = std::min(std::max(placeA, placeB), length_);
    if (from >= to) return std::nullopt;
    const auto height = [&](Real place) {
      const Real part = (place - placeA) / (placeB - placeA);
      return normal_.dot(a + part * (b - a));
    };
    if (std::abs(height(from)) > touchGap || std::abs(height(to)) > touchGap) return std::nullopt;
    const Real middle = 0.5L * (from + to);
    const Real part = (middle - placeA) / (placeB - placeA);
    return ends_[0] + a + part * (b - a) - pose.state.position;
  }

  /// p0: what was touched first, or the middle of what was touched at once.
  [[nodiscard]] Contact firstTouched(const Pair& pair, const Pose& pose) const {
    if (!pair.isCorner) {
      const Point normal = -pose.toWorld(outward_[pair.side]);
      const std::optional<Point> flush = flushMiddle(pair.side, pose);
      return {.arm = flush ? *flush : Point(ends_[pair.point] - pose.state.position),
              .normal = normal};
    }
    const Real sign = normal_.dot(pose.state.position - ends_[0]) < 0.0L ? -1.0L : 1.0L;
    const Point normal = sign * normal_;
    for (const std::size_t side : {pair.point, (pair.point + 3) % 4}) {
      if (const std::optional<Point> flush = flushMiddle(side, pose)) {
        return {.arm = *flush, .normal = normal};
      }
    }
    // The deepest corner over the wall: not always the one that came last.
    std::size_t deepest = pair.point;
    Real lowest = sign * distance(pair, pose).value;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const Real value = sign * distance(pairs_[corner], pose).value;
      if (touches(pairs_[corner], pose, value) && value < lowest) {
        lowest = value;
        deepest = corner;
      }
    }
    return {.arm = pose.toWorld(corners_[deepest]), .normal = normal};
  }

  /// C: the middle of the part of the wall inside the outline once it is moved on.
  [[nodiscard]] Contact middleOfInterference(const Pair& pair, const Contact& first,
                                             const Pose& pose) const {
    const Real speed = std::max(approach(first), Real{0.0L});
    const Point reached = pair.isCorner ? ends_[0] : ends_[pair.point];
    const Real farthest = first.normal.dot(pose.state.position - reached);
    const Real shift = std::min(speed * settings_.penetrationTime, farthest);
    if (!(shift > 0.0L)) return first;
    const Point centre = pose.state.position - shift * first.normal;
    const Point a = pose.toOwn(ends_[0] - centre);
    const Point b = pose.toOwn(ends_[1] - centre);
    Real from = 0.0L;
    Real to = 1.0L;
    for (std::size_t side = 0; side < 4; ++side) {
      const Real heightA = outward_[side].dot(a) - reach_[side];
      const Real heightB = outward_[side].dot(b) - reach_[side];
      if (heightA > 0.0L && heightB > 0.0L) return first;
      if (heightA > 0.0L) from = std::max(from, heightA / (heightA - heightB));
      if (heightB > 0.0L) to = std::min(to, heightA / (heightA - heightB));
    }
    if (from > to) return first;
    return {.arm = pose.toWorld(a + 0.5L * (from + to) * (b - a)), .normal = first.normal};
  }

  /// What touches along the contact's normal and closes fastest: a corner on the wall, or an end of
  /// the wall on the same side.
  [[nodiscard]] std::optional<Contact> fastestTouching(const Contact& first) const {
    constexpr Real sameDirection = 1.0L - 1e-9L;
    const Pose pose(state_);
    std::optional<Contact> fastest;
    for (const Pair& pair : pairs_) {
      const Real value = distance(pair, pose).value;
      const Real sign = sideOf(pair, pose, value);
      if (!touches(pair, pose, sign * value)) continue;
      const Point normal =
          pair.isCorner ? Point(sign * normal_) : Point(-pose.toWorld(outward_[pair.side]));
      if (normal.dot(first.normal) < sameDirection) continue;
      const Contact contact{.arm = pair.isCorner ? pose.toWorld(corners_[pair.point])
                                                 : Point(ends_[pair.point] - pose.state.position),
                            .normal = first.normal};
      if (!fastest || approach(contact) > approach(*fastest)) fastest = contact;
    }
    return fastest;
  }

  void apply(const Contact& contact, int impulses) {
    const Impact impact{.wall = 0,
                        .point = (state_.position + contact.arm).cast<double>(),
                        .normal = contact.normal.cast<double>(),
                        .arm = contact.arm.cast<double>()};
    const ImpactResponse response =
        respond(impact, freeBody(vehicle_, toMotion(state_)), settings_,
                impulses < fullRestitution ? Rebound::as_set : Rebound::none);
    state_.velocity = response.after.velocity.cast<Real>();
    state_.yawRate = response.after.yawRate;
    record(contact.arm, response.impulse);
    flight_.impacts.back().after = toMotion(state_);
    ++flight_.impulses;
  }

  /// One instant: impulses until nothing that touches approaches.
  void answer(const Pair& pair) {
    const Pose pose(state_);
    const Contact first = firstTouched(pair, pose);
    const Contact middle = middleOfInterference(pair, first, pose);
    int impulses = 0;
    if (approach(middle) > closingSpeed) {
      apply(middle, impulses++);
    } else if (approach(first) > closingSpeed) {
      apply(first, impulses++);
    }
    while (true) {
      Contact next = first;
      if (approach(next) <= closingSpeed) {
        if (const std::optional<Contact> touching = fastestTouching(first)) next = *touching;
      }
      if (approach(middle) > approach(next)) next = middle;
      if (approach(next) <= closingSpeed) return;
      if (impulses == mostImpulses) {
        flight_.settled = false;
        return;
      }
      apply(next, impulses++);
    }
  }

  VehicleParameters vehicle_;
  const ResponseSettings& settings_;
  std::array<Point, 4> corners_;
  std::array<Point, 4> outward_;
  std::array<Real, 4> reach_{};
  Real radius_ = 0.0L;
  std::array<Point, 2> ends_;
  Point along_;
  Point normal_;
  Real length_ = 0.0L;
  std::array<Pair, 12> pairs_;
  State state_;
  Real time_ = 0.0L;
  Flight flight_;
};

}  // namespace

Flight freeFlight(const VehicleParameters& vehicle, const PlanarMotion& start,
                  const StraightWall& wall, const ResponseSettings& settings, double duration) {
  FlightComputer computer(vehicle, wall, settings);
  computer.fly(start, duration);
  return computer.take();
}

Flight forcedFlight(const VehicleParameters& vehicle, const PlanarMotion& start,
                    const StraightWall& wall, const ResponseSettings& settings, double duration,
                    const ForceField& forces, double step) {
  FlightComputer computer(vehicle, wall, settings);
  computer.flyForced(start, duration, forces, step);
  return computer.take();
}

PlanarMotion motionAt(const Flight& flight, const PlanarMotion& start, double time) {
  PlanarMotion motion = start;
  double from = 0.0;
  for (const FlightImpact& impact : flight.impacts) {
    if (impact.time > time) break;
    motion = impact.after;
    from = impact.time;
  }
  motion.position += motion.velocity * (time - from);
  motion.yaw += motion.yawRate * (time - from);
  return motion;
}

}  // namespace bumper::benchmark
