#include "vehicle_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace bumper::benchmark {

namespace {

using Real = long double;
using Point = Eigen::Matrix<Real, 2, 1>;
using Polygon = std::vector<Point>;

constexpr Real grid = 0.02L;           // s: ends of runs
constexpr Real atOnce = 1e-6L;         // s
constexpr Real soon = 1e-5L;           // s: by then what was hit has parted
constexpr Real leastHop = 2e-5L;       // m: what comes back sooner has not
constexpr Real leastAdvance = 1e-12L;  // s
// The rule's own figures.
constexpr Real leastEngaged = 1e-3L;  // m
constexpr Real sliverShare = 0.5L;
constexpr Real closingSpeed = 1e-9L;  // m/s

Point leftOf(const Point& v) { return {-v.y(), v.x()}; }
Real outer(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

/// out · p ≤ reach
struct HalfPlane {
  Point out;
  Real reach = 0.0L;
  [[nodiscard]] Real beyond(const Point& p) const { return out.dot(p) - reach; }
};

struct Frame {
  Frame(const Point& place, Real yaw) : origin(place), ahead(std::cos(yaw), std::sin(yaw)) {}
  [[nodiscard]] Point turned(const Point& own) const {
    return own.x() * ahead + own.y() * leftOf(ahead);
  }
  [[nodiscard]] Point own(const Point& place) const {
    const Point way = place - origin;
    return {way.dot(ahead), way.dot(leftOf(ahead))};
  }
  Point origin;
  Point ahead;
};

struct Body {
  Real mass, inertia, front, rear, half;
  Point position;
  Real yaw;
  Point velocity;
  Real yawRate;

  explicit Body(const PairState& state)
      : mass(state.vehicle.mass),
        inertia(state.vehicle.yawInertia),
        front(state.vehicle.massCentreToFront),
        rear(state.vehicle.massCentreToRear),
        half(0.5L * static_cast<Real>(state.vehicle.width)),
        position(state.motion.position.cast<Real>()),
        yaw(state.motion.yaw),
        velocity(state.motion.velocity.cast<Real>()),
        yawRate(state.motion.yawRate) {}

  [[nodiscard]] PlanarMotion motion() const {
    return {.position = position.cast<double>(),
            .yaw = static_cast<double>(yaw),
            .velocity = velocity.cast<double>(),
            .yawRate = static_cast<double>(yawRate)};
  }
  [[nodiscard]] Frame frame(Real time) const {
    return {Point(position + time * velocity), yaw + time * yawRate};
  }
  [[nodiscard]] Real radius() const { return std::hypot(std::max(front, rear), half); }
  [[nodiscard]] Real turningSpeed() const { return std::abs(yawRate) * radius(); }
  [[nodiscard]] Point velocityAt(const Point& arm) const {
    return velocity + yawRate * leftOf(arm);
  }
  [[nodiscard]] Real energy() const {
    return 0.5L * (mass * velocity.squaredNorm() + inertia * yawRate * yawRate);
  }
  void advance(Real time) {
    position += time * velocity;
    yaw += time * yawRate;
  }
  void push(const Point& impulse, const Point& arm) {
    velocity += impulse / mass;
    yawRate += outer(arm, impulse) / inertia;
  }
};

struct Shape {
  Polygon corners;  // counter-clockwise
  std::array<HalfPlane, 4> sides;

  Shape(const Body& body, const Frame& at, Real grown = 0.0L) {
    const Real front = body.front + grown;
    const Real rear = body.rear + grown;
    const Real half = body.half + grown;
    const std::array<Point, 4> places{Point(front, half), Point(-rear, half), Point(-rear, -half),
                                      Point(front, -half)};
    for (const Point& place : places) corners.push_back(at.origin + at.turned(place));
    const std::array<Real, 4> reaches{half, rear, half, front};
    for (std::size_t i = 0; i < 4; ++i) {
      const Point edge = corners[(i + 1) % 4] - corners[i];
      sides[i].out = -leftOf(edge) / edge.norm();
      sides[i].reach = reaches[i] + sides[i].out.dot(at.origin);
    }
  }
};

Real apartBySidesOf(const Shape& one, const Shape& other) {
  Real most = -std::numeric_limits<Real>::infinity();
  for (const HalfPlane& side : one.sides) {
    Real least = std::numeric_limits<Real>::infinity();
    for (const Point& corner : other.corners) least = std::min(least, side.beyond(corner));
    most = std::max(most, least);
  }
  return most;
}

Polygon cutOff(const Polygon& polygon, const HalfPlane& by) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    const Real beyondA = by.beyond(a);
    const Real beyondB = by.beyond(b);
    if (beyondA <= 0.0L) kept.push_back(a);
    if (beyondA * beyondB < 0.0L) kept.emplace_back(a + beyondA / (beyondA - beyondB) * (b - a));
  }
  return kept;
}

struct Surface {
  Real area = 0.0L;
  Point centroid = Point::Zero();
};

Surface surfaceOf(const Polygon& polygon) {
  Surface result;
  if (polygon.size() < 3) return result;
  Point moment = Point::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Point a = polygon[i - 1] - polygon[0];
    const Point b = polygon[i] - polygon[0];
    const Real triangle = 0.5L * outer(a, b);
    result.area += triangle;
    moment += triangle / 3.0L * (a + b);
  }
  if (result.area > 0.0L) result.centroid = polygon[0] + moment / result.area;
  return result;
}

/// Each side's normal by the area of the overlap that is nearest to it.
Point facesNearest(const Polygon& overlap, const Shape& shape) {
  Point sum = Point::Zero();
  for (const HalfPlane& side : shape.sides) {
    Polygon part = overlap;
    for (const HalfPlane& other : shape.sides) {
      if (&other == &side) continue;
      part = cutOff(part, {.out = other.out - side.out, .reach = other.reach - side.reach});
    }
    sum += surfaceOf(part).area * side.out;
  }
  return sum;
}

/// Where one body is hit, and which way it is pushed.
struct Hit {
  Point point;
  Point normal;
  bool isSliver = false;
};

/// A wall, as the line that it lies on.
struct Line {
  explicit Line(const StraightWall& wall) {
    const Point way = (wall.end - wall.start).cast<Real>();
    side.out = -leftOf(way) / way.norm();
    side.reach = side.out.dot(wall.start.cast<Real>());
  }
  [[nodiscard]] Real height(const Point& p) const { return -side.beyond(p); }
  HalfPlane side;  // away from the vehicles
};

class Reference {
 public:
  Reference(const VehicleCase& vehicleCase, Real longest)
      : settings_(vehicleCase.settings), longest_(longest) {
    for (const PairState& vehicle : vehicleCase.vehicles) bodies_.emplace_back(vehicle);
    for (const StraightWall& wall : vehicleCase.walls) lines_.emplace_back(wall);
    for (std::size_t a = 0; a < bodies_.size(); ++a) {
      for (std::size_t b = a + 1; b < bodies_.size(); ++b)
        meetings_.push_back({.first = a, .second = b});
      for (std::size_t b = 0; b < lines_.size(); ++b)
        meetings_.push_back({.first = a, .second = b, .isWall = true});
    }
    past_.push_back({0.0L, bodies_});
  }

  VehicleFlight fly() {
    for (Meeting& meeting : meetings_) meeting.next = nextTouch(meeting, 0.0L);
    Doubt doubt = Doubt::none;
    while (doubt == Doubt::none) {
      std::ranges::sort(meetings_, {}, &Meeting::next);
      Meeting& meeting = meetings_.front();
      if (!(meeting.next < longest_)) break;
      const Real time = meeting.next;
      const bool isNext = past_.size() > 1 && time < past_.back().time + atOnce;
      if (isNext || (meetings_.size() > 1 && meetings_[1].next < time + atOnce)) {
        doubt = Doubt::together;
        certain_ = time;
        break;
      }
      certain_ = time;
      if (meeting.hops) {
        doubt = Doubt::lasting;
        break;
      }
      for (Body& body : bodies_) body.advance(time - time_);
      time_ = time;
      doubt = answer(meeting);
      if (doubt != Doubt::none) break;
      past_.push_back({time_, bodies_, meeting.isWall});
      for (Meeting& each : meetings_) {
        if (&each == &meeting) {
          each.next = nextTouch(each, soon);
          const Real way = each.next - time_;
          each.hops = each.next < longest_ && gap(each, 0.5L * way) < leastHop;
        } else if (involves(each, meeting)) {
          each.next = nextTouch(each, 0.0L);
          each.hops = false;
        }
      }
    }
    if (doubt == Doubt::none) certain_ = longest_;
    return result(doubt);
  }

 private:
  struct Meeting {
    std::size_t first = 0;
    std::size_t second = 0;  // another vehicle, or a wall
    bool isWall = false;
    Real next = 0.0L;   // s
    bool hops = false;  // it comes back before it has parted
  };
  struct Moment {
    Real time;
    std::vector<Body> bodies;
    bool byWall = false;
  };

  static bool involves(const Meeting& one, const Meeting& other) {
    const auto has = [&](std::size_t body) {
      return one.first == body || (!one.isWall && one.second == body);
    };
    return has(other.first) || (!other.isWall && has(other.second));
  }

  [[nodiscard]] Real gap(const Meeting& meeting, Real time) const {
    const Body& a = bodies_[meeting.first];
    const Shape first(a, a.frame(time));
    if (meeting.isWall) {
      Real least = std::numeric_limits<Real>::infinity();
      for (const Point& corner : first.corners) {
        least = std::min(least, lines_[meeting.second].height(corner));
      }
      return least;
    }
    const Body& b = bodies_[meeting.second];
    const Shape second(b, b.frame(time));
    return std::max(apartBySidesOf(first, second), apartBySidesOf(second, first));
  }

  /// The time in which a distance that falls at no more than `rate`, which grows by no more than
  /// `bend`, certainly stays above 0.
  static Real untilGone(Real distance, Real rate, Real bend) {
    if (distance <= 0.0L) return 0.0L;
    const Real root = std::sqrt(rate * rate + 2.0L * bend * distance);
    const Real sum = rate + root;
    return sum > 0.0L ? 2.0L * distance / sum : std::numeric_limits<Real>::infinity();
  }

  /// For how long all corners of `other` certainly stay beyond one of the sides of `owner`.
  [[nodiscard]] static Real apartFor(const Body& owner, const Body& other, Real time, Real within) {
    const Frame ownerAt = owner.frame(time);
    const Frame otherAt = other.frame(time);
    const Shape shape(owner, ownerAt);
    const Shape corners(other, otherAt);
    const Real turn = std::abs(owner.yawRate);
    const Real speed = (other.velocity - owner.velocity).norm() + other.turningSpeed();
    const Real away = (otherAt.origin - ownerAt.origin).norm() + other.radius() + speed * within;
    const Real bend =
        turn * (turn * away + 2.0L * speed) + std::abs(other.yawRate) * other.turningSpeed();
    Real longest = 0.0L;
    for (const HalfPlane& side : shape.sides) {
      Real wait = std::numeric_limits<Real>::infinity();
      for (const Point& corner : corners.corners) {
        const Point way = corner - ownerAt.origin;
        const Point velocity = other.velocityAt(corner - otherAt.origin) - owner.velocity;
        const Real rate = side.out.dot(velocity) + owner.yawRate * leftOf(side.out).dot(way);
        wait = std::min(wait, untilGone(side.beyond(corner), -rate, bend));
      }
      longest = std::max(longest, wait);
    }
    return longest;
  }

  [[nodiscard]] Real apartFor(const Meeting& meeting, Real time, Real within) const {
    const Body& a = bodies_[meeting.first];
    if (!meeting.isWall) {
      const Body& b = bodies_[meeting.second];
      return std::max(apartFor(a, b, time, within), apartFor(b, a, time, within));
    }
    const Line& line = lines_[meeting.second];
    const Frame at = a.frame(time);
    Real wait = std::numeric_limits<Real>::infinity();
    for (const Point& corner : Shape(a, at).corners) {
      const Real falls = line.side.out.dot(a.velocityAt(corner - at.origin));
      wait = std::min(
          wait, untilGone(line.height(corner), falls, std::abs(a.yawRate) * a.turningSpeed()));
    }
    return wait;
  }

  /// The time of the next touch, searched from `wait` on; infinite if there is none. No step of the
  /// search but the last ones, of a picosecond, is longer than they certainly stay apart; the touch
  /// is then enclosed.
  [[nodiscard]] Real nextTouch(const Meeting& meeting, Real wait) const {
    constexpr Real none = std::numeric_limits<Real>::infinity();
    const Real within = longest_ - time_;
    Real apart = wait;
    Real now = wait;
    while (gap(meeting, now) > 0.0L) {
      apart = now;
      now += std::max(apartFor(meeting, now, within), leastAdvance);
      if (!(now < within)) return none;
    }
    for (int i = 0; i < 64; ++i) {
      const Real middle = 0.5L * (apart + now);
      (gap(meeting, middle) > 0.0L ? apart : now) = middle;
    }
    return time_ + now;
  }

  /// By the nearest-face rule; nothing if the outlines do not overlap in the engaged pose.
  [[nodiscard]] std::optional<Hit> hitOf(const Body& a, const Body& b) const {
    const Real speed = (a.velocity - b.velocity).norm() + a.turningSpeed() + b.turningSpeed();
    const Real narrower =
        std::min({2.0L * a.half, a.front + a.rear, 2.0L * b.half, b.front + b.rear});
    Real ahead = settings_.penetrationTime;
    if (speed * ahead > narrower) ahead = narrower / speed;
    const Real grown = 0.5L * std::max(leastEngaged - speed * ahead, Real{0.0L});
    const Frame thenA = a.frame(ahead);
    const Frame thenB = b.frame(ahead);
    const Shape first(a, thenA, grown);
    const Shape second(b, thenB, grown);
    Polygon overlap = first.corners;
    for (const HalfPlane& side : second.sides) overlap = cutOff(overlap, side);
    const Surface whole = surfaceOf(overlap);
    if (!(whole.area > 0.0L)) return std::nullopt;
    const Point push = facesNearest(overlap, second) - facesNearest(overlap, first);
    Hit hit;
    hit.normal = push / push.norm();
    const auto now = [&](const Body& body, const Frame& then) -> Point {
      const Frame frame = body.frame(0.0L);
      return frame.origin + frame.turned(then.own(whole.centroid));
    };
    hit.point = 0.5L * (now(a, thenA) + now(b, thenB));
    const Point closing =
        b.velocityAt(hit.point - b.position) - a.velocityAt(hit.point - a.position);
    Real low = std::numeric_limits<Real>::infinity();
    Real high = -low;
    for (const Point& p : overlap) {
      low = std::min(low, hit.normal.dot(p));
      high = std::max(high, hit.normal.dot(p));
    }
    hit.isSliver = high - low < sliverShare * closing.dot(hit.normal) * ahead;
    return hit;
  }

  /// The middle of what of the wall lies inside once the outline has gone on along the normal at
  /// the touching corner's speed, as the outline has it.
  [[nodiscard]] Hit hitOf(const Body& a, const Line& line) const {
    const Shape shape(a, a.frame(0.0L));
    const Point& corner = *std::ranges::min_element(shape.corners, {},
                                                    [&](const Point& p) { return line.height(p); });
    Hit hit{.point = corner, .normal = -line.side.out};
    const Real speed = -hit.normal.dot(a.velocityAt(corner - a.position));
    const Real way = std::min(speed * settings_.penetrationTime, line.height(a.position));
    if (!(way > 0.0L)) return hit;
    // Where the outline's sides cross the line that has come so much nearer.
    Point sum = Point::Zero();
    int crossings = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Point& p = shape.corners[i];
      const Point& q = shape.corners[(i + 1) % 4];
      const Real heightP = line.height(p) - way;
      const Real heightQ = line.height(q) - way;
      if (heightP * heightQ >= 0.0L) continue;
      sum += p + heightP / (heightP - heightQ) * (q - p);
      ++crossings;
    }
    if (crossings == 2) hit.point = 0.5L * sum;
    return hit;
  }

  /// Speed at which the hit point closes, m/s.
  [[nodiscard]] static Real closing(const Hit& hit, const Body& a, const Body* b) {
    Point relative = a.velocityAt(hit.point - a.position);
    if (b != nullptr) relative -= b->velocityAt(hit.point - b->position);
    return -hit.normal.dot(relative);
  }

  /// Newton's law with friction up to the ratio that ends the slip. False if it adds energy.
  bool strike(const Hit& hit, Body& a, Body* b) const {
    const Point n = hit.normal;
    const Point t = leftOf(n);
    Real nn = 0.0L, tt = 0.0L, nt = 0.0L;  // velocity by impulse, 1/kg
    Point relative = Point::Zero();
    Real before = 0.0L;
    for (const Body* body : std::array<const Body*, 2>{&a, b}) {
      if (body == nullptr) continue;
      const Point arm = hit.point - body->position;
      const Real onNormal = outer(arm, n);
      const Real onTangent = outer(arm, t);
      nn += 1.0L / body->mass + onNormal * onNormal / body->inertia;
      tt += 1.0L / body->mass + onTangent * onTangent / body->inertia;
      nt += onNormal * onTangent / body->inertia;
      relative += (body == &a ? 1.0L : -1.0L) * body->velocityAt(arm);
      before += body->energy();
    }
    const Real across = relative.dot(n);
    const Real along = relative.dot(t);
    const AttackDirection attack{.across = static_cast<double>(-across),
                                 .along = static_cast<double>(std::abs(along))};
    Real e = settings_.restitution(attack);
    const Real restSpeed = settings_.restSpeed;
    if (-across < restSpeed) e *= -across / restSpeed;
    const Real mu = settings_.friction(attack);
    // No slip and −e times the approach: two equations.
    const Real wantedN = -(1.0L + e) * across;
    const Real wantedT = -along;
    const Real determinant = nn * tt - nt * nt;
    const Real stickN = (wantedN * tt - wantedT * nt) / determinant;
    const Real stickT = (wantedT * nn - wantedN * nt) / determinant;
    Real ratio = along > 0.0L ? -mu : mu;
    if (stickN > 0.0L) ratio = std::clamp(stickT / stickN, -mu, mu);
    const Real normal = wantedN / (nn + ratio * nt);
    const Point impulse = normal * (n + ratio * t);
    a.push(impulse, hit.point - a.position);
    Real after = a.energy();
    if (b != nullptr) {
      b->push(-impulse, hit.point - b->position);
      after += b->energy();
    }
    return normal > 0.0L && after <= before;
  }

  Doubt answer(const Meeting& meeting) {
    Body& a = bodies_[meeting.first];
    Body* b = meeting.isWall ? nullptr : &bodies_[meeting.second];
    const auto find = [&]() -> std::optional<Hit> {
      return b != nullptr ? hitOf(a, *b) : hitOf(a, lines_[meeting.second]);
    };
    const std::optional<Hit> hit = find();
    if (!hit || closing(*hit, a, b) <= closingSpeed) return Doubt::passing;
    if (hit->isSliver) return Doubt::sliver;
    if (!strike(*hit, a, b)) return Doubt::lowered;
    if (b != nullptr) {
      const std::optional<Hit> then = find();
      if (then && closing(*then, a, b) > closingSpeed) return Doubt::again;
    }
    const Real parted = gap(meeting, soon);
    if (!(parted > 0.0L && gap(meeting, 0.5L * soon) > 0.25L * parted)) return Doubt::lasting;
    return Doubt::none;
  }

  [[nodiscard]] VehicleFlight result(Doubt doubt) const {
    VehicleFlight flight;
    flight.doubt = doubt;
    for (int k = static_cast<int>(std::floor(certain_ / grid + 1e-9L)); k > 0; --k) {
      const Real end = grid * k;
      if (end > certain_) continue;
      const auto after = std::ranges::find_if(
          past_, [&](const Moment& moment) { return moment.time > end - grid; });
      const Moment& last = *std::prev(after);
      if (after != past_.end() && after->time <= end) continue;
      if (last.time == 0.0L) return flight;
      flight.duration = static_cast<double>(end);
      for (Body body : last.bodies) {
        body.advance(end - last.time);
        flight.end.push_back(body.motion());
      }
      for (auto moment = std::next(past_.begin()); moment != after; ++moment) {
        ++(moment->byWall ? flight.wallImpacts : flight.vehicleImpacts);
      }
      return flight;
    }
    return flight;
  }

  const ResponseSettings& settings_;
  Real longest_;
  std::vector<Body> bodies_;
  std::vector<Line> lines_;
  std::vector<Meeting> meetings_;
  Real time_ = 0.0L;
  Real certain_ = 0.0L;
  std::vector<Moment> past_;
};

}  // namespace

const char* nameOf(Doubt doubt) {
  constexpr std::array<const char*, doubts> names = {"none",    "passing",  "sliver", "again",
                                                     "lasting", "together", "lowered"};
  return names.at(static_cast<std::size_t>(doubt));
}

VehicleFlight flyVehicles(const VehicleCase& vehicleCase, double longest) {
  return Reference(vehicleCase, longest).fly();
}

}  // namespace bumper::benchmark
