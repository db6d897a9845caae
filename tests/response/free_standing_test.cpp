#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bumper/response/collision_step.h"
#include "car.h"
#include "random_impacts.h"

/// What stands free is hit, however thin it is or however little of it is in the way: the rule for
/// small features of a wall does not concern it.
namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double touchDepth = 1e-6;  // m

Segment between(const Vector2& start, const Vector2& end, int id = 0) {
  return {.start = start, .end = end, .normal = turnedLeft((end - start).normalized()), .id = id};
}

std::vector<Segment> square(const Vector2& middle, double width, double angle) {
  const Vector2 ahead = 0.5 * width * direction(angle), left = turnedLeft(ahead);
  const Vector2 corners[] = {middle + ahead + left, middle - ahead + left, middle - ahead - left,
                             middle + ahead - left};
  std::vector<Segment> walls;
  for (int i = 0; i < 4; ++i) walls.push_back(between(corners[i], corners[(i + 1) % 4], i));
  return walls;
}

struct Approaching {
  PlanarMotion motion{};
  std::vector<Segment> walls{};
  double step = 0.0;
};

StepOutcome resolved(CollisionStep& collision, const Approaching& scene,
                     const ResponseSettings& settings) {
  const Surface surface{.settings = &settings};
  return collision.resolve(car, scene.motion, {scene.walls, {&surface, 1}}, scene.step);
}

/// How deep an end of a wall lies in the outline, or a corner of the outline in a square.
double depthOf(const std::vector<Segment>& walls, const PlanarMotion& motion) {
  const Placement at = motion.placement();
  const Outline outline(car);
  double deepest = -1.0;
  for (const Segment& wall : walls) {
    for (const Vector2& end : {wall.start, wall.end}) {
      const Vector2 p = at.local(end);
      deepest = std::max(deepest, std::min({outline.front - p.x(), outline.rear + p.x(),
                                            outline.halfWidth - std::abs(p.y())}));
    }
  }
  if (walls.size() != 4) return deepest;
  for (const Vector2& corner : outline.corners()) {
    const Vector2 p = at.position + at.turned(corner);
    double inside = 1e9;
    // The squares are given counter-clockwise.
    for (const Segment& wall : walls)
      inside = std::min(inside, cross((wall.end - wall.start).normalized(), p - wall.start));
    deepest = std::max(deepest, inside);
  }
  return deepest;
}

/// The greatest depth while the step's impulses act when they do.
double deepestInStep(const Approaching& scene, const StepOutcome& outcome) {
  constexpr int looks = 40;
  PlanarMotion motion = scene.motion;
  double time = 0.0, deepest = -1.0;
  const auto fly = [&](double until) {
    const PlanarMotion from = motion;
    for (int i = 0; i <= looks; ++i) {
      motion = advanced(from, (until - time) * i / looks);
      deepest = std::max(deepest, depthOf(scene.walls, motion));
    }
    time = until;
  };
  for (const StepImpact& each : outcome.impacts) {
    fly(each.time);
    motion = afterImpulse(motion, each.response.impulse, car.mass, car.yawInertia);
  }
  fly(scene.step);
  return deepest;
}

/// A car that drives or slides at up to 60 m/s, and turns or does not.
Approaching randomApproach(Random& random) {
  Approaching scene{.step = random.uniform(0.001, 0.0167)};
  scene.motion.velocity = random.uniform(1.0, 60.0) * direction(random.uniform(-0.4, 0.4));
  scene.motion.yawRate = random.chance(0.5) ? 0.0 : random.uniform(-1.0, 1.0);
  return scene;
}

/// Ahead of the front, and met within the step unless it lies at its edge.
Vector2 ahead(Random& random, const Approaching& scene, double aside) {
  const double way = scene.motion.velocity.x() * scene.step;
  return {car.massCentreToFront + random.uniform(0.05, 0.9) * way,
          aside + scene.motion.velocity.y() * scene.step * 0.5};
}

/// All of them hit, or all but a few that start to slide past.
void expectHit(const char* what, const std::vector<Approaching>& scenes, int misses,
               double mostDepth = touchDepth) {
  CollisionStep collision, other;
  const ResponseSettings settings;
  ResponseSettings without;
  without.smallestFeature = 0.0;
  int hits = 0;
  double deepest = -1.0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const StepOutcome outcome = resolved(collision, scenes[i], settings);
    hits += outcome.impacts.empty() ? 0 : 1;
    ASSERT_TRUE(outcome.settled) << what << ' ' << i;
    const double depth = deepestInStep(scenes[i], outcome);
    deepest = std::max(deepest, depth);
    ASSERT_LE(depth, mostDepth) << what << ' ' << i;
    const StepOutcome same = resolved(other, scenes[i], without);
    ASSERT_EQ(outcome.impacts.size(), same.impacts.size()) << what << ' ' << i;
    ASSERT_EQ(outcome.after.velocity, same.after.velocity) << what << ' ' << i;
    ASSERT_EQ(outcome.after.yawRate, same.after.yawRate) << what << ' ' << i;
    ASSERT_EQ(outcome.after.position, same.after.position) << what << ' ' << i;
    ASSERT_EQ(outcome.after.yaw, same.after.yaw) << what << ' ' << i;
  }
  testing::Test::RecordProperty(std::string(what) + "_deepest", testing::PrintToString(deepest));
  testing::Test::RecordProperty(std::string(what) + "_hits", hits);
  EXPECT_GE(hits, static_cast<int>(scenes.size()) - misses) << what;
}

constexpr int sceneCount = 3'000;

TEST(FreeStanding, ABlock) {
  Random random(6301);
  std::vector<Approaching> scenes;
  for (int i = 0; i < sceneCount; ++i) {
    Approaching scene = randomApproach(random);
    const double angle = random.uniform(-pi, pi);
    const double half = std::abs(std::cos(angle)) + std::abs(std::sin(angle));
    const Vector2 middle = ahead(random, scene, random.uniform(-1.2, 1.2)) + Vector2(half, 0.0);
    scene.walls = square(middle, 2.0, angle);
    scenes.push_back(scene);
  }
  expectHit("block", scenes, sceneCount / 3);
}

TEST(FreeStanding, APostOfFourWalls) {
  Random random(6302);
  std::vector<Approaching> scenes;
  for (int i = 0; i < sceneCount; ++i) {
    Approaching scene = randomApproach(random);
    const double angle = random.uniform(-pi, pi);
    const double half = 0.05 * (std::abs(std::cos(angle)) + std::abs(std::sin(angle)));
    const Vector2 middle = ahead(random, scene, random.uniform(-0.9, 0.9)) + Vector2(half, 0.0);
    scene.walls = square(middle, 0.1, angle);
    scenes.push_back(scene);
  }
  expectHit("post", scenes, 10);
}

TEST(FreeStanding, TheEndOfAFence) {
  Random random(6303);
  std::vector<Approaching> scenes;
  for (int i = 0; i < sceneCount; ++i) {
    Approaching scene = randomApproach(random);
    const Vector2 end = ahead(random, scene, random.uniform(-0.85, 0.85));
    scene.walls = {between(end, end + 10.0 * direction(random.uniform(-0.6, 0.6)))};
    scenes.push_back(scene);
  }
  // Where it slides along the turning front it is looked for twelve times in a step.
  constexpr double betweenLooks = 1e-3;  // m
  expectHit("fence", scenes, 10, betweenLooks);
}

// Straight ahead, as much in the way as a feature that would not catch.
TEST(FreeStanding, ABlockThatIsGrazedByACentimetre) {
  Random random(6304);
  std::vector<Approaching> scenes;
  for (int i = 0; i < sceneCount; ++i) {
    Approaching scene{.step = random.uniform(0.001, 0.0167)};
    scene.motion.velocity = {random.uniform(1.0, 60.0), 0.0};
    const double way = scene.motion.velocity.x() * scene.step;
    const double side = random.sign();
    const Vector2 middle(car.massCentreToFront + random.uniform(0.05, 0.9) * way + 1.0,
                         side * (0.5 * car.width - 0.01 + 1.0));
    scene.walls = square(middle, 2.0, 0.0);
    scenes.push_back(scene);
  }
  expectHit("grazed", scenes, 0);
}

}  // namespace
}  // namespace bumper::tests
