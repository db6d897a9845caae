#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "bumper/response/collision_step.h"
#include "sweep_oracle.h"

/// Whole steps: what happens between the impacts is free flight that touches nothing.
namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;

// Positions lie up to 100 m from the origin; a few dozen flights one after the other, m and m/s.
constexpr double rounding = 1e-9;

// How deep an end of a wall can get into a side that turns past it between two of the looks that
// CollisionStep takes at what slides, twelve in a step, m; of the fastest motion with the energy
// that there is.
double slidingDepth(const VehicleParameters& vehicle, const PlanarMotion& motion, double h) {
  constexpr double touch = 1e-5;  // m
  constexpr double looks = 4.0;   // what one leaves the next may find
  const double energy = 2.0 * yawPlaneEnergy(motion, vehicle.mass, vehicle.yawInertia);
  const double yawRate = std::sqrt(energy / vehicle.yawInertia);
  const double radius = std::hypot(std::max(vehicle.massCentreToFront, vehicle.massCentreToRear),
                                   0.5 * vehicle.width);
  const double acceleration = yawRate * (std::sqrt(energy / vehicle.mass) + yawRate * radius);
  return touch + looks * 0.5 * acceleration * (h / 12.0) * (h / 12.0);
}

Vector2 heading(double angle) { return {std::cos(angle), std::sin(angle)}; }

double energyOf(const VehicleParameters& vehicle, const PlanarMotion& motion) {
  return yawPlaneEnergy(motion, vehicle.mass, vehicle.yawInertia);
}

struct Scene {
  VehicleParameters vehicle;
  PlanarMotion motion = {};
  Surface surface = {};
  std::vector<Segment> walls = {};
  double step = 0.0;

  [[nodiscard]] CollisionStep::Walls all() const { return {walls, {&surface, 1}}; }
  [[nodiscard]] Outline outline() const { return Outline(vehicle); }
  [[nodiscard]] Real gapAt(const PlanarMotion& flight, const Segment& wall, double time) const {
    return separationAt(outline(), Flight(flight), wall, time).gap;
  }
};

std::ostream& operator<<(std::ostream& out, const Scene& s) {
  out.precision(17);
  out << "\nmass " << s.vehicle.mass << " yaw inertia " << s.vehicle.yawInertia << " front "
      << s.vehicle.massCentreToFront << " rear " << s.vehicle.massCentreToRear << " width "
      << s.vehicle.width << "\nposition (" << s.motion.position.transpose() << ") yaw "
      << s.motion.yaw << " velocity (" << s.motion.velocity.transpose() << ") yaw rate "
      << s.motion.yawRate << " step " << s.step << '\n';
  for (const Segment& wall : s.walls) {
    out << "wall " << wall.id << " (" << wall.start.transpose() << ") to (" << wall.end.transpose()
        << ") normal (" << wall.normal.transpose() << ") radius " << wall.radius
        << (wall.solid ? " solid\n" : "\n");
  }
  return out;
}

ResponseSettings randomSettings(Random& random) {
  ResponseSettings settings;
  if (random.chance(0.3)) return settings;
  settings.law = random.chance(0.3) ? Law::energy : Law::restitution;
  settings.restitution = AngleCurve::constant(randomRestitution(random));
  settings.friction = AngleCurve::constant(randomFriction(random));
  settings.penetrationTime = random.chance(0.3) ? 0.0 : random.uniform(0.0, 0.01);
  return settings;
}

PlanarMotion randomMotion(Random& random) {
  PlanarMotion motion;
  motion.position = {random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0)};
  motion.yaw = random.uniform(-pi, pi);
  motion.velocity = random.uniform(0.5, 60.0) * heading(random.uniform(-pi, pi));
  motion.yawRate = random.chance(0.2) ? 0.0 : random.uniform(-8.0, 8.0);
  return motion;
}

/// A wall or a post in the vehicle's way: anything from a millimetre to 20 m before it.
Segment wallInTheWay(Random& random, const Scene& s, int id) {
  const PlanarMotion at = advanced(s.motion, random.uniform(0.0, 1.0) * s.step);
  const Vector2 ahead = s.motion.velocity.normalized();
  double reach = 0.0;
  for (const Vector2& corner : s.outline().corners()) {
    reach = std::max(reach, ahead.dot(rotated(corner, at.yaw)));
  }
  const Vector2 middle =
      at.position + reach * ahead + random.uniform(-1.0, 1.0) * turnedLeft(ahead);
  Segment wall{.id = id};
  if (random.chance(0.2)) {
    wall.radius = random.uniform(0.05, 0.5);
    wall.start = wall.end = middle + wall.radius * ahead;
    return wall;
  }
  const Vector2 along = rotated(turnedLeft(ahead), random.uniform(-1.4, 1.4));
  wall.start = middle - std::pow(10.0, random.uniform(-1.0, 1.3)) * along;
  wall.end = middle + std::pow(10.0, random.uniform(-1.0, 1.3)) * along;
  wall.normal = turnedLeft(along);
  if (wall.normal.dot(s.motion.position - wall.start) < 0.0) wall.normal = -wall.normal;
  wall.solid = random.chance(0.3);
  return wall;
}

/// A vehicle that is clear of all walls, some of which stand in its way.
Scene randomScene(Random& random, int mostWalls, const ResponseSettings& settings) {
  while (true) {
    Scene s{.vehicle = randomVehicle(random),
            .motion = randomMotion(random),
            .surface = {.settings = &settings}};
    s.step = std::pow(10.0, random.uniform(-3.3, std::log10(0.05)));
    for (int k = 1 + random.below(mostWalls); k > 0; --k) {
      s.walls.push_back(wallInTheWay(random, s, k));
    }
    if (std::ranges::all_of(
            s.walls, [&](const Segment& wall) { return s.gapAt(s.motion, wall, 0.0) > 1e-3L; })) {
      return s;
    }
  }
}

/// What happens in the step according to its impacts.
struct Replay {
  PlanarMotion after = {};
  PlanarMotion atLastImpact = {};
  double deepest = 0.0;           ///< in any wall that is not solid, m
  double farthestHit = 0.0;       ///< from its wall at the time of an impact, m
  double mostEnergyGained = 0.0;  ///< in an impact, as a share
  bool inOrder = true;
};

Replay replay(const Scene& s, const StepOutcome& outcome) {
  Replay result;
  PlanarMotion now = s.motion;
  double time = 0.0;
  const auto fly = [&](double until) {
    if (until < time) result.inOrder = false;
    for (const Segment& wall : s.walls) {
      if (wall.solid) continue;  // lets through what comes from behind
      constexpr int looks = 12;
      for (int k = 0; k <= looks; ++k) {
        const Separation at =
            separationAt(s.outline(), Flight(now), wall, (until - time) * k / looks);
        result.deepest = std::max(result.deepest, static_cast<double>(-at.gap));
      }
    }
    now = advanced(now, until - time);
    time = until;
  };
  for (const StepImpact& impact : outcome.impacts) {
    fly(impact.time);
    const auto wall = std::ranges::find(s.walls, impact.impact.wall, &Segment::id);
    result.farthestHit =
        std::max(result.farthestHit, static_cast<double>(s.gapAt(now, *wall, 0.0)));
    const double before = energyOf(s.vehicle, now);
    now = afterImpulse(now, impact.response.impulse, s.vehicle.mass, s.vehicle.yawInertia);
    result.mostEnergyGained =
        std::max(result.mostEnergyGained, energyOf(s.vehicle, now) / before - 1.0);
  }
  result.atLastImpact = now;
  fly(s.step);
  result.after = now;
  return result;
}

TEST(SweptStep, WithoutATouchIsFreeFlight) {
  Random random(901);
  CollisionStep step;
  const ResponseSettings settings;
  int free = 0;
  while (free < 20'000) {
    Scene s = randomScene(random, 4, settings);
    s.motion.velocity = -s.motion.velocity;  // mostly away from them
    const bool touches = std::ranges::any_of(s.walls, [&](const Segment& wall) {
      return firstTouch(s.outline(), s.motion, wall, 0.0L, s.step, Start::apart).kind !=
             FirstTouch::Kind::none;
    });
    if (touches) continue;
    ++free;
    const StepOutcome outcome = step.resolve(s.vehicle, s.motion, s.all(), s.step);
    const PlanarMotion expected = advanced(s.motion, s.step);
    ASSERT_TRUE(outcome.impacts.empty()) << s;
    ASSERT_TRUE(outcome.settled);
    ASSERT_EQ(outcome.impulse.linear, Vector2::Zero());
    ASSERT_EQ(outcome.impulse.angular, 0.0);
    ASSERT_EQ(outcome.shift.velocity, Vector2::Zero());
    ASSERT_EQ(outcome.shift.yawRate, 0.0);
    ASSERT_EQ(outcome.after.velocity, s.motion.velocity);
    ASSERT_EQ(outcome.after.yawRate, s.motion.yawRate);
    ASSERT_NEAR((outcome.after.position - expected.position).norm(), 0.0, rounding) << s;
    ASSERT_NEAR(outcome.after.yaw, expected.yaw, rounding) << s;
  }
}

TEST(SweptStep, ImpactsAndFreeFlightBetweenThemAreTheStep) {
  Random random(902);
  CollisionStep step;
  int hit = 0, several = 0, tooDeep = 0, elsewhere = 0;
  double deepest = 0.0;
  std::ostringstream examples;
  for (int i = 0; i < 20'000; ++i) {
    const ResponseSettings settings = randomSettings(random);
    const Scene s = randomScene(random, 4, settings);
    const StepOutcome outcome = step.resolve(s.vehicle, s.motion, s.all(), s.step);
    ASSERT_TRUE(isFinite(outcome.after)) << s;
    const Replay expected = replay(s, outcome);
    ASSERT_TRUE(expected.inOrder) << i << s;
    ASSERT_LE(expected.mostEnergyGained, 1e-9) << i << s;
    ASSERT_LE(energyOf(s.vehicle, outcome.after), energyOf(s.vehicle, s.motion) * (1.0 + 1e-12))
        << i << s;
    ASSERT_NEAR((outcome.after.velocity - expected.after.velocity).norm(), 0.0, rounding) << i << s;
    ASSERT_NEAR(outcome.after.yawRate, expected.after.yawRate, rounding) << i << s;
    hit += outcome.impacts.empty() ? 0 : 1;
    several += outcome.impacts.size() > 1 ? 1 : 0;
    if (!outcome.settled) continue;
    const Vector2 eased = s.step * outcome.shift.velocity;
    ASSERT_NEAR((outcome.after.position - expected.after.position - eased).norm(), 0.0, rounding)
        << i << s;
    ASSERT_NEAR(outcome.after.yaw, expected.after.yaw, rounding) << i << s;
    deepest = std::max(deepest, expected.deepest);
    // What is exposed by less than a smallest feature in front of another wall does not catch.
    const double feature =
        settings.smallestFeature * (s.vehicle.massCentreToFront + s.vehicle.massCentreToRear);
    if (expected.deepest > feature + slidingDepth(s.vehicle, s.motion, s.step) && tooDeep++ < 2) {
      examples << i << ": " << expected.deepest << " m deep" << s;
    }
    if (expected.farthestHit > 10.0 * touchTolerance && elsewhere++ < 2) {
      examples << i << ": " << expected.farthestHit << " m from the wall that is named" << s;
    }
  }
  EXPECT_EQ(tooDeep, 0) << "deepest " << deepest << " m\n" << examples.str();
  EXPECT_EQ(elsewhere, 0) << examples.str();
  EXPECT_GT(hit, 5'000);
  EXPECT_GT(several, 500);
}

// Steps with one impact: cut anywhere, before it or after it, they end in the same place. An end
// that slides along a side is answered at times of its own in each step.
// An application's mesh is in single precision, so the pieces of one wall lie a little off each
// other's line, each with a normal of its own. Whatever way the vehicle comes, it is stopped.
TEST(SweptStep, AWallOfPiecesThatAreNotQuiteInLineIsHit) {
  Random random(31);
  const ResponseSettings settings;
  const Surface surface{.settings = &settings};
  CollisionStep collision;
  int impacts = 0;
  for (int i = 0; i < 3'000; ++i) {
    const double off = std::pow(10.0, random.uniform(-9.0, -4.4));
    const VehicleParameters vehicle = randomVehicle(random);
    const double angle = random.chance(0.5) ? 0.0 : random.uniform(-0.5, 0.5);
    const double step = random.uniform(0.001, 0.02);
    const double speed = random.uniform(1.0, 40.0);
    // Of the outline's foremost point from the wall, at x = 0, which is reached within the step.
    const double distance = random.uniform(0.0, 0.9) * speed * step;
    const Outline outline(vehicle);
    double reach = 0.0;
    for (const Vector2& corner : outline.corners()) {
      reach = std::max(reach, rotated(corner, angle).x());
    }
    PlanarMotion motion;
    motion.position.x() = -distance - reach;
    motion.yaw = angle;
    motion.velocity = {speed, 0.0};
    motion.yawRate = random.chance(0.5) ? 0.0 : random.uniform(-1e-3, 1e-3);

    std::vector<Segment> walls;
    for (double y = -6.0; y < 6.0;) {
      const double length = random.uniform(0.05, 1.5);
      const Vector2 start(random.uniform(0.0, off), y);
      const Vector2 end(random.uniform(0.0, off), y + length);
      walls.push_back({.start = start,
                       .end = end,
                       .normal = turnedLeft((end - start).normalized()),
                       .id = static_cast<int>(walls.size())});
      y += length;
    }
    const StepOutcome outcome = collision.resolve(vehicle, motion, {walls, {&surface, 1}}, step);
    impacts += outcome.impacts.empty() ? 0 : 1;
    double deepest = -1.0;
    for (const Vector2& corner : outline.corners()) {
      deepest =
          std::max(deepest, (outcome.after.position + rotated(corner, outcome.after.yaw)).x());
    }
    ASSERT_LE(deepest, off + 1e-6)
        << i << ": off " << off << ", angle " << angle << ", speed " << speed << ", step " << step;
  }
  EXPECT_EQ(impacts, 3'000);
}

TEST(SweptStep, TwoHalvesAreTheWhole) {
  Random random(903);
  CollisionStep step;
  int compared = 0, slid = 0;
  for (int i = 0; i < 30'000; ++i) {
    const ResponseSettings settings = randomSettings(random);
    const Scene s = randomScene(random, 1, settings);
    const StepOutcome outcome = step.resolve(s.vehicle, s.motion, s.all(), s.step);
    if (outcome.impacts.size() != 1 || !outcome.settled) continue;
    const PlanarMotion whole = outcome.after;
    const double first = random.uniform(0.05, 0.95) * s.step;
    const StepOutcome early = step.resolve(s.vehicle, s.motion, s.all(), first);
    std::size_t impacts = early.impacts.size();
    const PlanarMotion between = early.after;
    const StepOutcome late = step.resolve(s.vehicle, between, s.all(), s.step - first);
    impacts += late.impacts.size();
    if (impacts > 1) {
      ++slid;
      continue;
    }
    ++compared;
    ASSERT_EQ(impacts, 1U) << i << s;
    ASSERT_NEAR((late.after.position - whole.position).norm(), 0.0, rounding) << i << s;
    ASSERT_NEAR(late.after.yaw, whole.yaw, rounding) << i << s;
    ASSERT_NEAR((late.after.velocity - whole.velocity).norm(), 0.0, rounding) << i << s;
    ASSERT_NEAR(late.after.yawRate, whole.yawRate, rounding) << i << s;
  }
  EXPECT_GT(compared, 5'000);
  EXPECT_LE(slid, compared / 500);
}

/// A long wall, and a vehicle up to half a metre in it.
Scene sceneInWall(Random& random, const ResponseSettings& settings, double depth) {
  Scene s{.vehicle = randomVehicle(random),
          .motion = randomMotion(random),
          .surface = {.settings = &settings}};
  s.step = random.uniform(0.001, 0.02);
  const Vector2 normal = heading(random.uniform(-pi, pi));
  double lowest = 0.0;
  for (const Vector2& corner : s.outline().corners()) {
    lowest = std::min(lowest, normal.dot(rotated(corner, s.motion.yaw)));
  }
  const Vector2 middle = s.motion.position + (lowest + depth) * normal;
  s.walls.push_back({.start = middle - 50.0 * turnedLeft(normal),
                     .end = middle + 50.0 * turnedLeft(normal),
                     .normal = normal,
                     .id = 1});
  return s;
}

TEST(SweptStep, WhatStandsInAWallIsEasedOut) {
  Random random(904);
  CollisionStep step;
  const ResponseSettings settings;
  for (int i = 0; i < 5'000; ++i) {
    const double depth = std::pow(10.0, random.uniform(-3.0, std::log10(0.5)));
    Scene s = sceneInWall(random, settings, depth);
    const Vector2 normal = s.walls[0].normal;
    const bool rests = random.chance(0.5);
    if (rests) {
      s.motion.velocity = Vector2::Zero();
    } else {
      s.motion.velocity -= 2.0 * std::min(0.0, s.motion.velocity.dot(normal)) * normal;
    }
    s.motion.yawRate = 0.0;
    PlanarMotion now = s.motion;
    double last = depth;
    for (int k = 0; k < 200; ++k) {
      const StepOutcome outcome = step.resolve(s.vehicle, now, s.all(), s.step);
      ASSERT_TRUE(outcome.impacts.empty()) << i << s;
      ASSERT_LE(outcome.shift.velocity.norm(), CollisionStep::maxRecoverySpeed * (1.0 + 1e-12))
          << i << s;
      ASSERT_GE(outcome.shift.velocity.dot(normal), 0.0) << i << s;
      ASSERT_EQ(outcome.after.velocity, s.motion.velocity) << i << s;
      ASSERT_EQ(outcome.after.yawRate, 0.0) << i << s;
      const Vector2 moved = outcome.after.position - now.position;
      const Vector2 meant = s.step * (now.velocity + outcome.shift.velocity);
      ASSERT_NEAR((moved - meant).norm(), 0.0, rounding) << i << s;
      now = outcome.after;
      const auto deep = static_cast<double>(-s.gapAt(now, s.walls[0], 0.0));
      ASSERT_LE(deep, last + rounding) << i << s;
      last = deep;
    }
    // At first at full speed, then more and more gently.
    const double sooner = 150.0 * s.step * CollisionStep::maxRecoverySpeed;
    ASSERT_LE(last, std::max(1e-3, depth - sooner)) << i << s;
  }
}

TEST(SweptStep, WhatIsDrivenFurtherIntoAWallIsStoppedAndEasedOut) {
  Random random(905);
  CollisionStep step;
  for (int i = 0; i < 20'000; ++i) {
    const ResponseSettings settings = randomSettings(random);
    const Scene s = sceneInWall(random, settings, random.uniform(0.001, 0.5));
    const StepOutcome outcome = step.resolve(s.vehicle, s.motion, s.all(), s.step);
    ASSERT_LE(outcome.shift.velocity.norm(), CollisionStep::maxRecoverySpeed * (1.0 + 1e-12))
        << i << s;
    PlanarMotion expected =
        afterImpulse(s.motion, outcome.impulse, s.vehicle.mass, s.vehicle.yawInertia);
    ASSERT_NEAR((outcome.after.velocity - expected.velocity).norm(), 0.0, rounding) << i << s;
    ASSERT_NEAR(outcome.after.yawRate, expected.yawRate, rounding) << i << s;
    ASSERT_LE(energyOf(s.vehicle, outcome.after), energyOf(s.vehicle, s.motion) * (1.0 + 1e-12))
        << i << s;
  }
}

// Between two walls that come together, ideally elastic and smooth, impacts would never end.
TEST(SweptStep, AfterTooManyImpactsTheVehicleIsHeld) {
  Random random(906);
  CollisionStep step;
  ResponseSettings settings;
  settings.restitution = AngleCurve::constant(1.0);
  settings.friction = AngleCurve::constant(0.0);
  settings.penetrationTime = 0.0;
  int held = 0;
  for (int i = 0; i < 20'000; ++i) {
    Scene s{.vehicle = randomVehicle(random), .surface = {.settings = &settings}};
    s.step = 0.05;
    s.motion.velocity = {random.uniform(20.0, 120.0), random.uniform(-20.0, 20.0)};
    s.motion.yawRate = random.uniform(-10.0, 10.0);
    for (const double side : {1.0, -1.0}) {
      const double slope = random.uniform(0.0, 0.3);
      const Vector2 along = heading(-side * slope);
      const Vector2 foot(s.vehicle.massCentreToFront,
                         side * (0.5 * s.vehicle.width + random.uniform(0.001, 0.1)));
      s.walls.push_back({.start = foot - 10.0 * along,
                         .end = foot + 10.0 * along,
                         .normal = -side * turnedLeft(along),
                         .id = static_cast<int>(side)});
    }
    const StepOutcome outcome = step.resolve(s.vehicle, s.motion, s.all(), s.step);
    ASSERT_LE(outcome.impacts.size(), static_cast<std::size_t>(CollisionStep::maxImpacts)) << s;
    ASSERT_LE(energyOf(s.vehicle, outcome.after), energyOf(s.vehicle, s.motion) * (1.0 + 1e-12))
        << i << s;
    if (outcome.settled) continue;
    ++held;
    ASSERT_GE(outcome.impacts.size(), static_cast<std::size_t>(CollisionStep::maxAnswers)) << s;
    const Replay expected = replay(s, outcome);
    ASSERT_NEAR((outcome.after.position - expected.atLastImpact.position).norm(), 0.0, rounding)
        << i << s;
    ASSERT_NEAR(outcome.after.yaw, expected.atLastImpact.yaw, rounding) << i << s;
    ASSERT_NEAR((outcome.after.velocity - expected.after.velocity).norm(), 0.0, rounding) << i << s;
  }
  RecordProperty("held", held);
  EXPECT_GT(held, 10);
}

}  // namespace
}  // namespace bumper::tests
