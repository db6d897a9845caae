#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "car.h"
#include "rows_of_blocks.h"

namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;
// A corner that slides exactly along a face leaves it over a joint: it is not caught by the end of
// the block that it leaves.
TEST(CaughtAtAJoint, OfABlockThatIsLeft) {
  const ResponseSettings settings;
  const Surface surface{.settings = &settings};
  CollisionStep collision;
  int caught = 0;
  for (int i = 1; i <= 200; ++i) {
    const double heading = 0.01 * i * degree;
    Row row;
    add(row, {.from = -20.0, .to = 0.1, .thickness = 0.3});
    add(row, {.from = 0.11, .to = 2.0, .out = 0.0025, .thickness = 0.3});
    const Vector2 corner = rotated({car.massCentreToFront, -0.5 * car.width}, -heading);
    const StepOutcome outcome =
        collision.resolve(car, {.position = -corner, .yaw = -heading, .velocity = {30.0, 0.0}},
                          {row.walls, {&surface, 1}}, 0.2 / 30.0);
    if (outcome.after.velocity.x() < 27.0) ++caught;
  }
  EXPECT_EQ(caught, 0) << "of 200";
}

TEST(CaughtAtAJoint, InSinglePrecisionFarFromTheOrigin) {
  Random random(8);
  CollisionStep collision;
  for (int i = 0; i < 60; ++i) {
    const RowFrame frame{.origin = 20'000.0 * direction(random.uniform(-pi, pi)),
                         .along = direction(random.uniform(-pi, pi))};
    Slide slide{.vehicle = car, .speed = random.uniform(5.0, 40.0)};
    slide.into = random.uniform(0.2, 1.5) * degree;
    slide.step = random.uniform(0.001, 0.0167);
    slide.distance = std::min(40.0, 1.5 * slide.speed);
    slide.gap = 0.02;
    const double off = random.chance(0.3) ? 0.0 : std::pow(10.0, random.uniform(-5.0, -1.83));
    Row row = randomRow(random, {.off = off, .length = slide.distance + 8.0}, frame);
    roundToFloat(row);
    const SlideResult result = slideAlong(collision, row, slide);
    EXPECT_LT(result.hardest, 1.5 * std::max(1.0, slide.speed / 30.0)) << i << " off " << off;
  }
}

// Regular stairs of 5 cm cells, which the car climbs.
TEST(CaughtAtAJoint, OfAStaircase) {
  CollisionStep collision;
  for (const int tread : {1, 2, 3, 4, 6, 8, 10}) {
    for (const double into : {0.3, 0.6, 1.0}) {
      Row row{.frame = {.along = Vector2(tread, 1.0).normalized()}};
      const auto wall = [&](const Vector2& a, const Vector2& b) {
        row.walls.push_back({.start = a, .end = b, .normal = turnedLeft((b - a).normalized())});
      };
      constexpr double cell = 0.05;
      for (int i = -static_cast<int>(10.0 / (cell * tread)); i * cell * tread < 40.0; ++i) {
        const Vector2 foot = cell * Vector2(tread * i, i), edge = foot + cell * Vector2::UnitY();
        wall(foot, edge);
        wall(edge, edge + cell * tread * Vector2::UnitX());
      }
      row.foremost = row.frame.out().dot(cell * Vector2::UnitY());
      const SlideResult result = slideAlong(collision, row,
                                            {.vehicle = car,
                                             .speed = 30.0,
                                             .into = into * degree,
                                             .step = 0.005,
                                             .distance = 30.0,
                                             .gap = 0.01});
      EXPECT_LT(result.hardest, 1.5) << "1:" << tread << ", " << into << "°";
    }
  }
}

}  // namespace
}  // namespace bumper::tests
