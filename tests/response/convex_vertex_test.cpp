#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "bumper/response/collision_step.h"
#include "car.h"
#include "random_impacts.h"

/// A car meets the vertex of two walls that bend away from it: from one wall (0°) to a fence that
/// is met end-on (180°) nothing jumps.
namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double speed = 20.0;   // m/s
constexpr double step = 0.01;    // s
constexpr double gap = 0.1;      // of the tip before the front, m
constexpr double length = 20.0;  // of each wall, m

struct Vertex {
  double bend = 0.0;     ///< of the two walls, °
  double aside = 0.0;    ///< of the tip from the middle of the front, to the left, m
  double heading = 0.0;  ///< of the car against the vertex's axis, °
};

/// After a step in which the car, which drives along x, meets the vertex.
PlanarMotion afterMeeting(const Vertex& vertex) {
  const ResponseSettings settings;
  const Surface surface{.settings = &settings};
  const Vector2 tip(car.massCentreToFront + gap, vertex.aside);
  std::array<Segment, 2> walls;
  for (const double side : {1.0, -1.0}) {
    const double angle = side * (90.0 - 0.5 * vertex.bend) - vertex.heading;
    const Vector2 along = direction(angle * degree);
    walls[side > 0.0 ? 0 : 1] = {.start = tip,
                                 .end = tip + length * along,
                                 .normal = side * turnedLeft(along),
                                 .id = side > 0.0 ? 0 : 1};
  }
  CollisionStep collision;
  const StepOutcome outcome =
      collision.resolve(car, {.velocity = {speed, 0.0}}, {walls, {&surface, 1}}, step);
  EXPECT_TRUE(outcome.settled) << vertex.bend << "° " << vertex.aside << " m";
  return outcome.after;
}

struct Largest {
  double yawRate = 0.0;  ///< °/s
  double speed = 0.0;    ///< m/s
  int at = 0;
};

/// Largest difference between neighbours of `count` scenes.
Largest largestChange(int first, int last, const std::function<Vertex(int)>& scene) {
  Largest largest;
  PlanarMotion before = afterMeeting(scene(first));
  for (int i = first + 1; i <= last; ++i) {
    const PlanarMotion after = afterMeeting(scene(i));
    const double change = std::abs(after.yawRate - before.yawRate) / degree;
    if (change > largest.yawRate) largest.at = i;
    largest.yawRate = std::max(largest.yawRate, change);
    largest.speed = std::max(largest.speed, (after.velocity - before.velocity).norm());
    before = after;
  }
  return largest;
}

TEST(ConvexVertex, AtTheMiddleOfTheFrontTurnsNothing) {
  for (int i = 1; i <= 1790; ++i) {
    const PlanarMotion after = afterMeeting({.bend = 0.1 * i});
    ASSERT_NEAR(after.yawRate, 0.0, 1e-9) << 0.1 * i << "°";
    ASSERT_NEAR(after.velocity.y(), 0.0, 1e-9) << 0.1 * i << "°";
    ASSERT_LE(after.velocity.x(), 0.0) << 0.1 * i << "°";
  }
}

TEST(ConvexVertex, NothingJumpsWithTheBend) {
  const Largest largest = largestChange(
      0, 1800, [](int i) { return Vertex{.bend = 0.1 * i, .aside = 0.3, .heading = 2.0}; });
  RecordProperty("largest_change_per_tenth_degree", testing::PrintToString(largest.yawRate));
  EXPECT_LT(largest.yawRate, 7.5) << "°/s at " << 0.1 * largest.at << "°";
  EXPECT_LT(largest.speed, 0.07);
}

// From past one side of the car to past the other.
TEST(ConvexVertex, NothingJumpsWithThePlaceOfTheTip) {
  for (const double heading : {0.0, 2.0}) {
    const Largest largest = largestChange(-1100, 1100, [&](int i) {
      return Vertex{.bend = 20.0, .aside = 0.001 * i, .heading = heading};
    });
    RecordProperty("largest_change_per_millimetre_" + std::to_string(heading),
                   testing::PrintToString(largest.yawRate));
    EXPECT_LT(largest.yawRate, 5.5) << "°/s at " << largest.at << " mm, " << heading << "°";
    EXPECT_LT(largest.speed, 0.11) << heading << "°";
  }
}
}  // namespace
}  // namespace bumper::tests
