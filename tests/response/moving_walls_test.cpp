#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bumper/response/collision_step.h"
#include "bumper/response/sweep.h"
#include "car.h"
#include "random_impacts.h"

/// Walls that belong to a body that moves: a gate, a train, a lorry of another host.
namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;

Segment between(const Vector2& start, const Vector2& end, int id) {
  return {.start = start, .end = end, .normal = turnedLeft((end - start).normalized()), .id = id};
}

struct Hit {
  VehicleParameters vehicle;
  PlanarMotion motion{};
  std::vector<Segment> walls{};
  std::vector<Surface> surfaces{};
  double step = 0.0;
};

/// The surfaces' numbers of a polygon's sides, at random.
void addPolygon(Hit& hit, Random& random, int surfaces) {
  const double radius = std::pow(10.0, random.uniform(-0.5, 1.0));
  const Vector2 ahead = hit.motion.velocity.normalized();
  const double reach = Outline(hit.vehicle).radius() + radius;
  const Vector2 middle = random.uniform(0.3, 1.0) * reach * ahead +
                         random.uniform(-0.5, 0.5) * reach * turnedLeft(ahead);
  std::vector<double> angles;
  for (int i = 3 + random.below(5); i > 0; --i) angles.push_back(random.uniform(-pi, pi));
  std::sort(angles.begin(), angles.end());
  const bool convex = random.chance(0.5);
  std::vector<Vector2> corners;
  for (const double angle : angles) {
    corners.push_back(middle +
                      radius * (convex ? 1.0 : random.uniform(0.3, 1.0)) * direction(angle));
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Segment side =
        between(corners[i], corners[(i + 1) % corners.size()], static_cast<int>(hit.walls.size()));
    side.surface = random.below(surfaces);
    hit.walls.push_back(side);
  }
  if (random.chance(0.2)) {
    const Vector2 place = middle + random.uniform(0.0, radius) * direction(random.uniform(-pi, pi));
    hit.walls.push_back({.start = place,
                         .end = place,
                         .radius = random.uniform(0.05, 0.5),
                         .id = static_cast<int>(hit.walls.size())});
  }
}

PlanarMotion randomDrift(Random& random) {
  return {.position = random.uniform(0.0, 20.0) * direction(random.uniform(-pi, pi)),
          .yaw = random.uniform(-pi, pi),
          .velocity = random.uniform(0.0, 40.0) * direction(random.uniform(-pi, pi))};
}

Hit randomHit(Random& random, const std::vector<ResponseSettings>& settings) {
  Hit hit{.vehicle = randomVehicle(random)};
  hit.step = random.uniform(0.005, 0.02);
  hit.motion.yaw = random.uniform(-pi, pi);
  hit.motion.velocity = random.uniform(2.0, 50.0) * direction(random.uniform(-pi, pi));
  hit.motion.yawRate = random.chance(0.3) ? 0.0 : random.uniform(-3.0, 3.0);
  for (const ResponseSettings& each : settings) hit.surfaces.push_back({.settings = &each});
  // One of the bodies rests, as a wall that a gate is hung on.
  for (std::size_t i = 1; i < hit.surfaces.size(); ++i) {
    hit.surfaces[i].moves = true;
    hit.surfaces[i].motion = randomDrift(random);
  }
  addPolygon(hit, random, static_cast<int>(settings.size()));
  return hit;
}

/// Whether the outline holds a part of a wall, which no drive leads to.
bool startsInside(const Hit& hit) {
  return std::any_of(hit.walls.begin(), hit.walls.end(), [&](const Segment& wall) {
    return findTouch(Outline(hit.vehicle), hit.motion.placement(), wall).has_value();
  });
}

/// The same as seen by one who moves with velocity −`drift`.
Hit seenFrom(Hit hit, const Vector2& drift) {
  hit.motion.velocity += drift;
  for (Surface& surface : hit.surfaces) {
    surface.moves = true;
    surface.motion.velocity += drift;
  }
  return hit;
}

TEST(MovingWalls, AreAnsweredAsByOneWhoMovesWithThem) {
  Random random(20261130);
  ResponseSettings stiff;
  stiff.restitution = AngleCurve::constant(0.6);
  ResponseSettings byEnergy;
  byEnergy.law = Law::energy;
  const std::vector<ResponseSettings> settings{ResponseSettings{}, stiff, byEnergy};
  CollisionStep collision;
  CollisionStep moving;
  int hits = 0;
  int several = 0;
  for (int i = 0; i < 30'000; ++i) {
    const Hit still = randomHit(random, settings);
    if (startsInside(still)) continue;
    const Vector2 drift = random.uniform(0.0, 60.0) * direction(random.uniform(-pi, pi));
    const Hit seen = seenFrom(still, drift);
    const StepOutcome a =
        collision.resolve(still.vehicle, still.motion, {still.walls, still.surfaces}, still.step);
    const StepOutcome b =
        moving.resolve(seen.vehicle, seen.motion, {seen.walls, seen.surfaces}, seen.step);
    // Walls that close on each other with the car between them may need any number.
    if (!a.settled || a.impacts.size() > 20) continue;
    ASSERT_EQ(a.impacts.size(), b.impacts.size()) << i;
    ASSERT_EQ(a.settled, b.settled) << i;
    hits += a.impacts.empty() ? 0 : 1;
    several += a.impacts.size() > 1 ? 1 : 0;
    const double tolerance = 1e-9 * (still.motion.velocity.norm() + drift.norm() + 40.0);
    EXPECT_LE((a.after.velocity + drift - b.after.velocity).norm(), tolerance) << i;
    EXPECT_NEAR(a.after.yawRate, b.after.yawRate, tolerance) << i;
    EXPECT_LE((a.after.position + still.step * drift - b.after.position).norm(), tolerance) << i;
    for (std::size_t k = 0; k < a.impacts.size(); ++k) {
      const ImpactResponse& one = a.impacts[k].response;
      const ImpactResponse& other = b.impacts[k].response;
      EXPECT_NEAR(one.energyRatio, other.energyRatio, 1e-6) << i;
      EXPECT_LE(one.energyRatio, 1.0 + 1e-9) << i;
      EXPECT_EQ(a.impacts[k].impact.wall, b.impacts[k].impact.wall) << i;
    }
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(several, 200);
}

TEST(MovingWalls, ThatCloseOnACarAnyhowLeaveItSlow) {
  Random random(11);
  const std::vector<ResponseSettings> settings(3);
  CollisionStep collision;
  double fastest = 0.0;
  int stands = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Hit hit = randomHit(random, settings);
    stands += startsInside(hit) ? 1 : 0;
    const StepOutcome outcome =
        collision.resolve(hit.vehicle, hit.motion, {hit.walls, hit.surfaces}, hit.step);
    ASSERT_TRUE(isFinite(outcome.after)) << i;
    double walls = 0.0;
    for (const Surface& surface : hit.surfaces)
      walls = std::max(walls, surface.motion.velocity.norm());
    const double radius = std::sqrt(hit.vehicle.yawInertia / hit.vehicle.mass);
    const double before = std::hypot(hit.motion.velocity.norm(), radius * hit.motion.yawRate);
    const double after = std::hypot(outcome.after.velocity.norm(), radius * outcome.after.yawRate);
    fastest = std::max(fastest, after / (before + walls));
  }
  EXPECT_GT(stands, 2'000);
  // In a wedge that closes, a vehicle leaves faster than its walls.
  EXPECT_LT(fastest, 4.0);
}

/// Where a body's wall is, and whether the outline touches it, at a time.
bool touchesAt(const Outline& outline, const PlanarMotion& vehicle, const Segment& wall,
               const PlanarMotion& body, double time) {
  return findTouch(outline, advanced(vehicle, time).placement(),
                   carried(wall, body.placement(), advanced(body, time).placement()))
      .has_value();
}

TEST(MovingWalls, ThatTurnAreMetWhenTheyTouch) {
  Random random(7);
  const Outline outline(car);
  int met = 0;
  for (int i = 0; i < 2'000; ++i) {
    const PlanarMotion vehicle{
        .yaw = random.uniform(-pi, pi),
        .velocity = random.uniform(0.0, 20.0) * direction(random.uniform(-pi, pi)),
        .yawRate = random.uniform(-2.0, 2.0)};
    const Vector2 hinge = random.uniform(1.0, 6.0) * direction(random.uniform(-pi, pi));
    const Vector2 tip = hinge + random.uniform(0.5, 5.0) * direction(random.uniform(-pi, pi));
    const PlanarMotion gate{
        .position = hinge,
        .velocity = random.uniform(0.0, 5.0) * direction(random.uniform(-pi, pi)),
        .yawRate = random.uniform(-8.0, 8.0)};
    const Segment wall = between(hinge, tip, 0);
    constexpr double until = 0.2;
    if (touchesAt(outline, vehicle, wall, gate, 0.0)) continue;
    const double time = Sweep(outline, vehicle, gate).timeOfTouch(wall, nullptr, 0.0, until);
    constexpr int looks = 1000;
    double sampled = never;
    for (int k = 1; k <= looks && sampled == never; ++k) {
      if (touchesAt(outline, vehicle, wall, gate, k * until / looks)) sampled = k * until / looks;
    }
    if (sampled == never) {
      // It may be touched between two looks, and left again.
      if (time < never) {
        EXPECT_TRUE(touchesAt(outline, vehicle, wall, gate, time)) << i;
      }
      continue;
    }
    ++met;
    EXPECT_LE(time, sampled) << i;
    if (time < sampled - until / looks) {
      EXPECT_TRUE(touchesAt(outline, vehicle, wall, gate, time)) << i;
    }
  }
  EXPECT_GT(met, 300);
}

/// A wall of 8 m across the x axis, the space beyond it solid.
Hit gateAt(double x, const PlanarMotion& body, const ResponseSettings& settings) {
  Hit hit{.vehicle = car};
  hit.walls.push_back({.start = {x, -4.0}, .end = {x, 4.0}, .normal = {-1.0, 0.0}, .solid = true});
  hit.surfaces.push_back({.settings = &settings, .moves = true, .motion = body});
  return hit;
}

TEST(MovingWalls, AGatePushesACarNoFasterThanItRebounds) {
  const ResponseSettings settings;
  CollisionStep collision;
  for (const double h : {0.001, 0.005, 0.0167}) {
    for (const double yaw : {0.0, 0.05, 0.6}) {
      PlanarMotion motion{.position = {-3.0, 0.3}, .yaw = yaw};
      double face = 0.0;
      double fastest = 0.0;
      for (double time = 0.0; time < 6.0; time += h) {
        const PlanarMotion body{.position = {face, 0.0}, .velocity = {-1.0, 0.0}};
        const Hit hit = gateAt(face, body, settings);
        const StepOutcome outcome =
            collision.resolve(hit.vehicle, motion, {hit.walls, hit.surfaces}, h);
        EXPECT_TRUE(outcome.settled);
        motion = outcome.after;
        face -= h;
        fastest = std::max(fastest, motion.velocity.norm());
        double front = -1e9;
        for (const Vector2& corner : Outline(car).corners()) {
          front = std::max(front, (motion.position + motion.placement().turned(corner)).x());
        }
        EXPECT_LE(front, face + 1e-6) << h << " " << yaw << " " << time;
      }
      EXPECT_LE(fastest, 1.0 + settings.restitution(0.0) + 1e-9);
      EXPECT_GT(fastest, 0.9);
    }
  }
}

TEST(MovingWalls, AGateThatSwingsStrikesACarAtRest) {
  const ResponseSettings settings;
  CollisionStep collision;
  for (const double h : {0.002, 0.01, 0.0167}) {
    PlanarMotion motion;
    // Hinged 3 m to the right of the middle of the front, it opens towards the car at 2 rad/s.
    PlanarMotion gate{.position = {2.6, -3.0}, .yawRate = 2.0};
    Segment bar = between({2.6, -3.0}, {6.6, -3.0}, 0);
    int impacts = 0;
    double first = 0.0;
    double impulse = 0.0;
    for (double time = 0.0; time < 0.9; time += h) {
      const Surface surface{.settings = &settings, .moves = true, .motion = gate};
      const StepOutcome outcome = collision.resolve(car, motion, {{&bar, 1}, {&surface, 1}}, h);
      if (impacts == 0 && !outcome.impacts.empty()) {
        const StepImpact& hit = outcome.impacts.front();
        first = time + hit.time;
        impulse = outcome.impulse.linear.norm();
        // Somewhere near the front's left corner, which is met first.
        EXPECT_NEAR(hit.response.approachSpeed, 2.0 * std::hypot(0.5, 3.9), 0.2);
      }
      impacts += static_cast<int>(outcome.impacts.size());
      motion = outcome.after;
      const PlanarMotion moved = advanced(gate, h);
      bar = carried(bar, gate.placement(), moved.placement());
      gate = moved;
      const auto touch = findTouch(Outline(car), motion.placement(), bar);
      EXPECT_LE(touch ? touch->depth : 0.0, 1e-5) << h << " " << time;
    }
    EXPECT_NEAR(first, (0.5 * pi + std::atan2(0.5, 3.9)) / 2.0, 1e-9);
    EXPECT_GE(impacts, 1);
    EXPECT_GT(impulse, 0.0);
    EXPECT_LT(motion.velocity.x(), -0.5);
  }
}

TEST(MovingWalls, ThatCloseOnACarLeaveItFinite) {
  const ResponseSettings settings;
  CollisionStep collision;
  PlanarMotion motion{.yaw = 0.02};
  double left = 1.2;
  double fastest = 0.0;
  for (int i = 0; i < 400; ++i) {
    constexpr double h = 0.005;
    std::vector<Segment> walls{
        {.start = {-5.0, left}, .end = {5.0, left}, .normal = {0.0, -1.0}, .surface = 0},
        {.start = {-5.0, -1.0}, .end = {5.0, -1.0}, .normal = {0.0, 1.0}, .surface = 1}};
    const std::vector<Surface> surfaces{
        {.settings = &settings,
         .moves = true,
         .motion = {.position = {0.0, left}, .velocity = {0.0, -0.5}}},
        {.settings = &settings}};
    const StepOutcome outcome = collision.resolve(car, motion, {walls, surfaces}, h);
    motion = outcome.after;
    left -= 0.5 * h;
    ASSERT_TRUE(isFinite(motion)) << i;
    fastest = std::max(fastest, motion.velocity.norm());
  }
  EXPECT_LT(fastest, 2.0);
}

}  // namespace
}  // namespace bumper::tests
