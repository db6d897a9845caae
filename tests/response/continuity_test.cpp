#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "bumper/response/collision_step.h"
#include "car.h"

/// A small change of the approach changes the answer little: one car, one flat wall, every tenth of
/// a degree.
namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double sixtyMilesPerHour = 26.8224;  // m/s

struct Rebound {
  double yawRate = 0.0;  ///< °/s, positive to the left
  double speed = 0.0;    ///< of the mass centre away from the wall, m/s
};

/// How far the car's second corner is behind its first at a wall on its left at `heading` to it, m.
double secondCorner(double heading) {
  const Vector2 normal(-std::sin(heading), -std::cos(heading));
  std::array<double, 4> heights{};
  std::ranges::transform(Outline(car).corners(), heights.begin(),
                         [&](const Vector2& corner) { return normal.dot(corner); });
  std::ranges::sort(heights);
  return heights[1] - heights[0];
}

// So shallow that only one corner is inside when the step notices, m.
constexpr double shallow = 1e-5;

/// The car drives along its x axis at 60 mph into a wall on its left at `heading` to it, and is
/// `depth` inside when the step notices.
Rebound afterHit(double heading, double penetrationTime, double depth = shallow) {
  ResponseSettings settings;
  settings.penetrationTime = penetrationTime;
  const Vector2 normal(-std::sin(heading), -std::cos(heading));
  double lowest = 0.0;
  for (const Vector2& corner : Outline(car).corners())
    lowest = std::min(lowest, normal.dot(corner));
  const Vector2 middle = (lowest + depth) * normal;
  const Segment wall{.start = middle - 50.0 * turnedLeft(normal),
                     .end = middle + 50.0 * turnedLeft(normal),
                     .normal = normal,
                     .id = 0};
  const PlanarMotion motion{.velocity = {sixtyMilesPerHour, 0.0}};
  CollisionStep step;
  const Surface surface{.settings = &settings};
  const StepOutcome outcome = step.resolve(car, motion, {{&wall, 1}, {&surface, 1}}, 0.0);
  EXPECT_TRUE(outcome.settled) << heading / degree;
  EXPECT_LE(yawPlaneEnergy(outcome.after, car.mass, car.yawInertia),
            yawPlaneEnergy(motion, car.mass, car.yawInertia) * (1.0 + 1e-12))
      << heading / degree;
  return {outcome.after.yawRate / degree, outcome.after.velocity.dot(normal)};
}

// A prototype of the same definitions, written apart from the library; given in whole °/s.
constexpr double prototypeRounding = 0.6;

TEST(Continuity, YawRatesOfThePrototype) {
  constexpr std::array<double, 10> headings = {5, 20, 45, 70, 80, 84, 86, 88, 89.9, 90};
  const std::pair<double, std::array<double, 10>> table[] = {
      {0.0, {-57, -219, -257, 203, 345, 466, 510, 545, 570, 0}},
      {0.0025, {-57, -219, -262, 188, 208, 264, 211, -47, -2, 0}},
      {0.010, {-58, -220, -278, 34, -96, -132, -87, -43, -2, 0}}};
  for (const auto& [penetrationTime, yawRates] : table) {
    for (std::size_t i = 0; i < headings.size(); ++i) {
      EXPECT_NEAR(afterHit(headings[i] * degree, penetrationTime).yawRate, yawRates[i],
                  prototypeRounding)
          << headings[i] << "° " << penetrationTime;
    }
  }
}

TEST(Continuity, NothingJumpsWithTheHeading) {
  // Penetration time, steepest change of the yaw rate and of the rebound per 0.1°.
  struct Bound {
    double penetrationTime, yawRate, speed;
  };
  for (const auto& [penetrationTime, yawRate, speed] :
       {Bound{0.0025, 33.5, 0.5}, Bound{0.010, 7.5, 0.2}, Bound{0.050, 3.0, 0.1}}) {
    Rebound last = afterHit(0.0, penetrationTime);
    double steepestYaw = 0.0, steepestSpeed = 0.0;
    for (int i = 1; i <= 1800; ++i) {
      const Rebound next = afterHit(0.1 * i * degree, penetrationTime);
      const double changeYaw = std::abs(next.yawRate - last.yawRate);
      const double changeSpeed = std::abs(next.speed - last.speed);
      EXPECT_LE(changeYaw, yawRate) << 0.1 * i << "° " << penetrationTime;
      EXPECT_LE(changeSpeed, speed) << 0.1 * i << "° " << penetrationTime;
      steepestYaw = std::max(steepestYaw, changeYaw);
      steepestSpeed = std::max(steepestSpeed, changeSpeed);
      last = next;
    }
    RecordProperty("steepest_yaw_rate_per_tenth_degree_" + std::to_string(penetrationTime),
                   std::to_string(steepestYaw));
    RecordProperty("steepest_speed_per_tenth_degree_" + std::to_string(penetrationTime),
                   std::to_string(steepestSpeed));
  }
}

TEST(Continuity, HeadingsBeyondHeadOnAreTheMirror) {
  for (int i = 0; i < 900; ++i) {
    const Rebound near = afterHit(0.1 * i * degree, 0.0025);
    const Rebound beyond = afterHit((180.0 - 0.1 * i) * degree, 0.0025);
    ASSERT_NEAR(near.yawRate, -beyond.yawRate, 1e-6) << i;
    ASSERT_NEAR(near.speed, beyond.speed, 1e-9) << i;
  }
}

TEST(Continuity, TheStepsOwnDepthDoesNotMatter) {
  for (int i = 1; i < 90; ++i) {
    // As long as the second corner is not in the wall as well.
    const double depth = std::min(0.13, 0.9 * secondCorner(i * degree));
    const Rebound early = afterHit(i * degree, 0.0025);
    const Rebound late = afterHit(i * degree, 0.0025, depth);
    ASSERT_NEAR(early.yawRate, late.yawRate, 1e-6) << i;
    ASSERT_NEAR(early.speed, late.speed, 1e-9) << i;
  }
}

// Restitution that comes out of the energy law, for contacts that stay where they are on the body.
TEST(Continuity, EnergyLawDoesNotJumpWithTheAngle) {
  ResponseSettings settings;
  settings.law = Law::energy;
  settings.restSpeed = 0.0;  // the fading of slow contacts is another matter
  const std::array<Vector2, 4> corners = Outline(car).corners();
  const std::pair<const char*, Vector2> contacts[] = {{"front left", corners[0]},
                                                      {"rear left", corners[1]},
                                                      {"rear right", corners[2]},
                                                      {"front right", corners[3]},
                                                      {"flush side", Vector2::Zero()}};
  int jumpsOverAVanishingRoot = 0;
  for (const auto& [name, arm] : contacts) {
    double last = 0.0;
    bool lastReal = false;
    for (int i = 1; i <= 900; ++i) {
      const double angle = 0.1 * i * degree;
      // The wall lies to the left at `angle` to the direction of travel. A flush contact acts
      // through the mass centre.
      Impact impact;
      impact.normal = {-std::sin(angle), -std::cos(angle)};
      impact.arm = arm == Vector2::Zero() ? Vector2(-0.9 * impact.normal) : arm;
      const PlanarMotion motion{.velocity = {sixtyMilesPerHour, 0.0}};
      const ImpactResponse response = respond(impact, freeBody(car, motion), settings);
      const ContactBody body{.inverseMass = 1.0 / car.mass,
                             .inverseYawInertia = 1.0 / car.yawInertia,
                             .arm = impact.arm,
                             .velocity = motion.velocity};
      const bool real =
          energyRoots(contactMobility(body, {}, impact.normal),
                      contactVelocity(body, {}, impact.normal),
                      {.energyRatio = response.energyAsked,
                       .energyBefore = yawPlaneEnergy(motion, car.mass, car.yawInertia),
                       .friction = response.friction})
              .real;
      if (i > 1) {
        if (real == lastReal) {
          ASSERT_LE(std::abs(response.restitution - last), 0.05) << name << ' ' << 0.1 * i << "°";
        } else {
          ++jumpsOverAVanishingRoot;
        }
      }
      ASSERT_GE(response.restitution, -1e-12) << name << ' ' << 0.1 * i;
      ASSERT_LE(response.restitution, settings.maxRestitution + 1e-12) << name << ' ' << 0.1 * i;
      last = response.restitution;
      lastReal = real;
    }
  }
  EXPECT_LE(jumpsOverAVanishingRoot, 10);  // the exception is rare
}

}  // namespace
}  // namespace bumper::tests
