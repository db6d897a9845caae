#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "car.h"
#include "rows_of_blocks.h"

/// The response to a block that stands out of a wall, from not at all to three smallest features.
namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// After a step in which the front right corner, which lies on the wall, meets the block.
PlanarMotion afterMeeting(double off, double speed, double heading) {
  constexpr double distance = 0.1;  // of the block from the corner, m
  Row row;
  add(row, {.from = -20.0, .to = distance, .thickness = 0.3});
  add(row, {.from = distance, .to = distance + 2.0, .out = off, .thickness = 0.3});
  add(row, {.from = distance + 2.0, .to = 20.0, .thickness = 0.3});
  const Placement at(Vector2::Zero(), -heading);
  const Vector2 corner = at.turned({car.massCentreToFront, -0.5 * car.width});
  const ResponseSettings settings;
  const Surface surface{.settings = &settings};
  CollisionStep collision;
  const StepOutcome outcome = collision.resolve(
      car, {.position = -corner, .yaw = -heading, .velocity = speed * direction(-heading)},
      {row.walls, {&surface, 1}}, 2.0 * distance / speed);
  return outcome.after;
}

TEST(FeatureGrowth, HasNoJump) {
  const double size = ResponseSettings{}.smallestFeature * 4.6;
  struct Bound {
    double speed, change;  ///< m/s, and per half millimetre
  };
  for (const auto& [speed, most] : {Bound{30.0, 3.3}, Bound{5.0, 1.0}}) {
    for (const double heading : {0.0, 0.5 * degree, 1.0 * degree}) {
      const PlanarMotion flat = afterMeeting(0.0, speed, heading);
      PlanarMotion before = flat;
      double largest = 0.0;
      for (int i = 1; i <= 120; ++i) {
        const double off = 0.0005 * i;
        const PlanarMotion after = afterMeeting(off, speed, heading);
        const double change = (after.velocity - before.velocity).norm();
        EXPECT_LT(change, most) << speed << " m/s, " << heading / degree << "°, " << off << " m";
        largest = std::max(largest, change);
        // Not at all up to the smallest feature, wholly from twice that on.
        const double lost = flat.velocity.x() - after.velocity.x();
        EXPECT_LT(lost, off < size ? 0.01 * speed : 1.1 * speed)
            << off << " m, " << speed << " m/s";
        EXPECT_GT(lost, (off > 2.0 * size ? 0.8 : -0.01) * speed)
            << off << " m, " << speed << " m/s";
        before = after;
      }
      RecordProperty("largest_change_" + std::to_string(speed) + "_" + std::to_string(heading),
                     testing::PrintToString(largest));
    }
  }
}

/// Steps so small that what they change is a jump: around one feature, where the wall begins to be
/// felt, none is more than a hundredth of the speed, and there is none where it is all felt.
TEST(FeatureGrowth, HasNoJumpInSmallSteps) {
  constexpr double step = 5e-6;  // m
  for (const double speed : {30.0, 5.0}) {
    for (const double heading : {0.0, 0.5 * degree, 1.0 * degree}) {
      PlanarMotion before = afterMeeting(0.01, speed, heading);
      double largest = 0.0;
      for (int i = 1; i <= 8'000; ++i) {
        const double off = 0.01 + step * i;
        const PlanarMotion after = afterMeeting(off, speed, heading);
        const double change = (after.velocity - before.velocity).norm();
        EXPECT_LT(change, (off < 0.03 ? 0.01 : 0.003) * speed)
            << speed << " m/s, " << heading / degree << "°, " << off << " m";
        largest = std::max(largest, change);
        before = after;
      }
      RecordProperty("largest_change_" + std::to_string(speed) + "_" + std::to_string(heading),
                     testing::PrintToString(largest));
    }
  }
}

}  // namespace
}  // namespace bumper::tests
