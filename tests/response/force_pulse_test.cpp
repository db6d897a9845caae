#include "bumper/response/force_pulse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "random_impacts.h"

namespace bumper::tests {
namespace {

PlanarImpulse randomImpulse(Random& random) {
  return {.linear = {random.uniform(-4e4, 4e4), random.uniform(-4e4, 4e4)},
          .angular = random.uniform(-3e4, 3e4)};
}

// Some roundings of impulses of 4e4 N s, N s.
constexpr double rounding = 1e-9;

TEST(ForcePulse, DeliversExactlyTheImpulseOverAnySteps) {
  Random random(501);
  for (int run = 0; run < 5'000; ++run) {
    ForcePulse pulse;
    PlanarImpulse asked, delivered;
    for (int k = 0; k < 12; ++k) {
      const double step = random.chance(0.2) ? 0.0 : std::pow(10.0, random.uniform(-4.0, -1.7));
      for (int n = random.below(4); k < 8 && step > 0.0 && n > 0; --n) {
        const PlanarImpulse impulse = randomImpulse(random);
        const double start = random.chance(0.2)   ? 0.0
                             : random.chance(0.2) ? step
                                                  : random.uniform(0.0, step);
        pulse.add(impulse, start, step);
        asked.linear += impulse.linear;
        asked.angular += impulse.angular;
      }
      const PlanarForce force = pulse.take(step);
      delivered.linear += step * force.force;
      delivered.angular += step * force.yawMoment;
      ASSERT_TRUE(force.force.allFinite() && std::isfinite(force.yawMoment));
      // Nothing is lost on the way.
      ASSERT_NEAR((delivered.linear + pulse.pending().linear - asked.linear).norm(), 0.0, rounding);
      ASSERT_NEAR(delivered.angular + pulse.pending().angular, asked.angular, rounding);
    }
    for (int k = 0; k < 2; ++k) {
      const PlanarForce force = pulse.take(0.005);
      delivered.linear += 0.005 * force.force;
      delivered.angular += 0.005 * force.yawMoment;
    }
    ASSERT_EQ(pulse.pending().linear, Vector2::Zero());
    ASSERT_EQ(pulse.pending().angular, 0.0);
    ASSERT_NEAR((delivered.linear - asked.linear).norm(), 0.0, rounding);
    ASSERT_NEAR(delivered.angular, asked.angular, rounding);
  }
}

TEST(ForcePulse, StartsAtTheImpactAndLastsOneStep) {
  ForcePulse pulse;
  pulse.add({.linear = {1000.0, -500.0}, .angular = 300.0}, 0.001, 0.004);
  const PlanarForce first = pulse.take(0.004);
  EXPECT_NEAR(first.force.x(), 1000.0 / 0.004 * 0.75, 1e-8);
  EXPECT_NEAR(first.force.y(), -500.0 / 0.004 * 0.75, 1e-8);
  EXPECT_NEAR(first.yawMoment, 300.0 / 0.004 * 0.75, 1e-8);
  EXPECT_NEAR(pulse.pending().linear.x(), 250.0, 1e-12);
  // The next step has another size.
  const PlanarForce second = pulse.take(0.01);
  EXPECT_NEAR(second.force.x(), 250.0 / 0.01, 1e-9);
  EXPECT_NEAR(second.yawMoment, 75.0 / 0.01, 1e-9);
  EXPECT_EQ(pulse.take(0.01).force, Vector2::Zero());
}

TEST(ForcePulse, AStepOfZeroKeepsEverything) {
  ForcePulse pulse;
  pulse.add({.linear = {1000.0, 0.0}, .angular = 10.0}, 0.002, 0.005);
  for (int k = 0; k < 3; ++k) {
    const PlanarForce force = pulse.take(0.0);
    EXPECT_EQ(force.force, Vector2::Zero());
    EXPECT_EQ(force.yawMoment, 0.0);
    EXPECT_EQ(pulse.pending().linear.x(), 1000.0);
  }
  EXPECT_NEAR(pulse.take(0.005).force.x(), 1000.0 * 0.6 / 0.005, 1e-9);
  pulse.take(0.0);
  EXPECT_NEAR(pulse.pending().linear.x(), 400.0, 1e-12);
}

TEST(ForcePulse, DropForgets) {
  ForcePulse pulse;
  pulse.add({.linear = {1000.0, 0.0}, .angular = 10.0}, 0.002, 0.005);
  pulse.take(0.005);
  pulse.drop();
  EXPECT_EQ(pulse.pending().linear, Vector2::Zero());
  EXPECT_EQ(pulse.pending().angular, 0.0);
  EXPECT_EQ(pulse.take(0.005).force, Vector2::Zero());
}

// A body moved as ODE moves it, v += h F / m, x += h v, must be where the true body is whose
// velocity jumps at each impact: positions at each step's end once the step held no impact or held
// them from its start on (physics of the impact trajectory: x + v τ + v' (h − τ)).
TEST(ForcePulse, FollowsTheTrueTrajectory) {
  Random random(502);
  constexpr double mass = 1500.0, inertia = 2600.0;
  double worst = 0.0;
  for (int run = 0; run < 2'000; ++run) {
    ForcePulse pulse;
    Vector2 x = Vector2::Zero(), exactX = Vector2::Zero();
    Vector2 v(random.uniform(-30.0, 30.0), random.uniform(-30.0, 30.0)), exactV = v;
    double yaw = 0.0, exactYaw = 0.0, rate = random.uniform(-3.0, 3.0), exactRate = rate;
    for (int k = 0; k < 40; ++k) {
      const double step = random.uniform(0.0005, 0.02);
      std::vector<double> times;
      if (k < 38 && random.chance(0.3)) {
        for (int n = 1 + random.below(3); n > 0; --n) times.push_back(random.uniform(0.0, step));
      }
      std::sort(times.begin(), times.end());
      double now = 0.0;
      for (const double time : times) {
        const PlanarImpulse impulse = randomImpulse(random);
        pulse.add(impulse, time, step);
        exactX += (time - now) * exactV;
        exactYaw += (time - now) * exactRate;
        exactV += impulse.linear / mass;
        exactRate += impulse.angular / inertia;
        now = time;
      }
      exactX += (step - now) * exactV;
      exactYaw += (step - now) * exactRate;

      const PlanarForce force = pulse.take(step);
      v += step * force.force / mass;
      rate += step * force.yawMoment / inertia;
      x += step * v;
      yaw += step * rate;
      worst = std::max({worst, (x - exactX).norm(), std::abs(yaw - exactYaw)});
      if (pulse.pending().linear == Vector2::Zero()) {
        worst = std::max({worst, (v - exactV).norm(), std::abs(rate - exactRate)});
      }
    }
    ASSERT_EQ(pulse.pending().linear, Vector2::Zero());
  }
  EXPECT_LT(worst, 1e-9);
}

}  // namespace
}  // namespace bumper::tests
