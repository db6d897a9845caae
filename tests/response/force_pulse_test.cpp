#include "bumper/response/force_pulse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
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

PlanarImpulse turnedBy(const PlanarImpulse& impulse, double angle) {
  return {.linear = rotated(impulse.linear, angle), .angular = impulse.angular};
}

PlanarImpulse delivered(const PlanarForce& force, double step) {
  return {.linear = step * force.force, .angular = step * force.yawMoment};
}

void expectSame(const PlanarImpulse& a, const PlanarImpulse& b, const std::string& where) {
  ASSERT_NEAR((a.linear - b.linear).norm(), 0.0, rounding) << where;
  ASSERT_NEAR(a.angular, b.angular, rounding) << where;
}

// Whatever is asked in whatever order, and however the steps are cut: what was delivered and what
// is pending is what was asked, and due() foretells take().
TEST(ForcePulse, NothingIsLostInAnySequence) {
  Random random(503);
  for (int run = 0; run < 20'000; ++run) {
    ForcePulse pulse;
    PlanarImpulse open;  // asked and not delivered
    double longest = 0.0;
    for (int k = 0; k < 25; ++k) {
      const std::string where = std::to_string(run) + '/' + std::to_string(k);
      const double step = random.chance(0.1) ? 0.0 : std::pow(10.0, random.uniform(-4.0, -1.3));
      for (int n = random.below(4); n > 0; --n) {
        const PlanarImpulse impulse = randomImpulse(random);
        switch (random.below(4)) {
          case 0:
            if (step == 0.0) break;
            pulse.add(impulse, random.uniform(0.0, step), step);
            open += impulse;
            break;
          case 1: {
            const double duration = std::pow(10.0, random.uniform(-3.0, -0.5));
            pulse.addLong(impulse, random.uniform(0.0, step), duration);
            longest = std::max(longest, step + duration);
            open += impulse;
            break;
          }
          case 2:
            pulse.shift(impulse);  // given and taken back: nothing in the end
            break;
          default:
            pulse.owe(impulse);
            open += impulse;
            break;
        }
      }
      if (random.chance(0.3)) {
        const double angle = random.uniform(-3.0, 3.0);
        pulse.turnFrame(rotated(Vector2::UnitX(), angle));
        open = turnedBy(open, -angle);
      }
      expectSame(pulse.pending(), open, where + " pending");
      const PlanarImpulse due = pulse.due(step);
      const PlanarImpulse given = delivered(pulse.take(step), step);
      if (step > 0.0) expectSame(due, given, where + " due");
      open.linear -= given.linear;
      open.angular -= given.angular;
      expectSame(pulse.pending(), open, where + " after");
      if (HasFatalFailure()) return;
    }
    // Two steps for what is short, and as long as it takes for the others.
    for (const double step : {0.003, longest, 0.001, 0.001}) {
      const PlanarImpulse given = delivered(pulse.take(step), step);
      open.linear -= given.linear;
      open.angular -= given.angular;
    }
    expectSame(open, {}, std::to_string(run) + " in the end");
    ASSERT_TRUE(pulse.isEmpty()) << run;
    ASSERT_EQ(pulse.take(0.01).force, Vector2::Zero()) << run;
    if (HasFatalFailure()) return;
  }
}

TEST(ForcePulse, ALongPulseIsAConstantForceFromItsImpactOn) {
  Random random(504);
  for (int run = 0; run < 20'000; ++run) {
    ForcePulse pulse;
    struct Asked {
      PlanarImpulse impulse;
      double from, duration;
    };
    std::vector<Asked> asked;
    double time = 0.0;
    PlanarImpulse sum;
    for (int k = 0; k < 30; ++k) {
      const double step = std::pow(10.0, random.uniform(-4.0, -1.5));
      while (asked.size() < ForcePulse::maxLong && random.chance(0.2)) {
        const double start = random.uniform(0.0, step);
        asked.push_back({.impulse = randomImpulse(random),
                         .from = time + start,
                         .duration = std::pow(10.0, random.uniform(-3.0, -1.0))});
        pulse.addLong(asked.back().impulse, start, asked.back().duration);
      }
      sum += delivered(pulse.take(step), step);
      time += step;
      PlanarImpulse expected;
      for (const Asked& a : asked) {
        const double share = std::clamp((time - a.from) / a.duration, 0.0, 1.0);
        expected += {.linear = share * a.impulse.linear, .angular = share * a.impulse.angular};
      }
      // A share of a millisecond's pulse is known to the rounding of the clock.
      ASSERT_NEAR((sum.linear - expected.linear).norm(), 0.0, 10.0 * rounding) << run << '/' << k;
      ASSERT_NEAR(sum.angular, expected.angular, 10.0 * rounding) << run << '/' << k;
      if (HasFatalFailure()) return;
    }
  }
}

TEST(ForcePulse, OneLongPulseTooManyIsStillDelivered) {
  ForcePulse pulse;
  PlanarImpulse asked, sum;
  Random random(505);
  for (std::size_t k = 0; k < 3 * ForcePulse::maxLong; ++k) {
    const PlanarImpulse impulse = randomImpulse(random);
    pulse.addLong(impulse, 0.001, random.uniform(0.01, 0.1));
    asked += impulse;
    expectSame(pulse.pending(), asked, std::to_string(k));
  }
  for (int k = 0; k < 200; ++k) sum += delivered(pulse.take(0.001), 0.001);
  expectSame(sum, asked, "in the end");
  EXPECT_TRUE(pulse.isEmpty());
}

TEST(ForcePulse, AShiftMovesAndLeavesTheVelocity) {
  Random random(506);
  constexpr double mass = 1500.0;
  for (int run = 0; run < 5'000; ++run) {
    ForcePulse pulse;
    const double step = random.uniform(0.0005, 0.02), next = random.uniform(0.0005, 0.02);
    const PlanarImpulse impulse = randomImpulse(random);
    pulse.shift(impulse);
    ASSERT_FALSE(pulse.isEmpty());
    const Vector2 velocity = step * pulse.take(step).force / mass;
    ASSERT_NEAR((step * velocity - step * impulse.linear / mass).norm(), 0.0, 1e-12) << run;
    const Vector2 after = velocity + next * pulse.take(next).force / mass;
    ASSERT_NEAR(after.norm(), 0.0, 1e-12) << run;
    ASSERT_TRUE(pulse.isEmpty());
  }
}

TEST(ForcePulse, WhatIsOwedComesInTheNextStep) {
  ForcePulse pulse;
  EXPECT_TRUE(pulse.isEmpty());
  pulse.owe({.linear = {300.0, -100.0}, .angular = 40.0});
  EXPECT_FALSE(pulse.isEmpty());
  EXPECT_EQ(pulse.due(0.0).linear, Vector2::Zero());
  const PlanarForce force = pulse.take(0.01);
  EXPECT_NEAR(force.force.x(), 3e4, 1e-9);
  EXPECT_NEAR(force.force.y(), -1e4, 1e-9);
  EXPECT_NEAR(force.yawMoment, 4e3, 1e-9);
  EXPECT_TRUE(pulse.isEmpty());
}

TEST(ForcePulse, TurnsWithTheFrame) {
  ForcePulse pulse;
  pulse.add({.linear = {100.0, 0.0}, .angular = 7.0}, 0.002, 0.004);
  pulse.addLong({.linear = {0.0, 50.0}, .angular = 0.0}, 0.0, 0.1);
  const PlanarImpulse before = pulse.pending();
  // The frame's axes turn left, so that an impulse along its old x axis now points to its right.
  pulse.turnFrame(rotated(Vector2::UnitX(), 0.5));
  EXPECT_NEAR((pulse.pending().linear - rotated(before.linear, -0.5)).norm(), 0.0, 1e-12);
  EXPECT_EQ(pulse.pending().angular, before.angular);
}

// The true body, in extended precision: the velocity jumps at each impact. Speeds of a car, some
// tens of metres: what is left is rounding of the sums.
TEST(ForcePulse, PositionIsExactToRounding) {
  Random random(507);
  constexpr double mass = 1500.0;
  double worst = 0.0;
  for (int run = 0; run < 20'000; ++run) {
    ForcePulse pulse;
    double x = 0.0, v = random.uniform(-30.0, 30.0);
    long double exactX = 0.0L, exactV = v;
    for (int k = 0; k < 12; ++k) {
      const double step = std::pow(10.0, random.uniform(-3.5, -1.7));
      for (int n = random.below(5); n > 0; --n) {
        const PlanarImpulse impulse{.linear = {random.uniform(-4e4, 4e4), 0.0}, .angular = 0.0};
        const double time = random.uniform(0.0, step);
        pulse.add(impulse, time, step);
        // Its part of this step; impacts superpose, so their order does not matter.
        exactX += static_cast<long double>(impulse.linear.x()) / mass *
                  (static_cast<long double>(step) - time);
        exactV += static_cast<long double>(impulse.linear.x()) / mass;
        exactX -= static_cast<long double>(impulse.linear.x()) / mass * step;
      }
      exactX += exactV * step;
      v += step * pulse.take(step).force.x() / mass;
      x += step * v;
      worst = std::max(worst, static_cast<double>(std::abs(x - exactX)));
    }
  }
  RecordProperty("worst_position_error", std::to_string(worst * 1e15) + " fm");
  EXPECT_LT(worst, 1e-12);
}

constexpr double mass = 1500.0;
constexpr double inertia = 2600.0;

double energyProduct(const PlanarImpulse& a, const PlanarImpulse& b) {
  return a.linear.dot(b.linear) / mass + a.angular * b.angular / inertia;
}

PlanarImpulse scaled(double factor, const PlanarImpulse& impulse) {
  return {.linear = factor * impulse.linear, .angular = factor * impulse.angular};
}

// The pulse that an impact in the middle of a step has left.
ForcePulse halfPending(const PlanarImpulse& impulse) {
  ForcePulse pulse;
  pulse.add(scaled(2.0, impulse), 0.5, 1.0);
  pulse.take(1.0);
  return pulse;
}

TEST(ForcePulseReconciled, WhatOthersHaveDoneIsTakenOut) {
  Random random(77);
  for (int i = 0; i < 10'000; ++i) {
    const PlanarImpulse impulse = randomImpulse(random);
    const double done = random.uniform(-1.0, 2.0);
    ForcePulse pulse = halfPending(impulse);
    pulse.reconcile(scaled(done, impulse), {}, mass, inertia);
    const double left = 1.0 - std::clamp(done, 0.0, 1.0);
    expectSame(pulse.pending(), scaled(left, impulse), std::to_string(i));
  }
}

// Whatever others did: afterwards the motion is no slower along the impulse than the law's or than
// theirs, and no faster than the faster of the two.
TEST(ForcePulseReconciled, TheMotionIsTheFasterOfBoth) {
  Random random(78);
  for (int i = 0; i < 10'000; ++i) {
    const PlanarImpulse impulse = randomImpulse(random);
    const PlanarImpulse surplus = scaled(random.uniform(0.0, 2.0), randomImpulse(random));
    ForcePulse pulse = halfPending(impulse);
    pulse.reconcile(surplus, {}, mass, inertia);
    PlanarImpulse all = pulse.pending();
    all += surplus;
    const double bySurplus = energyProduct(surplus, impulse);
    const double byLaw = energyProduct(impulse, impulse);
    const double expected = bySurplus > 0.0 ? std::max(bySurplus, byLaw) : byLaw + bySurplus;
    ASSERT_NEAR(energyProduct(all, impulse), expected, 1e-9 * byLaw) << i;
  }
}

TEST(ForcePulseReconciled, OrdinaryForcesAreNoPartOfAnImpact) {
  const PlanarImpulse impulse{.linear = {3000.0, -400.0}, .angular = 900.0};
  ForcePulse pulse = halfPending(impulse);
  const PlanarImpulse braking = scaled(0.01, impulse);
  pulse.reconcile(braking, {.linear = braking.linear.norm(), .angular = braking.angular}, mass,
                  inertia);
  EXPECT_EQ(pulse.pending().linear, impulse.linear);
  EXPECT_EQ(pulse.pending().angular, impulse.angular);
}

TEST(ForcePulseReconciled, WhatEasesOutIsTakenBackAllTheSame) {
  const PlanarImpulse shift{.linear = {0.0, 200.0}, .angular = 30.0};
  ForcePulse pulse;
  pulse.shift(shift);
  pulse.take(1.0);
  // Somebody pushes into the wall, along what takes the shift back.
  pulse.reconcile(scaled(-5.0, shift), {}, mass, inertia);
  expectSame(pulse.pending(), scaled(-1.0, shift), "shift");
}

TEST(ForcePulseReconciled, LongPulsesShareOneReduction) {
  const PlanarImpulse impulse{.linear = {-2000.0, 500.0}, .angular = -300.0};
  ForcePulse pulse;
  pulse.addLong(impulse, 0.0, 0.1);
  pulse.addLong(impulse, 0.0, 0.2);
  pulse.reconcile(scaled(0.5, impulse), {}, mass, inertia);
  expectSame(pulse.pending(), scaled(1.5, impulse), "long");
}

}  // namespace
}  // namespace bumper::tests
