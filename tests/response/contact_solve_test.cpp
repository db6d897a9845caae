#include "bumper/response/contact_solve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "oracle.h"

namespace bumper::tests {
namespace {

// A few roundings of the terms that enter, in units of their size.
constexpr double rounding = 1e-14;

TEST(ContactSolve, MobilityIsTheVelocityThatAnImpulseGives) {
  Random random(101);
  for (int i = 0; i < 20'000; ++i) {
    const Situation s = randomImpact(random, i % 3 == 0 ? Other::vehicle : Other::barrier);
    const ContactMobility mobility = contactMobility(s.vehicle, s.other, s.normal);
    const auto change = [&](Real normal, Real tangent) {
      const Exact after = applied(s, normal, tangent);
      return Plane(after.normalAfter - normalBefore(s), after.tangentAfter - tangentBefore(s));
    };
    const Real unit = 1000.0L;
    const Plane byNormal = change(unit, 0.0L) / unit, byTangent = change(0.0L, unit) / unit;
    const double tolerance = rounding * (mobility.normal + mobility.tangent);
    ASSERT_NEAR(mobility.normal, static_cast<double>(byNormal.x()), tolerance) << s;
    ASSERT_NEAR(mobility.coupling, static_cast<double>(byNormal.y()), tolerance) << s;
    ASSERT_NEAR(mobility.coupling, static_cast<double>(byTangent.x()), tolerance) << s;
    ASSERT_NEAR(mobility.tangent, static_cast<double>(byTangent.y()), tolerance) << s;
    ASSERT_GT(mobility.determinant(), 0.0) << s;
  }
}

TEST(ContactSolve, VelocityAndEnergyAreThoseOfTheBodies) {
  Random random(102);
  for (int i = 0; i < 20'000; ++i) {
    const Situation s = randomImpact(random, i % 3 == 0 ? Other::vehicle : Other::barrier);
    const ContactMobility mobility = contactMobility(s.vehicle, s.other, s.normal);
    const ContactVelocity before = contactVelocity(s.vehicle, s.other, s.normal);
    const double speeds = s.vehicle.velocity.norm() + s.other.velocity.norm() +
                          std::abs(s.vehicle.yawRate) * s.vehicle.arm.norm() +
                          std::abs(s.other.yawRate) * s.other.arm.norm();
    ASSERT_NEAR(before.normal, static_cast<double>(normalBefore(s)), rounding * speeds) << s;
    ASSERT_NEAR(before.tangent, static_cast<double>(tangentBefore(s)), rounding * speeds) << s;

    const ContactImpulse impulse{.normal = random.uniform(-2e4, 5e4),
                                 .tangent = random.uniform(-3e4, 3e4)};
    const Exact exact = applied(s, impulse.normal, impulse.tangent);
    const ContactVelocity after = afterImpulse(before, mobility, impulse);
    const double size = speeds + (mobility.normal + mobility.tangent) *
                                     (std::abs(impulse.normal) + std::abs(impulse.tangent));
    ASSERT_NEAR(after.normal, static_cast<double>(exact.normalAfter), rounding * size) << s;
    ASSERT_NEAR(after.tangent, static_cast<double>(exact.tangentAfter), rounding * size) << s;
    ASSERT_NEAR(energyChange(before, mobility, impulse),
                static_cast<double>(exact.energyAfter - exact.energyBefore),
                rounding * size * (std::abs(impulse.normal) + std::abs(impulse.tangent)))
        << s;

    const PlanarImpulse onBody = onVehicle(impulse, s.normal, s.vehicle.arm);
    const double strength = std::abs(impulse.normal) + std::abs(impulse.tangent);
    ASSERT_NEAR(onBody.linear.x(), static_cast<double>(exact.impulse.x()), rounding * strength);
    ASSERT_NEAR(onBody.linear.y(), static_cast<double>(exact.impulse.y()), rounding * strength);
    const PlanarMotion motion =
        afterImpulse(PlanarMotion{.velocity = s.vehicle.velocity, .yawRate = s.vehicle.yawRate},
                     onBody, 1.0 / s.vehicle.inverseMass, 1.0 / s.vehicle.inverseYawInertia);
    ASSERT_NEAR(motion.velocity.x(), static_cast<double>(exact.vehicle.velocity.x()),
                rounding * size);
    ASSERT_NEAR(motion.velocity.y(), static_cast<double>(exact.vehicle.velocity.y()),
                rounding * size);
    ASSERT_NEAR(
        motion.yawRate, static_cast<double>(exact.vehicle.yawRate),
        rounding * (std::abs(s.vehicle.yawRate) + strength * 6.0 * s.vehicle.inverseYawInertia));
  }
}

TEST(ContactSolve, OnlyRelativeVelocityCounts) {
  Random random(103);
  for (int i = 0; i < 2'000; ++i) {
    const Situation s = randomImpact(random, Other::vehicle);
    Situation moving = s;
    const Vector2 common(random.uniform(-30.0, 30.0), random.uniform(-30.0, 30.0));
    moving.vehicle.velocity += common;
    moving.other.velocity += common;
    const ContactVelocity a = contactVelocity(s.vehicle, s.other, s.normal);
    const ContactVelocity b = contactVelocity(moving.vehicle, moving.other, moving.normal);
    ASSERT_NEAR(a.normal, b.normal, 1e-12) << s;
    ASSERT_NEAR(a.tangent, b.tangent, 1e-12) << s;
  }
}

TEST(PlanarMotion, HelpersMeanWhatTheySay) {
  EXPECT_EQ(cross({1.0, 0.0}, {0.0, 1.0}), 1.0);
  EXPECT_EQ(turnedLeft({1.0, 0.0}), Vector2(0.0, 1.0));
  EXPECT_LT((rotated({1.0, 0.0}, 0.5) - Vector2(std::cos(0.5), std::sin(0.5))).norm(), 1e-15);
  const PlanarMotion motion{.velocity = {3.0, 4.0}, .yawRate = 2.0};
  EXPECT_EQ(velocityAt(motion, {1.0, 0.5}), Vector2(2.0, 6.0));
  EXPECT_DOUBLE_EQ(yawPlaneEnergy(motion, 10.0, 3.0), 125.0 + 6.0);
  EXPECT_TRUE(isFinite(motion));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int which = 0; which < 6; ++which) {
    PlanarMotion bad = motion;
    double* const parts[] = {&bad.position.x(), &bad.position.y(), &bad.yaw,
                             &bad.velocity.x(), &bad.velocity.y(), &bad.yawRate};
    *parts[which] = which % 2 == 0 ? nan : std::numeric_limits<double>::infinity();
    EXPECT_FALSE(isFinite(bad)) << which;
  }
}

}  // namespace
}  // namespace bumper::tests
