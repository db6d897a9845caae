#include "bumper/response/angle_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "bumper/response/error.h"

namespace bumper::tests {
namespace {

constexpr double headOn = std::numbers::pi / 2.0;
constexpr double degree = std::numbers::pi / 180.0;

TEST(AngleCurve, ConstantIsConstant) {
  const AngleCurve curve = AngleCurve::constant(0.17);
  for (int i = 0; i <= 90; ++i) EXPECT_EQ(curve(i * degree), 0.17);
  EXPECT_EQ(curve.range(), (std::pair{0.17, 0.17}));
}

TEST(AngleCurve, CosinesRunFromGrazingToHeadOn) {
  const AngleCurve cosine = AngleCurve::cosine(0.3, 0.05);
  const AngleCurve half = AngleCurve::halfCosine(0.3, 0.05);
  for (const AngleCurve& curve : {cosine, half}) {
    EXPECT_NEAR(curve(0.0), 0.3, 1e-15);
    EXPECT_NEAR(curve(headOn), 0.05, 1e-15);
    EXPECT_NEAR(curve.range().first, 0.05, 1e-15);
    EXPECT_NEAR(curve.range().second, 0.3, 1e-15);
  }
  for (int i = 0; i <= 900; ++i) {
    const double angle = 0.1 * i * degree;
    EXPECT_NEAR(cosine(angle), 0.05 + 0.25 * std::cos(angle), 1e-15);
    EXPECT_NEAR(half(angle), 0.175 + 0.125 * std::cos(2.0 * angle), 1e-15);
  }
  // Rising curves have a range as well.
  EXPECT_NEAR(AngleCurve::cosine(0.1, 0.9).range().first, 0.1, 1e-15);
  EXPECT_NEAR(AngleCurve::cosine(0.1, 0.9).range().second, 0.9, 1e-15);
}

TEST(AngleCurve, TableIsStraightBetweenPointsAndConstantBeyond) {
  const AngleCurve curve =
      AngleCurve::table({{10.0 * degree, 0.4}, {30.0 * degree, 0.2}, {80.0 * degree, 0.6}});
  EXPECT_EQ(curve(0.0), 0.4);
  EXPECT_NEAR(curve(10.0 * degree), 0.4, 1e-15);
  EXPECT_NEAR(curve(15.0 * degree), 0.35, 1e-15);
  EXPECT_NEAR(curve(30.0 * degree), 0.2, 1e-15);
  EXPECT_NEAR(curve(55.0 * degree), 0.4, 1e-15);
  EXPECT_NEAR(curve(80.0 * degree), 0.6, 1e-15);
  EXPECT_EQ(curve(headOn), 0.6);
  EXPECT_EQ(curve.range(), (std::pair{0.2, 0.6}));
  EXPECT_EQ(AngleCurve::table({{0.3, 0.7}})(1.0), 0.7);
}

TEST(AngleCurve, RangeIsThatOfTheAnglesThatOccur) {
  // The last point lies beyond head-on: only half of the line to it is reached.
  const auto [low, high] = AngleCurve::table({{0.0, 0.0}, {2.0 * headOn, 1.0}}).range();
  EXPECT_NEAR(low, 0.0, 1e-15);
  EXPECT_NEAR(high, 0.5, 1e-15);
}

TEST(AngleCurve, BadValuesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_THROW(AngleCurve::constant(bad), Error);
    EXPECT_THROW(AngleCurve::cosine(bad, 0.1), Error);
    EXPECT_THROW(AngleCurve::cosine(0.1, bad), Error);
    EXPECT_THROW(AngleCurve::halfCosine(bad, 0.1), Error);
    EXPECT_THROW(AngleCurve::halfCosine(0.1, bad), Error);
  }
  EXPECT_THROW(AngleCurve::table({}), Error);
  EXPECT_THROW(AngleCurve::table({{0.0, nan}}), Error);
  EXPECT_THROW(AngleCurve::table({{0.0, infinity}}), Error);
  EXPECT_THROW(AngleCurve::table({{nan, 0.1}}), Error);
  EXPECT_THROW(AngleCurve::table({{0.0, 0.1}, {infinity, 0.1}}), Error);
  EXPECT_THROW(AngleCurve::table({{0.5, 0.1}, {0.5, 0.2}}), Error);
  EXPECT_THROW(AngleCurve::table({{0.5, 0.1}, {0.4, 0.2}}), Error);
  EXPECT_NO_THROW(AngleCurve::table({{0.4, 0.1}, {0.5, 0.2}}));
}

TEST(AttackDirection, IsFoldedAndCountsFromTheWall) {
  const Vector2 normal(0.0, 1.0);
  for (int i = -720; i <= 720; ++i) {
    const double angle = 0.5 * i * degree;
    const double folded = std::asin(std::abs(std::sin(angle)));
    const Vector2 direction = 7.0 * Vector2(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(attackOn(direction, normal).angle(), folded, 1e-7) << i;
    EXPECT_NEAR(attackOn(direction, -normal).angle(), folded, 1e-7) << i;
    EXPECT_GE(attackOn(direction, normal).angle(), 0.0);
    EXPECT_LE(attackOn(direction, normal).angle(), headOn);
  }
  EXPECT_NEAR(attackOn({1.0, 1e-9}, normal).angle(), 1e-9, 1e-20);
  EXPECT_NEAR(headOn - attackOn({1e-9, 1.0}, normal).angle(), 1e-9, 1e-15);
  EXPECT_EQ(attackOn(Vector2::Zero(), normal).angle(), 0.0);
}

TEST(AttackDirection, IsReadByACurveAsItsAngle) {
  for (const AngleCurve& curve :
       {AngleCurve::constant(0.4), AngleCurve::cosine(0.3, 0.05), AngleCurve::halfCosine(0.9, 0.04),
        AngleCurve::table({{0.2, 0.1}, {0.7, 0.5}, {1.2, 0.3}})}) {
    for (int i = 0; i <= 900; ++i) {
      const double angle = 0.1 * i * degree;
      const AttackDirection attack{.across = 17.0 * std::sin(angle),
                                   .along = 17.0 * std::abs(std::cos(angle))};
      EXPECT_NEAR(curve(attack), curve(angle), 1e-15) << i;
    }
    EXPECT_EQ(curve(AttackDirection{}), curve(0.0));
  }
}

}  // namespace
}  // namespace bumper::tests
