#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bumper/response/collision_step.h"
#include "extent.h"
#include "random_impacts.h"

/// One step against a random polygon: turned, in a mirror, and given in another order, it has the
/// same answer.
namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double equal = 1e-9;  // relative
const int hitCount = extent(10'000, 100'000);

struct Hit {
  VehicleParameters vehicle;
  PlanarMotion motion{};
  std::vector<Segment> walls{};
  double step = 0.0;
};

Segment between(const Vector2& start, const Vector2& end, int id) {
  return {.start = start, .end = end, .normal = turnedLeft((end - start).normalized()), .id = id};
}

/// Convex or star-shaped, closed or open, so far ahead of the car that it meets it in the step.
Hit randomHit(Random& random) {
  Hit hit{.vehicle = randomVehicle(random)};
  hit.step = random.uniform(0.005, 0.02);
  hit.motion.yaw = random.uniform(-pi, pi);
  hit.motion.velocity = random.uniform(2.0, 50.0) * direction(random.uniform(-pi, pi));
  hit.motion.yawRate = random.chance(0.3) ? 0.0 : random.uniform(-3.0, 3.0);

  const int corners = 3 + random.below(6);
  const bool convex = random.chance(0.5), closed = random.chance(0.6);
  const double radius = std::pow(10.0, random.uniform(-0.5, 1.0));
  std::vector<double> angles;
  for (int i = 0; i < corners; ++i) angles.push_back(random.uniform(-pi, pi));
  std::sort(angles.begin(), angles.end());
  std::vector<Vector2> polygon;
  for (const double angle : angles)
    polygon.push_back(radius * (convex ? 1.0 : random.uniform(0.3, 1.0)) * direction(angle));

  // Along the car's way until its outline's circle touches the polygon's, and in by some of that.
  const Vector2 ahead = hit.motion.velocity.normalized();
  const double reach = Outline(hit.vehicle).radius() + radius;
  const Vector2 middle = random.uniform(0.3, 1.0) * reach * ahead +
                         random.uniform(-0.5, 0.5) * reach * turnedLeft(ahead);
  for (Vector2& corner : polygon) corner += middle;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < polygon.size(); ++i)
    hit.walls.push_back(
        between(polygon[i], polygon[(i + 1) % polygon.size()], static_cast<int>(i)));
  return hit;
}

/// Whether the outline holds a part of a wall, which no drive leads to.
bool startsInside(const Hit& hit) {
  return std::any_of(hit.walls.begin(), hit.walls.end(), [&](const Segment& wall) {
    return findTouch(Outline(hit.vehicle), hit.motion.placement(), wall).has_value();
  });
}

Hit turned(Hit hit, double angle) {
  for (Segment& wall : hit.walls) {
    for (Vector2* each : {&wall.start, &wall.end, &wall.normal}) *each = rotated(*each, angle);
  }
  hit.motion.position = rotated(hit.motion.position, angle);
  hit.motion.velocity = rotated(hit.motion.velocity, angle);
  hit.motion.yaw += angle;
  return hit;
}

Vector2 flipped(const Vector2& vector) { return {vector.x(), -vector.y()}; }

/// In a mirror that turns left into right; of a wall the ends change places.
Hit mirrored(Hit hit) {
  for (Segment& wall : hit.walls) {
    std::swap(wall.start, wall.end);
    for (Vector2* each : {&wall.start, &wall.end, &wall.normal}) *each = flipped(*each);
  }
  hit.motion.position = flipped(hit.motion.position);
  hit.motion.velocity = flipped(hit.motion.velocity);
  hit.motion.yaw = -hit.motion.yaw;
  hit.motion.yawRate = -hit.motion.yawRate;
  return hit;
}

/// The same walls in another order, some from their other end.
Hit reordered(Hit hit, Random& random) {
  for (std::size_t i = hit.walls.size(); i > 1; --i)
    std::swap(hit.walls[i - 1],
              hit.walls[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  for (Segment& wall : hit.walls) {
    if (random.chance(0.5)) std::swap(wall.start, wall.end);
    if (random.chance(0.5)) wall.normal = -wall.normal;
  }
  return hit;
}

struct Answer {
  Vector2 velocity;
  double yawRate = 0.0;
  std::size_t impacts = 0;
};

Answer answerTo(CollisionStep& collision, const Hit& hit) {
  const ResponseSettings settings;
  const Surface surface{.settings = &settings};
  const StepOutcome outcome =
      collision.resolve(hit.vehicle, hit.motion, {hit.walls, {&surface, 1}}, hit.step);
  return {.velocity = outcome.after.velocity,
          .yawRate = outcome.after.yawRate,
          .impacts = outcome.impacts.size()};
}

/// Relative to the motion before: the speed, and the yaw rate that it would be at arm's length.
double difference(const Hit& hit, const Answer& a, const Answer& b) {
  const double speed = hit.motion.velocity.norm();
  const double arm = std::sqrt(hit.vehicle.yawInertia / hit.vehicle.mass);
  const double yawRate = speed / arm + std::abs(hit.motion.yawRate);
  return std::max((a.velocity - b.velocity).norm() / speed,
                  std::abs(a.yawRate - b.yawRate) / yawRate);
}

/// Counts answers that differ.
class Comparison {
 public:
  void add(int number, const Hit& hit, const Answer& expected, const Answer& other) {
    const double off = difference(hit, expected, other);
    worst_ = std::max(worst_, off);
    if (off > equal && ++apart_ < 4) examples_ << number << ": " << off << '\n';
  }

  void expectSame(const std::string& what) const {
    testing::Test::RecordProperty(what + "_largest_difference", testing::PrintToString(worst_));
    EXPECT_EQ(apart_, 0) << what << '\n' << examples_.str();
  }

 private:
  int apart_ = 0;
  double worst_ = 0.0;
  std::ostringstream examples_;
};

/// Calls with the number of each of so many random scenes, the scene, and its answer.
template <typename Call>
void forEachHit(CollisionStep& collision, const Call& call) {
  Random random(5201);
  int hits = 0, several = 0;
  for (int i = 0; hits < hitCount; ++i) {
    const Hit hit = randomHit(random);
    if (startsInside(hit)) continue;
    const Answer answer = answerTo(collision, hit);
    if (answer.impacts == 0) continue;
    ++hits;
    if (answer.impacts > 1) ++several;
    call(i, hit, answer);
  }
  EXPECT_GT(several, hits / 25);
}

TEST(SceneSymmetry, TheTurnedSceneHasTheTurnedAnswer) {
  Random random(5202);
  CollisionStep collision;
  Comparison turn;
  forEachHit(collision, [&](int i, const Hit& hit, const Answer& answer) {
    const double angle = random.uniform(-pi, pi);
    Answer seen = answerTo(collision, turned(hit, angle));
    seen.velocity = rotated(seen.velocity, -angle);
    turn.add(i, hit, answer, seen);
  });
  turn.expectSame("turned");
}

TEST(SceneSymmetry, TheMirroredSceneHasTheMirroredAnswer) {
  CollisionStep collision;
  Comparison mirror;
  forEachHit(collision, [&](int i, const Hit& hit, const Answer& answer) {
    Answer seen = answerTo(collision, mirrored(hit));
    seen.velocity = flipped(seen.velocity);
    seen.yawRate = -seen.yawRate;
    mirror.add(i, hit, answer, seen);
  });
  mirror.expectSame("mirrored");
}

TEST(SceneSymmetry, TheOrderOfTheWallsDoesNotMatter) {
  Random random(5203);
  CollisionStep collision;
  Comparison order;
  forEachHit(collision, [&](int i, const Hit& hit, const Answer& answer) {
    order.add(i, hit, answer, answerTo(collision, reordered(hit, random)));
  });
  order.expectSame("reordered");
}

}  // namespace
}  // namespace bumper::tests
