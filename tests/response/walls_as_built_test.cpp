#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rows_of_blocks.h"

/// A car that slides along a wall of blocks is not caught by what a mason would let pass, and is by
/// what stands in its way.
namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double modelScale = 0.065;
constexpr double degree = pi / 180.0;

/// All lengths times `scale`.
VehicleParameters carOf(double scale) {
  const double mass = 1500.0 * std::pow(scale, 3.0);
  return {.mass = mass,
          .yawInertia = 2600.0 * std::pow(scale, 5.0),
          .massCentreToFront = 2.1 * scale,
          .massCentreToRear = 2.5 * scale,
          .width = 1.8 * scale,
          .massCentreHeight = 0.55 * scale};
}

/// ResponseSettings::smallestFeature of that car, m.
double smallestFeature(double scale) { return ResponseSettings{}.smallestFeature * 4.6 * scale; }

/// In a random direction; the speed of a model is that of the car's times √scale, since both are
/// pressed by 4 m/s².
struct RandomSlide {
  Slide slide;
  RowFrame frame{};
  double bound = 0.0;  ///< of one impact's velocity change, m/s
};
RandomSlide randomSlide(Random& random, double scale) {
  RandomSlide result{.slide = {.vehicle = carOf(scale)}};
  const double speed = random.uniform(5.0, 40.0);
  const double toScale = std::sqrt(scale);
  result.slide.speed = speed * toScale;
  result.slide.into = random.uniform(0.2, 1.5) * degree;
  result.slide.step = random.uniform(0.001, 0.0167);
  result.slide.distance = std::min(40.0, 1.5 * speed) * scale;
  result.slide.gap = 0.02 * scale;
  result.frame.along = direction(random.uniform(-pi, pi));
  result.bound = 1.5 * toScale * std::max(1.0, speed / 30.0);
  return result;
}

/// Slides along `count` rows whose blocks stand out by `off`, or by 10 µm to that.
struct Worst {
  double hardest = 0.0;  ///< share of the bound
  double deepest = 0.0;  ///< m
  double slowest = 1.0;  ///< share of the speed
};
Worst slideAlongRows(std::uint64_t seed, double scale, double mostOff, int count) {
  Random random(seed);
  CollisionStep collision;
  Worst worst;
  for (int i = 0; i < count; ++i) {
    const RandomSlide drawn = randomSlide(random, scale);
    const double off =
        mostOff > 0.0
            ? std::pow(10.0, random.uniform(std::log10(1e-5 * scale), std::log10(mostOff)))
            : 0.0;
    const Masonry masonry{.unit = scale, .off = off, .length = drawn.slide.distance + 8.0 * scale};
    const SlideResult result =
        slideAlong(collision, randomRow(random, masonry, drawn.frame), drawn.slide);
    EXPECT_LT(result.hardest, drawn.bound)
        << "row " << i << " off by " << off << " m at " << drawn.slide.speed << " m/s";
    EXPECT_LT(result.deepest, smallestFeature(scale) + 0.01 * scale) << "row " << i;
    worst.hardest = std::max(worst.hardest, result.hardest / drawn.bound);
    worst.deepest = std::max(worst.deepest, result.deepest);
    worst.slowest = std::min(worst.slowest, result.slowest / drawn.slide.speed);
  }
  testing::Test::RecordProperty("hardest_of_bound", testing::PrintToString(worst.hardest));
  testing::Test::RecordProperty("deepest", testing::PrintToString(worst.deepest));
  testing::Test::RecordProperty("slowest", testing::PrintToString(worst.slowest));
  return worst;
}

TEST(WallsAsBuilt, BlocksInLineAreAWall) {
  EXPECT_GT(slideAlongRows(7401, 1.0, 0.0, 60).slowest, 0.5);
}

TEST(WallsAsBuilt, SmallFeaturesDoNotCatch) {
  EXPECT_GT(slideAlongRows(7402, 1.0, smallestFeature(1.0), 100).slowest, 0.5);
}

TEST(WallsAsBuilt, AModelSlidesAlongBlocksInLine) {
  EXPECT_GT(slideAlongRows(7403, modelScale, 0.0, 60).slowest, 0.5);
}

/// One block that stands out of a row by so much, after the car has come to slide along it.
void expectCaught(std::uint64_t seed, double scale, int count) {
  Random random(seed);
  CollisionStep collision;
  double softest = 1.0, fastest = 0.0;
  for (int i = 0; i < count; ++i) {
    RandomSlide drawn = randomSlide(random, scale);
    const double off = smallestFeature(scale) * random.uniform(2.2, 4.0);
    Row row{.frame = drawn.frame};
    const double place = 0.6 * drawn.slide.distance;
    const double joint = random.chance(0.5) ? 0.0 : scale * random.uniform(0.001, 0.3);
    add(row, {.from = -8.0 * scale, .to = place - joint, .thickness = 0.3 * scale});
    add(row, {.from = place, .to = place + 2.0 * scale, .out = off, .thickness = 0.3 * scale});
    // The corner starts a little above the face that it will slide along.
    drawn.slide.gap = 0.001 * scale - off;
    const SlideResult result = slideAlong(collision, row, drawn.slide);
    EXPECT_GT(result.hardest, 0.5 * drawn.slide.speed) << i << ": " << off << " m";
    EXPECT_LT(result.slowest, 0.5 * drawn.slide.speed) << i << ": " << off << " m";
    softest = std::min(softest, result.hardest / drawn.slide.speed);
    fastest = std::max(fastest, result.slowest / drawn.slide.speed);
  }
  testing::Test::RecordProperty("softest_of_speed", testing::PrintToString(softest));
  testing::Test::RecordProperty("fastest_of_speed", testing::PrintToString(fastest));
}

TEST(WallsAsBuilt, LargeFeaturesCatch) { expectCaught(7404, 1.0, 60); }

TEST(WallsAsBuilt, LargeFeaturesCatchAModel) { expectCaught(7405, modelScale, 60); }

}  // namespace
}  // namespace bumper::tests
