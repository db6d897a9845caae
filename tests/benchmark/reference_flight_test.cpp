#include "reference_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "impact_cases.h"

/// The reference is held against what can be worked out by hand.
namespace bumper::benchmark {
namespace {

constexpr VehicleParameters car{.mass = 1500.0,
                                .yawInertia = 2500.0,
                                .massCentreToFront = 2.1,
                                .massCentreToRear = 2.5,
                                .width = 1.8,
                                .massCentreHeight = 0.55};
const StraightWall floorWall{.start = {-30.0, 0.0}, .end = {30.0, 0.0}};
constexpr double degree = std::numbers::pi / 180.0;

// Of times of about 0.1 s in double precision.
constexpr double timeRounding = 1e-16;

ResponseSettings fixedLaw(double restitution, double friction, double penetrationTime = 0.0) {
  ResponseSettings settings;
  settings.restitution = AngleCurve::constant(restitution);
  settings.friction = AngleCurve::constant(friction);
  settings.penetrationTime = penetrationTime;
  return settings;
}

TEST(ReferenceFlight, ACornerThatDoesNotTurnMeetsTheWallWhenItsHeightIsUsedUp) {
  for (int k = 1; k < 90; ++k) {
    const double yaw = -k * degree;
    const double lowest = 2.1 * std::sin(yaw) - 0.9 * std::cos(yaw);
    const PlanarMotion start{.position = {0.3, 2.0 - lowest}, .yaw = yaw, .velocity = {5.0, -20.0}};
    const Flight flight = freeFlight(car, start, floorWall, fixedLaw(0.3, 0.2), 0.2);
    ASSERT_FALSE(flight.impacts.empty());
    // The start's own height has a rounding of 2e-16 m.
    EXPECT_NEAR(flight.impacts[0].time, 2.0 / 20.0, 5e-17) << k;
  }
}

TEST(ReferenceFlight, ACornerThatTurnsMeetsTheWallAtTheArcCosine) {
  // The mass centre stands still over the wall, the car turns to the right.
  constexpr double turn = 3.0;  // rad/s
  for (const double height : {1.0, 1.7, 2.2, 2.6}) {
    const PlanarMotion start{.position = {0.0, height}, .yawRate = -turn};
    const Flight flight = freeFlight(car, start, floorWall, fixedLaw(0.0, 0.0), 3.0);
    double expected = 10.0;
    for (const Vector2& corner :
         {Vector2(2.1, 0.9), Vector2(-2.5, 0.9), Vector2(-2.5, -0.9), Vector2(2.1, -0.9)}) {
      if (corner.norm() <= height) continue;
      // From straight down, to the left; the corner touches at acos(height / reach) of it.
      const double touch = std::acos(height / corner.norm());
      double angle = std::atan2(corner.y(), corner.x()) + 90.0 * degree;
      if (angle < touch) angle += 2.0 * std::numbers::pi;
      expected = std::min(expected, (angle - touch) / turn);
    }
    ASSERT_FALSE(flight.impacts.empty());
    EXPECT_NEAR(flight.impacts[0].time, expected, 1e-15) << height;
  }
}

TEST(ReferenceFlight, AFlushHitReboundsWithoutTurning) {
  const PlanarMotion start{.position = {0.0, 1.9}, .velocity = {3.0, -10.0}};
  const Flight flight = freeFlight(car, start, floorWall, fixedLaw(0.4, 0.0, 0.0025), 0.3);
  // The middle of the side is 0.2 m behind the mass centre: the first impulse turns the car, the
  // second ends that corner's approach.
  EXPECT_NEAR(flight.impacts[0].time, 0.1, timeRounding);
  EXPECT_NEAR(flight.impacts[0].arm.x(), -0.2, 1e-15);
  // Symmetric about its mass centre it does not turn at all.
  VehicleParameters even = car;
  even.massCentreToRear = even.massCentreToFront;
  const Flight straight = freeFlight(even, start, floorWall, fixedLaw(0.4, 0.0, 0.0025), 0.3);
  EXPECT_EQ(straight.impulses, 1);
  EXPECT_NEAR(straight.end.velocity.y(), 4.0, 1e-14);
  EXPECT_NEAR(straight.end.position.y(), 0.9 + 4.0 * 0.2, 1e-14);
  EXPECT_NEAR(straight.end.yawRate, 0.0, 1e-15);
}

TEST(ReferenceFlight, AWallsEndPushesAlongTheSidesNormal) {
  // The wall's end stands in the middle of the car's way, the wall behind it askew.
  const StraightWall wall{.start = {0.0, 0.0}, .end = {10.0, 10.0}};
  const PlanarMotion start{.position = {-2.1 - 1.0, 0.0}, .velocity = {20.0, 0.0}};
  const Flight flight = freeFlight(car, start, wall, fixedLaw(0.25, 0.5), 0.2);
  ASSERT_EQ(flight.impulses, 1);
  EXPECT_NEAR(flight.impacts[0].time, 0.05, timeRounding);
  EXPECT_NEAR(flight.end.velocity.x(), -5.0, 1e-14);
  EXPECT_NEAR(flight.end.velocity.y(), 0.0, 1e-14);
  EXPECT_NEAR(flight.end.yawRate, 0.0, 1e-14);
}

TEST(ReferenceFlight, ACornerBesideTheWallPassesIt) {
  const StraightWall wall{.start = {-30.0, 0.0}, .end = {-1.0, 0.0}};
  const PlanarMotion start{.position = {2.6, 1.0}, .velocity = {0.0, -20.0}};
  EXPECT_TRUE(freeFlight(car, start, wall, fixedLaw(0.2, 0.2), 1.0).impacts.empty());
}

TEST(ReferenceFlight, AGrazeIsNoImpact) {
  // The corner turns down to 1 µm over the wall and up again.
  const PlanarMotion start{
      .position = {0.0, std::hypot(2.1, 0.9) + 1e-6}, .yaw = -20.0 * degree, .yawRate = -1.0};
  const Flight flight = freeFlight(car, start, floorWall, fixedLaw(0.2, 0.2), 1.2);
  EXPECT_TRUE(flight.impacts.empty());
  PlanarMotion lower = start;
  lower.position.y() -= 2e-6;
  EXPECT_FALSE(freeFlight(car, lower, floorWall, fixedLaw(0.2, 0.2), 1.2).impacts.empty());
}

/// Random cases of every kind.
class ReferenceCases : public ::testing::Test {
 protected:
  const std::vector<ImpactCase> cases_ = makeCases(readCars(BUMPER_VEHICLES), 100, 1000, 7);
};

TEST_F(ReferenceCases, MomentumIsWhatTheImpulsesGave) {
  for (const ImpactCase& one : cases_) {
    const Flight flight = freeFlight(one.car.body, one.start, theWall(), one.law.settings, 0.4);
    PlanarImpulse sum;
    for (const FlightImpact& impact : flight.impacts) sum += impact.impulse;
    const VehicleParameters& body = one.car.body;
    const double scale = body.mass * one.start.velocity.norm();
    EXPECT_LE((body.mass * (flight.end.velocity - one.start.velocity) - sum.linear).norm(),
              1e-11 * scale);
    EXPECT_NEAR(body.yawInertia * (flight.end.yawRate - one.start.yawRate), sum.angular,
                1e-11 * scale);
  }
}

TEST_F(ReferenceCases, NoImpactGivesEnergy) {
  for (const ImpactCase& one : cases_) {
    const VehicleParameters& body = one.car.body;
    const Flight flight = freeFlight(body, one.start, theWall(), one.law.settings, 0.4);
    double energy = yawPlaneEnergy(one.start, body.mass, body.yawInertia);
    for (const FlightImpact& impact : flight.impacts) {
      const double after = yawPlaneEnergy(impact.after, body.mass, body.yawInertia);
      ASSERT_LE(after, energy * (1.0 + 1e-14)) << nameOf(one.kind);
      energy = after;
    }
    EXPECT_TRUE(flight.settled);
  }
}

// The wall is looked at this finely, m.
constexpr double sampling = 4e-3;

/// How deep the outline is in the wall, m: of points along the wall the one that has the longest
/// way out of the outline.
double depthIn(const VehicleParameters& body, const PlanarMotion& motion) {
  const StraightWall wall = theWall();
  const Vector2 a = rotated(wall.start - motion.position, -motion.yaw);
  const Vector2 b = rotated(wall.end - motion.position, -motion.yaw);
  const double length = (b - a).norm();
  const Vector2 along = (b - a) / length;
  const double nearest = -a.dot(along);
  constexpr double reach = 4.0;  // no car is longer to either side
  double deepest = 0.0;
  const double from = std::max(0.0, nearest - reach);
  const auto samples =
      static_cast<int>((std::min(length, nearest + reach) - from) / sampling);  // < 0: far away
  for (int k = 0; k <= samples; ++k) {
    const Vector2 p = a + (from + k * sampling) * along;
    deepest =
        std::max(deepest, std::min({body.massCentreToFront - p.x(), body.massCentreToRear + p.x(),
                                    0.5 * body.width - std::abs(p.y())}));
  }
  return deepest;
}

TEST_F(ReferenceCases, TheWallIsNeverInsideTheOutline) {
  // A corner on the wall has no point inside; one deeper than this has, but for the sampling.
  constexpr double rounding = 1e-8;
  for (const ImpactCase& one : cases_) {
    const Flight flight = freeFlight(one.car.body, one.start, theWall(), one.law.settings, 0.4);
    EXPECT_LE(depthIn(one.car.body, flight.end), rounding) << nameOf(one.kind);
    if (flight.lasting) continue;  // between its instants it does not fly straight
    for (int i = 0; i <= 20; ++i) {
      EXPECT_LE(depthIn(one.car.body, motionAt(flight, one.start, 0.02 * i)), rounding)
          << nameOf(one.kind) << ' ' << i;
    }
  }
}

/// The motion as seen in a mirror that stands across the wall's middle.
PlanarMotion mirrored(PlanarMotion motion) {
  motion.position.x() = -motion.position.x();
  motion.velocity.x() = -motion.velocity.x();
  motion.yaw = std::numbers::pi - motion.yaw;
  motion.yawRate = -motion.yawRate;
  return motion;
}

TEST(ReferenceFlight, TheMirrorImageIsTheMirrorsImage) {
  for (int k = 0; k < 60; ++k) {
    const PlanarMotion start{.position = {0.4, 4.0},
                             .yaw = (6.0 * k + 1.0) * degree,
                             .velocity = {20.0 * std::cos(k), -15.0},
                             .yawRate = 2.0 * std::sin(3.0 * k)};
    const ResponseSettings settings = fixedLaw(0.3, 0.4, 0.0025);
    const Flight flight = freeFlight(car, start, floorWall, settings, 0.6);
    const Flight image = freeFlight(car, mirrored(start), floorWall, settings, 0.6);
    const PlanarMotion end = mirrored(flight.end);
    ASSERT_EQ(flight.impulses, image.impulses) << k;
    ASSERT_GT(flight.impulses, 0);
    EXPECT_LE((image.end.position - end.position).norm(), 1e-11) << k;
    EXPECT_LE((image.end.velocity - end.velocity).norm(), 1e-11) << k;
    EXPECT_NEAR(image.end.yawRate, end.yawRate, 1e-11) << k;
  }
}

TEST(ReferenceFlight, UnderNoForceItIsTheFreeFlight) {
  const auto none = [](const PlanarMotion&) { return PlanarForce{}; };
  const PlanarMotion start{.position = {0.0, 3.0}, .yaw = -0.4, .velocity = {20.0, -10.0}};
  const ResponseSettings settings = fixedLaw(0.3, 0.4, 0.0025);
  const Flight one = freeFlight(car, start, floorWall, settings, 0.4);
  const Flight other = forcedFlight(car, start, floorWall, settings, 0.4, none, 0.01);
  ASSERT_EQ(one.impulses, other.impulses);
  EXPECT_LE((one.end.position - other.end.position).norm(), 1e-13);
}

TEST(ReferenceFlight, UnderAConstantForceAThrownCarLandsOnTime) {
  constexpr double pull = 8.0;  // m/s²
  const auto down = [](const PlanarMotion&) {
    return PlanarForce{.force = {0.0, -pull * car.mass}, .yawMoment = 0.0};
  };
  VehicleParameters even = car;
  even.massCentreToRear = even.massCentreToFront;
  const PlanarMotion start{.position = {0.0, 0.9 + 1.0}, .velocity = {1.0, 0.0}};
  const double lands = std::sqrt(2.0 / pull);
  double last = 0.0;
  for (const double step : {0.02, 0.01, 0.005}) {
    const Flight flight = forcedFlight(even, start, floorWall, fixedLaw(0.0, 0.0), 0.8, down, step);
    ASSERT_FALSE(flight.impacts.empty());
    const double error = std::abs(flight.impacts[0].time - lands);
    EXPECT_LE(error, 0.2 * step * step / lands) << step;  // second order
    last = error;
    // It stays where it fell.
    EXPECT_NEAR(flight.end.position.y(), 0.9, 1e-3 * step);
    EXPECT_LE(std::abs(flight.end.velocity.y()), pull * step);
  }
  EXPECT_LE(last, 1e-5);
}

TEST(ReferenceFlight, AnEndBesideACornerTouchesOneSideOnly) {
  // Close to the front left corner, on the front: nothing pushes sideways.
  for (const double off : {2e-9, 5e-9, 5e-8, 1e-6}) {
    const StraightWall wall{.start = {2.1, 0.9 - off}, .end = {30.0, 5.0}};
    const PlanarMotion start{.position = {-0.5, 0.0}, .velocity = {20.0, 0.0}};
    const Flight flight = freeFlight(car, start, wall, fixedLaw(0.1, 0.0, 0.0025), 0.026);
    EXPECT_EQ(flight.impulses, 1) << off;
    EXPECT_NEAR(flight.end.velocity.y(), 0.0, 1e-14) << off;
  }
}

TEST(ReferenceFlight, APressingEndStaysOnItsSideAndTakesEnergy) {
  // The end meets the left side ahead of the mass centre and turns the car to the right: seen from
  // the car, Coriolis then presses the end on.
  const StraightWall wall{.start = {1.5, 0.9}, .end = {1.5, 20.0}};
  const PlanarMotion start{.position = {0.0, -0.01}, .velocity = {10.0, 1.0}};
  const auto place = [&](const PlanarMotion& motion) {
    return rotated(wall.start - motion.position, -motion.yaw);
  };
  const ResponseSettings settings = fixedLaw(0.0, 0.1);
  double energy = yawPlaneEnergy(start, car.mass, car.yawInertia);
  for (const double duration : {0.05, 0.1, 0.15, 0.2}) {
    const Flight flight = freeFlight(car, start, wall, settings, duration);
    ASSERT_TRUE(flight.lasting) << duration;
    EXPECT_GT(place(flight.end).x(), -2.5);
    EXPECT_NEAR(place(flight.end).y(), 0.9, 1e-7) << duration;
    const double left = yawPlaneEnergy(flight.end, car.mass, car.yawInertia);
    EXPECT_LT(left, energy) << duration;
    energy = left;
  }
}

}  // namespace
}  // namespace bumper::benchmark
