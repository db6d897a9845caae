#include "bumper/response/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "sweep_oracle.h"

namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;

// How far apart outline and wall may be, or how deep in each other, at the time of touch, m. Also:
// what comes no nearer or gets no deeper than this may be a touch or none.
constexpr double exact = 1e-9;
// Positions lie up to 100 m from the origin, where a double has 1.4e-14 m; sines and products of
// some of them, m.
constexpr double position = 1e-11;
// How much contact normal and solid wall's normal must agree for the touch to be at its front, or
// disagree to be at its back. Between them it is at an end, flat on: either will do.
constexpr double aslant = 1e-6;

// What flies apart faster than this does not approach, m/s.
constexpr double parting = 1e-3;

Vector2 heading(double angle) { return {std::cos(angle), std::sin(angle)}; }

struct Scene {
  VehicleParameters vehicle;
  PlanarMotion motion = {};
  Segment wall = {};
  double step = 0.0;

  [[nodiscard]] Outline outline() const { return Outline(vehicle); }
};

std::ostream& operator<<(std::ostream& out, const Scene& s) {
  out.precision(17);
  return out << "\nfront " << s.vehicle.massCentreToFront << " rear " << s.vehicle.massCentreToRear
             << " width " << s.vehicle.width << "\nposition (" << s.motion.position.transpose()
             << ") yaw " << s.motion.yaw << " velocity (" << s.motion.velocity.transpose()
             << ") yaw rate " << s.motion.yawRate << "\nwall (" << s.wall.start.transpose()
             << ") to (" << s.wall.end.transpose() << ") normal (" << s.wall.normal.transpose()
             << ") radius " << s.wall.radius << (s.wall.solid ? " solid" : "") << "\nstep "
             << s.step << '\n';
}

/// A point of the rectangle's edge and the direction out of it there, in the plane's axes.
struct EdgePoint {
  Vector2 point;
  double outwards;
};
EdgePoint randomEdgePoint(Random& random, const Outline& outline, const PlanarMotion& at) {
  const int side = random.below(4);
  const double x = random.uniform(-outline.rear, outline.front);
  const double y = random.uniform(-outline.halfWidth, outline.halfWidth);
  const Vector2 points[] = {
      {outline.front, y}, {x, outline.halfWidth}, {-outline.rear, y}, {x, -outline.halfWidth}};
  return {at.position + rotated(points[side], at.yaw), at.yaw + side * 0.5 * pi};
}

enum class Shape { face, end, small, post };

/// A wall that meets the outline when that is at `at`, as it were: by a corner at a long face, by
/// its end, by any point of a short one, by the round of a post.
Segment wallMeeting(Random& random, Shape shape, const Outline& outline, const PlanarMotion& at) {
  Segment wall;
  const EdgePoint edge = randomEdgePoint(random, outline, at);
  if (shape == Shape::post) {
    wall.radius = std::pow(10.0, random.uniform(-2.0, 0.3));
    wall.start = wall.end = edge.point + wall.radius * heading(edge.outwards);
    return wall;
  }
  Vector2 along;
  switch (shape) {
    case Shape::face: {
      const Vector2 normal = heading(random.uniform(-pi, pi));
      double lowest = std::numeric_limits<double>::infinity();
      Vector2 corner = Vector2::Zero();
      for (const Vector2& c : outline.corners()) {
        if (normal.dot(rotated(c, at.yaw)) >= lowest) continue;
        lowest = normal.dot(rotated(c, at.yaw));
        corner = rotated(c, at.yaw);
      }
      along = turnedLeft(normal);
      wall.start = at.position + corner - random.uniform(0.5, 30.0) * along;
      wall.end = at.position + corner + random.uniform(0.5, 30.0) * along;
      break;
    }
    case Shape::end:
      along = heading(edge.outwards + random.uniform(-1.5, 1.5));
      wall.start = edge.point;
      wall.end = edge.point + std::pow(10.0, random.uniform(-1.0, 1.5)) * along;
      break;
    default: {
      along = heading(random.uniform(-pi, pi));
      const double length = std::pow(10.0, random.uniform(-3.0, 0.5));
      wall.start = edge.point - random.uniform(0.0, length) * along;
      wall.end = wall.start + length * along;
      break;
    }
  }
  if (random.chance(0.5)) std::swap(wall.start, wall.end);
  wall.normal = random.sign() * turnedLeft(along);
  return wall;
}

PlanarMotion randomMotion(Random& random) {
  PlanarMotion motion;
  motion.position = {random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0)};
  motion.yaw = random.uniform(-pi, pi);
  if (!random.chance(0.05)) {
    const double speed =
        random.chance(0.5) ? random.uniform(0.0, 120.0) : std::pow(10.0, random.uniform(-2.0, 2.0));
    motion.velocity = speed * heading(random.uniform(-pi, pi));
  }
  if (!random.chance(0.1)) motion.yawRate = random.sign() * random.uniform(0.0, 20.0);
  return motion;
}

/// A step in which the outline probably meets the wall, somewhere.
Scene randomScene(Random& random, Shape shape) {
  Scene scene{.vehicle = randomVehicle(random), .motion = randomMotion(random)};
  scene.step = std::pow(10.0, random.uniform(-4.0, std::log10(0.05)));
  const PlanarMotion at = advanced(scene.motion, random.uniform(0.0, 1.3) * scene.step);
  scene.wall = wallMeeting(random, shape, scene.outline(), at);
  return scene;
}

/// What became of many scenes. One scene that fails does not hide the others.
struct Tally {
  int touches = 0;
  int none = 0;
  int grazes = 0;
  int undecided = 0;
  double worst = 0.0;  ///< distance by which the time of a touch is off, m
  int failures = 0;
  std::string examples;  ///< of the failures, one of each kind
  std::map<std::string, int> kinds;

  void fail(const Scene& scene, const std::string& kind, const std::string& what) {
    ++failures;
    if (kinds[kind]++ > 0) return;
    std::ostringstream text;
    text << '\n' << kind << ' ' << what << scene;
    examples += text.str();
  }
  void report() const {
    testing::Test::RecordProperty("touches", touches);
    testing::Test::RecordProperty("none", none);
    testing::Test::RecordProperty("grazes", grazes);
    testing::Test::RecordProperty("undecided", undecided);
    testing::Test::RecordProperty("worst_picometres", std::to_string(worst * 1e12));
    std::string counts;
    for (const auto& [kind, count] : kinds) counts += std::to_string(count) + ' ' + kind + '\n';
    EXPECT_EQ(failures, 0) << counts << examples;
  }
};

std::string number(Real value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// The library's time against the oracle's: touching there, no touch before, and none left out.
void compare(const Scene& s, const FirstTouch& touch, double time, double from, double until,
             Tally& tally) {
  if (touch.kind == FirstTouch::Kind::undecided) {
    ++tally.undecided;
    return;
  }
  const bool touched = touch.kind == FirstTouch::Kind::touch;
  if (time == never) {
    if (!touched) {
      ++tally.none;
    } else if (deepestIn(s.outline(), s.motion, s.wall, touch.time, until) > exact) {
      tally.fail(s, "missed", "at " + number(touch.time) + ", approach " + number(touch.approach));
    } else {
      ++tally.grazes;
    }
    return;
  }
  const auto gapAt = [&](Real t) {
    return separationAt(s.outline(), Flight(s.motion), s.wall, t).gap;
  };
  constexpr Real moment = 1e-8L;  // s
  const std::string right = "; right: " + (touched ? number(touch.time) : std::string("none"));
  const bool early = !touched || time < touch.time;
  const Real off = touched ? std::abs(time - touch.time) * touch.approach : 0.0L;
  if (time < from || time > until) {
    tally.fail(s, "outside the interval", "at " + number(time));
  } else if (touched && off <= exact) {
    ++tally.touches;
    tally.worst = std::max(tally.worst, static_cast<double>(off));
  } else if (early && gapAt(time) > exact) {
    tally.fail(s, "invented", "at " + number(time) + ", off by " + number(gapAt(time)) + right);
  } else if (early && (gapAt(time + moment) - gapAt(time)) / moment > parting) {
    tally.fail(s, "parting", "at " + number(time) + right);
  } else if (!early && deepestIn(s.outline(), s.motion, s.wall, touch.time, time) > exact) {
    tally.fail(s, "late", "at " + number(time) + right + ", approach " + number(touch.approach));
  } else {
    ++tally.grazes;  // it hardly went in, or hardly left, between the two
  }
}

struct Kind {
  const char* name;
  Shape shape;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class Sweep : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(Walls, Sweep,
                         testing::Values(Kind{"face", Shape::face}, Kind{"end", Shape::end},
                                         Kind{"small", Shape::small}, Kind{"post", Shape::post}),
                         [](const auto& kind) { return std::string(kind.param.name); });

constexpr int cases = 20'000;

TEST_P(Sweep, FindsTheFirstTouchAndInventsNone) {
  Random random(801);
  Tally tally;
  for (int i = 0; i < cases;) {
    const Scene s = randomScene(random, GetParam().shape);
    if (separationAt(s.outline(), Flight(s.motion), s.wall, 0.0L).gap < clear) continue;
    ++i;
    const FirstTouch touch = firstTouch(s.outline(), s.motion, s.wall, 0.0L, s.step, Start::apart);
    const double time =
        bumper::Sweep(s.outline(), s.motion).timeOfTouch(s.wall, nullptr, 0.0, s.step);
    compare(s, touch, time, 0.0, s.step, tally);
  }
  tally.report();
  EXPECT_GT(tally.touches, cases / 3);
  EXPECT_GT(tally.none, cases / 20);
  EXPECT_LT(tally.grazes + tally.undecided, cases / 100);
}

/// The scene after an impact at the time of touch: what touched flies apart. The motion is again
/// the one that the vehicle would have had at the step's start.
Scene afterImpact(Random& random, Scene s, const FirstTouch& touch, double time) {
  s.motion = advanced(s.motion, time);
  const Vector2 normal = touch.at.normal.cast<double>();
  const Vector2 arm = touch.at.arm.cast<double>();
  const double restitution = random.uniform(0.0, 1.0);
  const double lever = cross(arm, normal);
  const double mobility = 1.0 / s.vehicle.mass + lever * lever / s.vehicle.yawInertia;
  // Never slower than this, m/s: what slides is another matter.
  const double speed = std::max(0.01, restitution * static_cast<double>(touch.approach));
  const double strength = (speed - velocityAt(s.motion, arm).dot(normal)) / mobility;
  s.motion = afterImpulse(s.motion, {.linear = strength * normal, .angular = strength * lever},
                          s.vehicle.mass, s.vehicle.yawInertia);
  s.motion = advanced(s.motion, -time);
  return s;
}

TEST_P(Sweep, FindsTheNextTouchAfterAnImpact) {
  Random random(802);
  Tally tally;
  for (int i = 0; i < cases;) {
    Scene s = randomScene(random, GetParam().shape);
    if (separationAt(s.outline(), Flight(s.motion), s.wall, 0.0L).gap < clear) continue;
    const FirstTouch touch = firstTouch(s.outline(), s.motion, s.wall, 0.0L, s.step, Start::apart);
    if (touch.kind != FirstTouch::Kind::touch || touch.approach < 0.01L) continue;
    const auto time = static_cast<double>(touch.time);
    s = afterImpact(random, s, touch, time);
    // Mostly the car flies off; give it time to turn and come back.
    s.step = time + std::pow(10.0, random.uniform(-3.0, -1.0));
    const PlanarMotion at = advanced(s.motion, time);
    const std::optional<Overlap> overlap = findTouch(s.outline(), at.placement(), s.wall);
    if (!overlap) {
      tally.fail(s, "no touch", "at " + number(time));
      ++i;
      continue;
    }
    ++i;
    const FirstTouch next =
        firstTouch(s.outline(), s.motion, s.wall, time, s.step, Start::touching);
    compare(s, next,
            bumper::Sweep(s.outline(), s.motion).timeOfTouch(s.wall, &*overlap, time, s.step), time,
            s.step, tally);
  }
  tally.report();
  EXPECT_GT(tally.touches, cases / 20);
  EXPECT_GT(tally.none, cases / 20);
  EXPECT_LT(tally.grazes + tally.undecided, cases / 100);
}

// A wall that is solid behind its normal answers in front and lets through from behind.
TEST(SolidWall, IsHitFromTheFrontOnly) {
  Random random(803);
  Tally tally;
  int front = 0, back = 0;
  for (int i = 0; i < cases;) {
    Scene s = randomScene(random, random.chance(0.5) ? Shape::face : Shape::end);
    s.wall.solid = true;
    if (separationAt(s.outline(), Flight(s.motion), s.wall, 0.0L).gap < clear) continue;
    ++i;
    const FirstTouch touch = firstTouch(s.outline(), s.motion, s.wall, 0.0L, s.step, Start::apart);
    const double time =
        bumper::Sweep(s.outline(), s.motion).timeOfTouch(s.wall, nullptr, 0.0, s.step);
    const Real facing = touch.at.normal.dot(s.wall.normal.cast<Real>());
    if (touch.kind == FirstTouch::Kind::touch && facing < -aslant) {
      // It goes in from behind. That is no touch, nor does anything of the sort come before.
      ++back;
      if (time < touch.time - exact) tally.fail(s, "invented", "at " + number(time));
      for (const Real t : {touch.time, std::min<Real>(time, s.step)}) {
        const PlanarMotion at = advanced(s.motion, static_cast<double>(t));
        const std::optional<Overlap> overlap = findTouch(s.outline(), at.placement(), s.wall);
        if (overlap && overlap->normal.dot(s.wall.normal) < -aslant) {
          tally.fail(s, "hit from behind", "at " + number(t));
        }
      }
      continue;
    }
    front += touch.kind == FirstTouch::Kind::touch ? 1 : 0;
    compare(s, touch, time, 0.0, s.step, tally);
  }
  tally.report();
  EXPECT_GT(front, cases / 5);
  EXPECT_GT(back, cases / 5);
}

// Degenerate cases: the answer can be written down.

/// A vehicle at a place and heading of no meaning, and walls in its own frame.
struct Placed {
  VehicleParameters vehicle;
  Outline outline;
  PlanarMotion motion;

  explicit Placed(Random& random) : vehicle(randomVehicle(random)), outline(vehicle) {
    motion.position = {random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0)};
    motion.yaw = random.uniform(-pi, pi);
  }
  [[nodiscard]] Vector2 place(const Vector2& local) const {
    return motion.position + rotated(local, motion.yaw);
  }
  [[nodiscard]] Segment wall(const Vector2& start, const Vector2& end) const {
    Segment wall;
    wall.start = place(start);
    wall.end = place(end);
    const Vector2 along = wall.end - wall.start;
    if (along != Vector2::Zero()) wall.normal = turnedLeft(along.normalized());
    return wall;
  }
  [[nodiscard]] Segment post(const Vector2& centre, double radius) const {
    Segment wall = this->wall(centre, centre);
    wall.radius = radius;
    return wall;
  }
  /// Velocity in the vehicle's own frame.
  void move(const Vector2& velocity, double yawRate) {
    motion.velocity = rotated(velocity, motion.yaw);
    motion.yawRate = yawRate;
  }
  [[nodiscard]] std::optional<Overlap> touch(const Segment& wall) const {
    return findTouch(outline, motion.placement(), wall);
  }
  [[nodiscard]] double time(const Segment& wall, double until) const {
    const std::optional<Overlap> overlap = touch(wall);
    return bumper::Sweep(outline, motion)
        .timeOfTouch(wall, overlap ? &*overlap : nullptr, 0.0, until);
  }
};

/// A wall before the front, behind the rear, or beside either side of the outline, parallel to it
/// and `distance` away; and the direction towards it, in the vehicle's frame.
std::pair<Segment, Vector2> wallAlong(const Placed& p, int side, double distance, double from,
                                      double to) {
  const double reach[] = {p.outline.front, p.outline.halfWidth, p.outline.rear,
                          p.outline.halfWidth};
  const Vector2 out = rotated({1.0, 0.0}, side * 0.5 * pi);
  const Vector2 middle = (reach[side] + distance) * out;
  return {p.wall(middle + from * turnedLeft(out), middle + to * turnedLeft(out)), out};
}

TEST(Degenerate, WhatDoesNotMoveTouchesNothing) {
  Random random(810);
  for (int i = 0; i < cases; ++i) {
    Placed p(random);
    const auto [wall, out] =
        wallAlong(p, random.below(4), random.chance(0.3) ? 0.0 : random.uniform(-0.5, 0.5),
                  random.uniform(-9.0, -3.0), random.uniform(-0.5, 9.0));
    ASSERT_EQ(p.time(wall, 0.05), never) << i;
    ASSERT_EQ(p.time(p.post({p.outline.front + random.uniform(-0.1, 0.6), 0.0}, 0.5), 0.05), never)
        << i;
  }
}

TEST(Degenerate, AFlushWallIsMetBySpeedAndDistance) {
  Random random(811);
  for (int i = 0; i < cases; ++i) {
    Placed p(random);
    const double distance = std::pow(10.0, random.uniform(-6.0, 1.0));
    const double speed = std::pow(10.0, random.uniform(-2.0, 2.08));
    // Long, or shorter than the side.
    const double half = random.chance(0.5) ? 50.0 : 0.5;
    const auto [wall, out] = wallAlong(p, random.below(4), distance, -half, half);
    // It stays beside the wall meanwhile.
    const double slip = half > 1.0 ? random.uniform(-20.0, 20.0) / (2.0 * distance / speed) : 0.0;
    p.move(speed * out + slip * turnedLeft(out), 0.0);
    const double expected = distance / speed;
    const double time = p.time(wall, 2.0 * expected);
    ASSERT_NEAR(time * speed, distance, exact) << i;
    ASSERT_EQ(p.time(wall, 0.999 * expected),
              expected > 1e-6 ? never : p.time(wall, 0.999 * expected));
    p.move(-speed * out + slip * turnedLeft(out), 0.0);
    ASSERT_EQ(p.time(wall, 2.0 * expected), never) << i;
  }
}

TEST(Degenerate, TouchingAndClosingIsATouchAtOnce) {
  Random random(812);
  for (int i = 0; i < cases; ++i) {
    Placed p(random);
    const auto [wall, out] =
        wallAlong(p, random.below(4), random.uniform(-0.5, 0.5) * touchTolerance, -3.0, 3.0);
    ASSERT_TRUE(p.touch(wall).has_value()) << i;
    const double speed = random.uniform(0.01, 100.0), slip = random.uniform(-100.0, 100.0);
    p.move(speed * out + slip * turnedLeft(out), 0.0);
    ASSERT_NEAR(p.time(wall, 0.001) * speed, 0.0, exact) << i;
    // … and leaving is none, along whatever it leaves.
    p.move(-speed * out + slip * turnedLeft(out), 0.0);
    ASSERT_EQ(p.time(wall, 0.001), never) << i;
  }
}

TEST(Degenerate, MotionAlongAWallTouchesNothing) {
  Random random(813);
  for (int i = 0; i < cases; ++i) {
    Placed p(random);
    const double distance = random.chance(0.5) ? 0.0 : std::pow(10.0, random.uniform(-8.0, -1.0));
    const auto [wall, out] = wallAlong(p, random.below(4), distance, -60.0, 60.0);
    p.move(random.uniform(-120.0, 120.0) * turnedLeft(out), 0.0);
    // Rounding may make it close, by far less than a touch.
    const double time = p.time(wall, 0.05);
    ASSERT_EQ(time, never) << i << " distance " << distance;
  }
}

TEST(Degenerate, APureTurnMeetsTheWallByAnArcCosine) {
  Random random(814);
  int met = 0;
  for (int i = 0; i < cases; ++i) {
    Placed p(random);
    // Front left corner, on its circle, and a wall ahead at a distance that it reaches.
    const Vector2 corner(p.outline.front, p.outline.halfWidth);
    const double radius = corner.norm(), start = std::atan2(corner.y(), corner.x());
    const double distance = random.uniform(corner.x() + 1e-6, radius - 1e-4);
    const Segment wall = p.wall({distance, -50.0}, {distance, 50.0});
    // Turning right: this corner comes round to the wall.
    const double rate = random.uniform(0.1, 20.0);
    p.move({0.0, 0.0}, -rate);
    const double expected = (start - std::acos(distance / radius)) / rate;
    ASSERT_NEAR(
        (p.time(wall, 10.0) - expected) * rate * std::sqrt(radius * radius - distance * distance),
        0.0, exact)
        << i;
    ++met;
  }
  EXPECT_EQ(met, cases);
}

// A wall without length is a point: its ends are.
TEST(Degenerate, AWallWithoutLengthIsMetAsAPoint) {
  Random random(815);
  Tally tally;
  for (int i = 0; i < cases;) {
    Scene s = randomScene(random, Shape::end);
    s.wall.end = s.wall.start;
    if (separationAt(s.outline(), Flight(s.motion), s.wall, 0.0L).gap < clear) continue;
    ++i;
    const FirstTouch touch = firstTouch(s.outline(), s.motion, s.wall, 0.0L, s.step, Start::apart);
    compare(s, touch,
            bumper::Sweep(s.outline(), s.motion).timeOfTouch(s.wall, nullptr, 0.0, s.step), 0.0,
            s.step, tally);
  }
  tally.report();
  EXPECT_GT(tally.touches, cases / 5);
}

// 6 m of flight in one step at walls of a millimetre: their length, or the way from one face to the
// other.
TEST(Degenerate, AMillimetreIsNotMissedAtTopSpeed) {
  Random random(816);
  Tally tally;
  for (int i = 0; i < cases;) {
    Scene s{.vehicle = randomVehicle(random), .motion = randomMotion(random), .step = 0.05};
    s.motion.velocity = 120.0 * heading(random.uniform(-pi, pi));
    const double fraction = random.uniform(0.0, 1.0);
    s.wall = wallMeeting(random, Shape::end, s.outline(), advanced(s.motion, fraction * s.step));
    s.wall.end = s.wall.start + 0.001 * (s.wall.end - s.wall.start).normalized();
    if (separationAt(s.outline(), Flight(s.motion), s.wall, 0.0L).gap < clear) continue;
    ++i;
    const FirstTouch touch = firstTouch(s.outline(), s.motion, s.wall, 0.0L, s.step, Start::apart);
    compare(s, touch,
            bumper::Sweep(s.outline(), s.motion).timeOfTouch(s.wall, nullptr, 0.0, s.step), 0.0,
            s.step, tally);
  }
  tally.report();
  EXPECT_GT(tally.touches, cases / 2);
}

/// The scene in a mirror that turns left into right, or in a frame turned by `angle`.
Vector2 flipped(const Vector2& v) { return {v.x(), -v.y()}; }
Scene mirrored(Scene s) {
  for (Vector2* v :
       {&s.motion.position, &s.motion.velocity, &s.wall.start, &s.wall.end, &s.wall.normal})
    *v = flipped(*v);
  s.motion.yaw = -s.motion.yaw;
  s.motion.yawRate = -s.motion.yawRate;
  return s;
}
Scene turned(Scene s, double angle) {
  for (Vector2* v :
       {&s.motion.position, &s.motion.velocity, &s.wall.start, &s.wall.end, &s.wall.normal})
    *v = rotated(*v, angle);
  s.motion.yaw += angle;
  return s;
}

TEST_P(Sweep, TheFrameDoesNotMatter) {
  Random random(820);
  int touches = 0;
  for (int i = 0; i < cases; ++i) {
    Scene s = randomScene(random, GetParam().shape);
    s.wall.solid = random.chance(0.3) && !s.wall.isPost();
    if (separationAt(s.outline(), Flight(s.motion), s.wall, 0.0L).gap < clear) continue;
    const auto time = [](const Scene& scene) {
      return bumper::Sweep(scene.outline(), scene.motion)
          .timeOfTouch(scene.wall, nullptr, 0.0, scene.step);
    };
    const double angle = random.uniform(-pi, pi);
    const double expected = time(s), mirror = time(mirrored(s)), turn = time(turned(s, angle));
    if (expected == never || mirror == never || turn == never) {
      // All or none; but the rounding of a turned frame may decide a graze.
      const FirstTouch touch =
          firstTouch(s.outline(), s.motion, s.wall, 0.0L, s.step, Start::apart);
      const bool graze = touch.kind != FirstTouch::Kind::touch
                             ? touch.nearest < exact
                             : deepestIn(s.outline(), s.motion, s.wall, touch.time, s.step) < exact;
      ASSERT_TRUE(graze || (expected == never && mirror == never && turn == never))
          << i << ' ' << expected << ' ' << mirror << ' ' << turn << s;
      continue;
    }
    ++touches;
    const Real fastest = Flight(s.motion).fastest(s.outline());
    ASSERT_NEAR(static_cast<double>((expected - mirror) * fastest), 0.0, exact) << i << s;
    ASSERT_NEAR(static_cast<double>((expected - turn) * fastest), 0.0, 1e3 * exact) << i << s;
  }
  EXPECT_GT(touches, cases / 5);
}

// findTouch()

/// A wall in, on or just off an outline.
Scene randomTouch(Random& random, Shape shape) {
  Scene s{.vehicle = randomVehicle(random)};
  s.motion.position = {random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0)};
  s.motion.yaw = random.uniform(-pi, pi);
  s.wall = wallMeeting(random, shape, s.outline(), s.motion);
  const double apart = random.chance(0.2)
                           ? random.uniform(-3.0, 3.0) * touchTolerance
                           : std::pow(10.0, random.uniform(-8.0, -0.5)) * random.sign();
  s.motion.position += apart * heading(random.uniform(-pi, pi));
  return s;
}

TEST_P(Sweep, TouchIsTheShortestWayOut) {
  Random random(830);
  int touching = 0, apart = 0;
  Tally tally;
  for (int i = 0; i < cases; ++i) {
    const Scene s = randomTouch(random, GetParam().shape);
    const Separation exactly =
        separation(s.outline(), s.motion.position.cast<Real>(), s.motion.yaw, s.wall);
    const std::optional<Overlap> touch = findTouch(s.outline(), s.motion.placement(), s.wall);
    if (std::abs(exactly.gap - touchTolerance) < position) continue;
    if (touch.has_value() != (exactly.gap < touchTolerance)) {
      tally.fail(s, "touch or none",
                 "gap " + number(exactly.gap) + (touch ? " touch" : " no touch"));
      continue;
    }
    if (!touch) {
      ++apart;
      continue;
    }
    ++touching;
    // An end that has slid into a side which lies along the wall: then the face counts.
    const Vector2 across = rotated(s.wall.normal, -s.motion.yaw);
    if (!touch->byEnd && exactly.alongSide &&
        std::min(std::abs(across.x()), std::abs(across.y())) < 0.09) {
      continue;
    }
    if (std::abs(touch->depth + exactly.gap) > position) {
      // Outside, a corner off an end is as near as neither direction says.
      if (exactly.gap > 0.0L) continue;
      tally.fail(s, "depth",
                 number(touch->depth) + (touch->byEnd ? " by end" : " by face") + " instead of " +
                     number(-exactly.gap) +
                     (exactly.alongSide ? " along a side" : " along the face") + ", second " +
                     number(exactly.secondDepth));
      continue;
    }
    if (exactly.gap > -1e-7L || exactly.secondDepth + exactly.gap < 1e-7L) continue;
    const double turn =
        1e-13 / (s.wall.isPost() ? 1e-7 : (s.wall.end - s.wall.start).norm()) + 1e-14;
    if (bumper::tests::apart(touch->normal, exactly.normal) > turn)
      tally.fail(s, "normal",
                 "off by " + number(bumper::tests::apart(touch->normal, exactly.normal)));
    if (touch->byEnd != (exactly.alongSide || s.wall.isPost())) tally.fail(s, "by end or not", "");
  }
  tally.report();
  EXPECT_GT(touching, cases / 5);
  EXPECT_GT(apart, cases / 20);
}

}  // namespace
}  // namespace bumper::tests
