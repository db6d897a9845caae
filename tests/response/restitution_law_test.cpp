#include "bumper/response/restitution_law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "oracle.h"

namespace bumper::tests {
namespace {

// Residuals of the library's answer against the bodies' own equations, in units of what enters.
constexpr double residual = 1e-12;
// Kinetic energy created, relative to what there was.
constexpr double energyTolerance = 1e-12;
// The oracle's own rounding: it takes the difference of two energies.
constexpr double oracleEnergy = 1e-18;
// Two answers are held equal within this times the condition of the problem.
constexpr double agreement = 1e-12;
// Closer than this to the critical ratio, either regime may be reported.
constexpr double regimeMargin = 1e-9;

struct Case {
  Situation situation;
  double restitution = 0.0;
  double friction = 0.0;
  ContactMobility mobility;
  ContactVelocity before;

  Case(Random& random, Other other)
      : Case(randomImpact(random, other), randomRestitution(random), randomFriction(random)) {}
  Case(const Situation& s, double e, double mu)
      : situation(s),
        restitution(e),
        friction(mu),
        mobility(contactMobility(s.vehicle, s.other, s.normal)),
        before(contactVelocity(s.vehicle, s.other, s.normal)) {}

  [[nodiscard]] ContactSolution coulombSolution() const {
    return solveRestitution(mobility, before, restitution,
                            {.kind = Friction::Kind::coulomb, .value = friction});
  }
  /// What enters the normal and the tangential velocity after an impulse. Where the bodies' own
  /// motions nearly cancel at the contact, their rounding is what limits both sides.
  [[nodiscard]] double normalScale(const ContactImpulse& j) const {
    return std::abs(before.normal) + mobility.normal * std::abs(j.normal) +
           std::abs(mobility.coupling * j.tangent) + cancelled();
  }
  [[nodiscard]] double tangentScale(const ContactImpulse& j) const {
    return std::abs(before.tangent) + mobility.tangent * std::abs(j.tangent) +
           std::abs(mobility.coupling * j.normal) + cancelled();
  }
  /// So that `residual` times it is a rounding of the largest speed.
  [[nodiscard]] double cancelled() const {
    double speeds = 0.0;
    for (const ContactBody& body : {situation.vehicle, situation.other}) {
      speeds += body.velocity.norm() + std::abs(body.yawRate) * body.arm.norm();
    }
    return 1e-3 * speeds;
  }
  /// How far a relative error of A and C is enlarged in the impulse.
  [[nodiscard]] double condition(double ratio) const {
    return (mobility.normal + std::abs(ratio * mobility.coupling)) /
           (mobility.normal + ratio * mobility.coupling);
  }
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.situation << "e " << c.restitution << ", mu " << c.friction << '\n';
}

Exact appliedTo(const Case& c, const ContactSolution& solution) {
  return applied(c.situation, solution.impulse.normal, solution.impulse.tangent);
}

Other everyThirdTwoVehicles(int i) { return i % 3 == 0 ? Other::vehicle : Other::barrier; }

TEST(RestitutionLaw, AgreesWithMomentumRestitutionAndCoulomb) {
  Random random(201);
  int sliding = 0, sticking = 0, reverse = 0, lowered = 0;
  double leastMobility = 1.0;
  for (int i = 0; i < 120'000; ++i) {
    const Case c(random, everyThirdTwoVehicles(i));
    const ContactSolution solution = c.coulombSolution();
    const ContactImpulse& j = solution.impulse;
    const Exact after = appliedTo(c, solution);
    const double normalScale = c.normalScale(j), tangentScale = c.tangentScale(j);
    ASSERT_GT(j.normal, 0.0) << i << '\n' << c;

    // A + λC > 0.
    const double effective = c.mobility.normal + solution.impulseRatio * c.mobility.coupling;
    ASSERT_GT(effective, 0.0) << i << '\n' << c;
    leastMobility = std::min(leastMobility, effective / c.mobility.normal);

    // What it reports is what the bodies do.
    ASSERT_NEAR(solution.velocityAfter.normal, static_cast<double>(after.normalAfter),
                residual * normalScale)
        << i << '\n'
        << c;
    ASSERT_NEAR(solution.velocityAfter.tangent, static_cast<double>(after.tangentAfter),
                residual * tangentScale)
        << i << '\n'
        << c;
    ASSERT_NEAR(solution.energyChange, static_cast<double>(after.energyAfter - after.energyBefore),
                residual * (normalScale * j.normal + tangentScale * std::abs(j.tangent)) +
                    oracleEnergy * static_cast<double>(after.energyBefore))
        << i << '\n'
        << c;
    ASSERT_NEAR(solution.impulseRatio * j.normal, j.tangent, residual * j.normal) << i << '\n' << c;

    // Eq. 3 with the restitution that it reports, which is the one asked for unless it says no.
    ASSERT_NEAR(static_cast<double>(after.normalAfter), -solution.restitution * c.before.normal,
                residual * normalScale)
        << i << '\n'
        << c;
    if (!solution.restitutionLowered) {
      ASSERT_NEAR(static_cast<double>(after.normalAfter), -c.restitution * c.before.normal,
                  residual * normalScale)
          << i << '\n'
          << c;
    }

    // Coulomb: friction within its bound, and against the slip that remains.
    ASSERT_LE(std::abs(j.tangent), c.friction * j.normal * (1.0 + residual)) << i << '\n' << c;
    if (std::abs(j.tangent) < c.friction * j.normal * (1.0 - residual)) {
      ASSERT_NEAR(static_cast<double>(after.tangentAfter), 0.0, residual * tangentScale)
          << i << '\n'
          << c;
    } else {
      ASSERT_LE(static_cast<double>(after.tangentAfter) * j.tangent,
                residual * tangentScale * std::abs(j.tangent))
          << i << '\n'
          << c;
    }

    // No kinetic energy is created.
    ASSERT_LE(static_cast<double>(after.energyAfter - after.energyBefore),
              energyTolerance * static_cast<double>(after.energyBefore))
        << i << '\n'
        << c;
    ASSERT_LE(solution.energyChange, energyTolerance * static_cast<double>(after.energyBefore));

    // The one impulse that Coulomb's law allows.
    const double used = solution.restitutionLowered ? solution.restitution : c.restitution;
    const std::optional<Exact> oracle = coulomb(c.situation, used, c.friction);
    ASSERT_TRUE(oracle.has_value()) << i << '\n' << c;
    const double tolerance = agreement * c.condition(solution.impulseRatio) * j.normal;
    ASSERT_NEAR(j.normal, static_cast<double>(oracle->impulseNormal), tolerance) << i << '\n' << c;
    ASSERT_NEAR(j.tangent, static_cast<double>(oracle->impulseTangent),
                tolerance * (1.0 + c.friction))
        << i << '\n'
        << c;

    const Exact stuck = withoutSlip(c.situation, used);
    const auto critical = static_cast<double>(stuck.impulseTangent / stuck.impulseNormal);
    if (stuck.impulseNormal > 0.0L) {
      ASSERT_NEAR(solution.criticalRatio, critical,
                  1e-11 * (1.0 + std::abs(critical)) * (1.0 + std::abs(critical)))
          << i << '\n'
          << c;
    } else if (c.before.normal < 0.0) {
      ASSERT_TRUE(std::isnan(solution.criticalRatio)) << i << '\n' << c;
    }
    const bool nearCritical = std::abs(std::abs(critical) - c.friction) < regimeMargin;
    const bool nearNoSlip =
        std::abs(static_cast<double>(oracle->tangentAfter)) < regimeMargin * tangentScale;
    if (!nearCritical && (solution.regime == Regime::sticking || !nearNoSlip)) {
      ASSERT_EQ(solution.regime, oracle->regime) << i << '\n' << c;
    }
    sliding += solution.regime == Regime::sliding ? 1 : 0;
    sticking += solution.regime == Regime::sticking ? 1 : 0;
    reverse += solution.regime == Regime::reverse_slip ? 1 : 0;
    lowered += solution.restitutionLowered ? 1 : 0;
  }
  // Every branch was walked often.
  EXPECT_GT(sliding, 10'000);
  EXPECT_GT(sticking, 10'000);
  EXPECT_GT(reverse, 1'000);
  EXPECT_GT(lowered, 100);
  EXPECT_LT(leastMobility, 0.1);
}

TEST(RestitutionLaw, RestitutionIsLoweredOnlyAsFarAsEnergyDemands) {
  Random random(202);
  int lowered = 0;
  for (int i = 0; i < 60'000; ++i) {
    Case c(random, everyThirdTwoVehicles(i));
    c.restitution = random.uniform(0.5, 1.0);
    c.friction = random.uniform(0.2, 3.0);
    const ContactSolution solution = c.coulombSolution();
    const std::optional<Exact> asked = coulomb(c.situation, c.restitution, c.friction);
    ASSERT_TRUE(asked.has_value());
    const auto gain = [](const Exact& e) {
      return static_cast<double>((e.energyAfter - e.energyBefore) / e.energyBefore);
    };
    if (!solution.restitutionLowered) {
      ASSERT_LE(gain(*asked), energyTolerance) << i << '\n' << c;
      continue;
    }
    ++lowered;
    ASSERT_GT(gain(*asked), -energyTolerance) << i << '\n' << c;
    ASSERT_GE(solution.restitution, 0.0) << i << '\n' << c;
    ASSERT_LT(solution.restitution, c.restitution) << i << '\n' << c;
    const Exact used = appliedTo(c, solution);
    // The border itself: no energy lost beyond rounding, none created.
    ASSERT_NEAR(gain(used), 0.0, energyTolerance) << i << '\n' << c;
    // All that lies between it and the demand creates energy.
    for (int k = 1; k <= 20; ++k) {
      const double between =
          solution.restitution + (c.restitution - solution.restitution) * k / 20.0;
      const std::optional<Exact> more = coulomb(c.situation, between, c.friction);
      ASSERT_TRUE(more.has_value());
      ASSERT_GT(gain(*more), -energyTolerance) << i << ' ' << between << '\n' << c;
    }
  }
  EXPECT_GT(lowered, 100);
}

TEST(RestitutionLaw, ThePapersRestitutionIsNeverLowered) {
  Random random(203);
  for (int i = 0; i < 30'000; ++i) {
    Case c(random, Other::barrier);
    c.restitution = random.uniform(0.0, 0.3);
    c.friction = random.uniform(0.0, 0.3);
    ASSERT_FALSE(c.coulombSolution().restitutionLowered) << i << '\n' << c;
  }
}

TEST(RestitutionLaw, IsEq17WhereFullFrictionDoesNotTurnTheSlip) {
  Random random(204);
  int compared = 0, reversed = 0;
  for (int i = 0; i < 60'000; ++i) {
    Case c(random, Other::barrier);
    c.restitution = random.uniform(0.0, 0.5);
    const ContactSolution printed =
        solveRestitutionAsPrinted(c.mobility, c.before, c.restitution, c.friction);

    // Eqs. 10 and 15 to 17 in the paper's letters: x and y are the contact's distances from the
    // mass centre along and across the normal; Eq. 5's μ carries the sign of the friction.
    const ContactBody& body = c.situation.vehicle;
    const double x = body.arm.dot(c.situation.normal);
    const double y = body.arm.dot(turnedLeft(c.situation.normal));
    const double mu = c.before.tangent > 0.0 ? -c.friction : c.friction;
    const double p1 = body.velocity.dot(c.situation.normal) - body.yawRate * y;
    const double h = body.inverseMass + y * y * body.inverseYawInertia;
    const double k = x * y * body.inverseYawInertia;
    if (h - mu * k <= 0.0) {
      ASSERT_EQ(printed.impulse.normal, 0.0) << i << '\n' << c;
      ASSERT_EQ(printed.impulse.tangent, 0.0) << i << '\n' << c;
      continue;
    }
    const double impulse = -(1.0 + c.restitution) / (h - mu * k) * p1;
    const double tolerance = agreement * c.condition(mu) * impulse * 10.0;
    ASSERT_NEAR(printed.impulse.normal, impulse, tolerance) << i << '\n' << c;
    ASSERT_NEAR(printed.impulse.tangent, mu * impulse, tolerance * (1.0 + c.friction)) << i << '\n'
                                                                                       << c;

    const ContactSolution solution = c.coulombSolution();
    const Exact sliding = applied(c.situation, impulse, mu * impulse);
    if (sliding.tangentAfter * tangentBefore(c.situation) > 0.0L && !solution.restitutionLowered) {
      ++compared;
      ASSERT_NEAR(solution.impulse.normal, impulse, tolerance) << i << '\n' << c;
      ASSERT_NEAR(solution.impulse.tangent, mu * impulse, tolerance * (1.0 + c.friction))
          << i << '\n'
          << c;
    } else {
      ++reversed;
    }
  }
  EXPECT_GT(compared, 10'000);
  EXPECT_GT(reversed, 1'000);
}

TEST(RestitutionLaw, FractionOfCriticalIsThatFraction) {
  Random random(205);
  for (int i = 0; i < 40'000; ++i) {
    Case c(random, everyThirdTwoVehicles(i));
    const double fraction = i % 10 == 0 ? 1.0 : random.uniform(0.0, 1.0);
    const ContactSolution solution =
        solveRestitution(c.mobility, c.before, c.restitution,
                         {.kind = Friction::Kind::fraction_of_critical, .value = fraction});
    const Exact after = appliedTo(c, solution);
    ASSERT_NEAR(static_cast<double>(after.normalAfter), -solution.restitution * c.before.normal,
                residual * c.normalScale(solution.impulse))
        << i << '\n'
        << c;
    ASSERT_LE(static_cast<double>(after.energyAfter - after.energyBefore),
              energyTolerance * static_cast<double>(after.energyBefore))
        << i << '\n'
        << c;
    const double used = solution.restitutionLowered ? solution.restitution : c.restitution;
    const Exact stuck = withoutSlip(c.situation, used);
    if (stuck.impulseNormal <= 0.0L) continue;  // no impulse ends the slip
    const Real critical = stuck.impulseTangent / stuck.impulseNormal;
    const std::optional<Exact> oracle = atRatio(c.situation, used, fraction * critical);
    ASSERT_TRUE(oracle.has_value()) << i << '\n' << c;
    const double size = 1.0 + std::abs(static_cast<double>(critical));
    const double tolerance = 10.0 * agreement * size * size * c.condition(solution.impulseRatio) *
                             solution.impulse.normal;
    ASSERT_NEAR(solution.impulse.normal, static_cast<double>(oracle->impulseNormal), tolerance)
        << i << ' ' << fraction << '\n'
        << c;
    ASSERT_NEAR(solution.impulse.tangent, static_cast<double>(oracle->impulseTangent),
                tolerance * size)
        << i << ' ' << fraction << '\n'
        << c;
  }
}

TEST(RestitutionLaw, SeparatingContactsGetNoImpulse) {
  Random random(206);
  for (int i = 0; i < 5'000; ++i) {
    Case c(random, everyThirdTwoVehicles(i));
    c.before.normal = i % 5 == 0 ? 0.0 : random.uniform(0.0, 20.0);
    for (const Friction::Kind kind :
         {Friction::Kind::coulomb, Friction::Kind::fraction_of_critical}) {
      const ContactSolution solution = solveRestitution(
          c.mobility, c.before, c.restitution, {.kind = kind, .value = std::min(c.friction, 1.0)});
      ASSERT_EQ(solution.regime, Regime::separating);
      ASSERT_EQ(solution.impulse.normal, 0.0);
      ASSERT_EQ(solution.impulse.tangent, 0.0);
      ASSERT_EQ(solution.velocityAfter.normal, c.before.normal);
      ASSERT_EQ(solution.velocityAfter.tangent, c.before.tangent);
      ASSERT_EQ(solution.energyChange, 0.0);
      ASSERT_FALSE(solution.restitutionLowered);
    }
    const ContactSolution printed =
        solveRestitutionAsPrinted(c.mobility, c.before, c.restitution, c.friction);
    ASSERT_EQ(printed.regime, Regime::separating);
    ASSERT_EQ(printed.impulse.normal, 0.0);
    ASSERT_EQ(printed.impulse.tangent, 0.0);
  }
}

TEST(RestitutionLaw, AMirrorTurnsItRoundExactly) {
  Random random(207);
  for (int i = 0; i < 20'000; ++i) {
    const Case c(random, everyThirdTwoVehicles(i));
    const Case mirror(mirrored(c.situation), c.restitution, c.friction);
    const ContactSolution a = c.coulombSolution(), b = mirror.coulombSolution();
    // Changing signs costs no digits.
    ASSERT_EQ(a.impulse.normal, b.impulse.normal) << i << '\n' << c;
    ASSERT_EQ(a.impulse.tangent, -b.impulse.tangent) << i << '\n' << c;
    ASSERT_EQ(a.regime, b.regime) << i << '\n' << c;
    ASSERT_EQ(a.restitution, b.restitution) << i << '\n' << c;
    ASSERT_TRUE(a.criticalRatio == -b.criticalRatio ||
                (std::isnan(a.criticalRatio) && std::isnan(b.criticalRatio)))
        << i << '\n'
        << c;
    ASSERT_EQ(a.energyChange, b.energyChange) << i << '\n' << c;
  }
}

TEST(RestitutionLaw, NoFrameIsSpecial) {
  Random random(208);
  for (int i = 0; i < 20'000; ++i) {
    const Case c(random, everyThirdTwoVehicles(i));
    Situation other = turned(c.situation, random.uniform(-4.0, 4.0));
    const Vector2 common(random.uniform(-30.0, 30.0), random.uniform(-30.0, 30.0));
    if (other.other.inverseMass > 0.0) {
      other.vehicle.velocity += common;
      other.other.velocity += common;
    }
    const Case seen(other, c.restitution, c.friction);
    const ContactSolution a = c.coulombSolution(), b = seen.coulombSolution();
    if (a.restitutionLowered || b.restitutionLowered) continue;  // has its own condition
    // The velocities lose up to 1e-13 m/s to the frame.
    const double speed = std::abs(c.before.normal) + std::abs(c.before.tangent) + 60.0;
    const double tolerance =
        1e-13 * c.condition(a.impulseRatio) * (1.0 + std::abs(a.impulseRatio)) *
        (a.impulse.normal + speed / c.mobility.normal * c.condition(a.impulseRatio));
    ASSERT_NEAR(a.impulse.normal, b.impulse.normal, tolerance) << i << '\n' << c;
    ASSERT_NEAR(a.impulse.tangent, b.impulse.tangent, tolerance * 10.0) << i << '\n' << c;
  }
}

// Nothing in the law has a speed of its own: with all velocities at 2^-20 of theirs, every impulse
// is at 2^-20 of its own, bit for bit.
TEST(RestitutionLaw, SlowImpactsAreFastOnesInSmall) {
  Random random(210);
  constexpr double small = 0x1p-20;
  for (int i = 0; i < 20'000; ++i) {
    const Case c(random, everyThirdTwoVehicles(i));
    for (const Friction::Kind kind :
         {Friction::Kind::coulomb, Friction::Kind::fraction_of_critical}) {
      const Friction friction{.kind = kind, .value = std::min(c.friction, 1.0)};
      const ContactSolution fast = solveRestitution(c.mobility, c.before, c.restitution, friction);
      const ContactSolution slow = solveRestitution(
          c.mobility, {.normal = small * c.before.normal, .tangent = small * c.before.tangent},
          c.restitution, friction);
      ASSERT_EQ(slow.impulse.normal, small * fast.impulse.normal) << i << '\n' << c;
      ASSERT_EQ(slow.impulse.tangent, small * fast.impulse.tangent) << i << '\n' << c;
      ASSERT_EQ(slow.energyChange, small * small * fast.energyChange) << i << '\n' << c;
      ASSERT_EQ(slow.restitution, fast.restitution) << i << '\n' << c;
      ASSERT_EQ(slow.regime, fast.regime) << i << '\n' << c;
      ASSERT_EQ(slow.restitutionLowered, fast.restitutionLowered) << i << '\n' << c;
    }
  }
}

TEST(RestitutionLaw, RegimesOfAPlainCorner) {
  // A unit disc of unit mass and inertia touched at (-1, 1): C = 1 for the normal +x.
  const ContactMobility mobility{.normal = 2.0, .tangent = 2.0, .coupling = 1.0};
  const auto regime = [&](double slip, double friction) {
    return solveRestitution(mobility, {.normal = -1.0, .tangent = slip}, 0.0, {.value = friction})
        .regime;
  };
  EXPECT_EQ(regime(5.0, 0.1), Regime::sliding);
  EXPECT_EQ(regime(-5.0, 0.1), Regime::sliding);
  EXPECT_EQ(regime(0.3, 2.0), Regime::sticking);
  // The normal impulse alone gives Δv_t = C J_n = +½: enough to turn a slip of −0.2 round.
  EXPECT_EQ(regime(-0.2, 0.05), Regime::reverse_slip);
  EXPECT_EQ(regime(-0.2, 1.0), Regime::sticking);
}

TEST(RestitutionLaw, HeadOnThroughTheMassCentre) {
  const ContactMobility mobility{.normal = 1e-3, .tangent = 2e-3, .coupling = 0.0};
  const ContactSolution solution =
      solveRestitution(mobility, {.normal = -10.0, .tangent = 0.0}, 0.2, {.value = 0.5});
  EXPECT_DOUBLE_EQ(solution.impulse.normal, 12'000.0);
  EXPECT_EQ(solution.impulse.tangent, 0.0);
  EXPECT_DOUBLE_EQ(solution.velocityAfter.normal, 2.0);
  EXPECT_DOUBLE_EQ(solution.restitution, 0.2);
  EXPECT_NEAR(solution.energyChange, -0.5 * 1000.0 * (100.0 - 4.0), 1e-9);
}

// Scraping along a wall under much friction: the approach is next to nothing, and yet the contact
// jams, because friction against the slip presses it on. The answer must not depend on the few
// digits that are left of A + λC there.
TEST(RestitutionLaw, JammingContactsKeepTheirDigits) {
  Random random(211);
  int jammed = 0;
  for (int i = 0; i < 50'000; ++i) {
    Case c(random, Other::barrier);
    c.friction = random.uniform(1.5, 3.0);
    c.restitution = random.uniform(0.0, 0.3);
    c.before.normal = -std::pow(10.0, random.uniform(-20.0, -3.0));
    c.before.tangent = random.sign() * random.uniform(1.0, 20.0);
    const ContactSolution solution = c.coulombSolution();
    if (solution.regime != Regime::sticking) continue;
    ++jammed;
    const ContactVelocity after = afterImpulse(c.before, c.mobility, solution.impulse);
    ASSERT_LE(std::abs(after.tangent), residual * std::abs(c.before.tangent))
        << i << '\n'
        << c << "v_n " << c.before.normal << " v_t " << c.before.tangent;
    ASSERT_LE(std::abs(after.normal), residual * std::abs(c.before.tangent) - c.before.normal)
        << i << '\n'
        << c << "v_n " << c.before.normal << " v_t " << c.before.tangent;
  }
  EXPECT_GT(jammed, 500);
}

TEST(RestitutionLaw, StaysFiniteAtTheEdgesOfTheRange) {
  Random random(209);
  for (int i = 0; i < 50'000; ++i) {
    ContactMobility mobility;
    mobility.normal = std::pow(10.0, random.uniform(-12.0, 6.0));
    mobility.tangent = std::pow(10.0, random.uniform(-12.0, 6.0));
    mobility.coupling = std::sqrt(mobility.normal * mobility.tangent) * random.sign() *
                        (1.0 - std::pow(10.0, random.uniform(-6.0, 0.0)));
    const auto anySpeed = [&] {
      return random.chance(0.1) ? 0.0 : std::pow(10.0, random.uniform(-200.0, 60.0));
    };
    const ContactVelocity before{.normal = -anySpeed(), .tangent = anySpeed() * random.sign()};
    const Friction friction{
        .kind = random.chance(0.5) ? Friction::Kind::coulomb : Friction::Kind::fraction_of_critical,
        .value = random.uniform(0.0, 1.0)};
    const double restitution = randomRestitution(random);
    const ContactSolution s = solveRestitution(mobility, before, restitution, friction);
    int which = 0;
    for (const double number :
         {s.impulse.normal, s.impulse.tangent, s.velocityAfter.normal, s.velocityAfter.tangent,
          s.restitution, s.impulseRatio, s.energyChange}) {
      ASSERT_TRUE(std::isfinite(number))
          << i << ": number " << which << ", A " << mobility.normal << " B " << mobility.tangent
          << " C " << mobility.coupling << " v_n " << before.normal << " v_t " << before.tangent
          << " e " << restitution << " friction " << friction.value << " kind "
          << static_cast<int>(friction.kind);
      ++which;
    }
    ASSERT_GE(s.impulse.normal, 0.0) << i;
    ASSERT_GE(s.restitution, -1e-9) << i;
    ASSERT_LE(s.restitution, restitution + 1e-9) << i;
  }
}

}  // namespace
}  // namespace bumper::tests
