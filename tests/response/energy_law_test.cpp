#include "bumper/response/energy_law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bumper/response/planar_motion.h"
#include "oracle.h"

namespace bumper::tests {
namespace {

// Energy after the impulse against the energy asked for, relative to the energy before.
constexpr double energyTolerance = 1e-12;
// Velocities after an impulse, in units of what enters them.
constexpr double residual = 1e-11;
// A bound that is this near may or may not be taken as acting.
constexpr double nearBound = 1e-9;

struct Case {
  Situation situation;
  EnergyDemand demand;
  ContactMobility mobility;
  ContactVelocity before;
  double slope = 0.0;  ///< of the paper's impulse: J_t = slope J_n

  explicit Case(Random& random, EnergyRoot root = EnergyRoot::rebound)
      : situation(randomImpact(random, Other::barrier)),
        mobility(contactMobility(situation.vehicle, situation.other, situation.normal)),
        before(contactVelocity(situation.vehicle, situation.other, situation.normal)) {
    demand.energyRatio = random.uniform(0.0, 1.0);
    demand.energyBefore = yawPlaneEnergy(
        {.velocity = situation.vehicle.velocity, .yawRate = situation.vehicle.yawRate},
        1.0 / situation.vehicle.inverseMass, 1.0 / situation.vehicle.inverseYawInertia);
    demand.friction = random.chance(0.2) ? 0.0 : random.uniform(0.0, 1.0);
    demand.maxRestitution = random.uniform(0.0, 1.0);
    demand.root = root;
    slope = before.tangent > 0.0 ? -demand.friction : demand.friction;
  }
  [[nodiscard]] double approach() const { return -before.normal; }
  [[nodiscard]] double normalScale(const ContactImpulse& j) const {
    return approach() + mobility.normal * std::abs(j.normal) +
           std::abs(mobility.coupling * j.tangent);
  }
  [[nodiscard]] double tangentScale(const ContactImpulse& j) const {
    return std::abs(before.tangent) + mobility.tangent * std::abs(j.tangent) +
           std::abs(mobility.coupling * j.normal);
  }
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.situation << "P " << c.demand.energyRatio << ", E1 " << c.demand.energyBefore
             << ", mu " << c.demand.friction << ", max e " << c.demand.maxRestitution << '\n';
}

double ratioAfter(const Exact& exact) {
  return static_cast<double>(exact.energyAfter / exact.energyBefore);
}

/// Whether an impulse leaves the slip turned round with friction still pushing it that way.
bool dragsBackwards(const Exact& exact, double slope, double tolerance) {
  return static_cast<double>(exact.tangentAfter) * slope > std::abs(slope) * tolerance;
}

TEST(EnergyLaw, RootsKeepTheEnergyAskedFor) {
  Random random(301);
  int real = 0, none = 0;
  for (int i = 0; i < 50'000; ++i) {
    const Case c(random);
    const EnergyRoots roots = energyRoots(c.mobility, c.before, c.demand);
    const EnergyLine line(c.situation, c.slope);
    const auto deepest = static_cast<double>(line.deepest());
    ASSERT_NEAR(roots.deepest, deepest, 1e-12 * deepest * (1.0 + c.demand.friction)) << c;
    const Exact most = line.at(line.deepest());
    const double reach = ratioAfter(most);  // P_min
    if (std::abs(reach - c.demand.energyRatio) < nearBound) continue;
    ASSERT_EQ(roots.real, reach < c.demand.energyRatio) << i << '\n' << c;
    if (!roots.real) {
      ++none;
      continue;
    }
    ++real;
    ASSERT_LE(roots.smaller, roots.larger) << i << '\n' << c;
    const Real energy = Real{c.demand.energyRatio} * most.energyBefore;
    for (const auto& [root, exact] : {std::pair{roots.smaller, line.smaller(energy)},
                                      std::pair{roots.larger, line.larger(energy)}}) {
      ASSERT_NEAR(ratioAfter(line.at(root)), c.demand.energyRatio, energyTolerance) << i << '\n'
                                                                                    << c;
      ASSERT_TRUE(exact.has_value());
      // A root moves by ∂J/∂P times an error of the energy.
      const double steepness =
          (1.0 - reach) / std::sqrt((1.0 - reach) * (c.demand.energyRatio - reach));
      ASSERT_NEAR(root, static_cast<double>(*exact),
                  1e-13 * deepest * (10.0 + steepness / (1.0 - reach)))
          << i << '\n'
          << c;
    }
  }
  EXPECT_GT(real, 1'000);
  EXPECT_GT(none, 1'000);
}

TEST(EnergyLaw, RootsAreThoseOfThePapersVehicleFrame) {
  // Eqs. 19 to 35 in the paper's letters; all vectors of the situation are taken as given in the
  // vehicle's own axes.
  constexpr double contactTime = 0.005;  // Eq. 38; it must cancel
  Random random(302);
  int compared = 0;
  for (int i = 0; i < 50'000; ++i) {
    const Case c(random);
    const EnergyRoots roots = energyRoots(c.mobility, c.before, c.demand);
    const ContactBody& body = c.situation.vehicle;
    const double m = 1.0 / body.inverseMass, inertia = 1.0 / body.inverseYawInertia;
    const Vector2 pull = c.situation.normal + c.slope * turnedLeft(c.situation.normal);
    const double a = pull.x() / pull.norm(), b = pull.y() / pull.norm();
    const double cc = body.arm.x(), d = body.arm.y();
    const double u = body.velocity.x(), v = body.velocity.y(), r = body.yawRate;
    const double energy2 =
        c.demand.energyRatio * (0.5 * m * (u * u + v * v) + 0.5 * inertia * r * r);
    const double time2 = contactTime * contactTime;
    const double A = time2 * (a * a + b * b) / m +
                     time2 * (a * a * d * d + b * b * cc * cc - 2.0 * a * d * b * cc) / inertia;
    const double B = 2.0 * contactTime * (a * u + b * v) + 2.0 * contactTime * r * (b * cc - a * d);
    const double C = m * (u * u + v * v) + inertia * r * r - energy2 / 0.5;
    const double discriminant = B * B - 4.0 * A * C;
    if (std::abs(discriminant) < 1e-6 * B * B) continue;  // digits are lost in Eq. 32 itself
    ASSERT_EQ(roots.real, discriminant > 0.0) << i << '\n' << c;
    const auto normalImpulse = [&](double force) { return force * contactTime / pull.norm(); };
    ASSERT_NEAR(roots.deepest, normalImpulse(-B / (2.0 * A)), 1e-11 * roots.deepest) << c;
    if (!roots.real) continue;
    ++compared;
    const double tolerance = 1e-9 * roots.deepest;  // Eq. 32 subtracts nearly equal numbers
    ASSERT_NEAR(roots.larger, normalImpulse((-B + std::sqrt(discriminant)) / (2.0 * A)), tolerance)
        << i << '\n'
        << c;
    ASSERT_NEAR(roots.smaller, normalImpulse((-B - std::sqrt(discriminant)) / (2.0 * A)), tolerance)
        << i << '\n'
        << c;
  }
  EXPECT_GT(compared, 1'000);
}

TEST(EnergyLaw, HasAnEquivalentRestitutionAlongItsImpulse) {
  Random random(303);
  for (int i = 0; i < 20'000; ++i) {
    const Case c(random);
    const EnergyRoots roots = energyRoots(c.mobility, c.before, c.demand);
    const EnergyLine line(c.situation, c.slope);
    const double reach = ratioAfter(line.at(line.deepest()));
    if (!roots.real || c.demand.energyRatio - reach < 1e-6) continue;
    const double expected = std::sqrt(1.0 - (1.0 - c.demand.energyRatio) / (1.0 - reach));
    const Exact start = line.at(0.0L), end = line.at(roots.larger);
    const Real before = start.normalAfter + c.slope * start.tangentAfter;
    const Real after = end.normalAfter + c.slope * end.tangentAfter;
    ASSERT_NEAR(static_cast<double>(-after / before), expected, 1e-9) << i << '\n' << c;
  }
}

/// What must hold for any answer.
void expectSound(const Case& c, const EnergySolution& solution, int i) {
  const ContactImpulse& j = solution.contact.impulse;
  const Exact after = applied(c.situation, j.normal, j.tangent);
  ASSERT_GE(j.normal, 0.0) << i << '\n' << c;
  ASSERT_NEAR(solution.contact.velocityAfter.normal, static_cast<double>(after.normalAfter),
              residual * c.normalScale(j))
      << i << '\n'
      << c;
  ASSERT_NEAR(solution.contact.velocityAfter.tangent, static_cast<double>(after.tangentAfter),
              residual * c.tangentScale(j))
      << i << '\n'
      << c;
  ASSERT_NEAR(solution.energyRatio, ratioAfter(after), energyTolerance) << i << '\n' << c;
  ASSERT_LE(ratioAfter(after), 1.0 + energyTolerance) << i << '\n' << c;
  ASSERT_LE(std::abs(j.tangent), c.demand.friction * j.normal * (1.0 + 1e-12)) << i << '\n' << c;
  // Friction never drags the contact point backwards.
  ASSERT_LE(static_cast<double>(after.tangentAfter) * j.tangent,
            residual * c.tangentScale(j) * std::abs(j.tangent))
      << i << '\n'
      << c;
}

TEST(EnergyLaw, ReboundIsTheLargerRootWithinItsBounds) {
  Random random(304);
  int count[6] = {};
  for (int i = 0; i < 100'000; ++i) {
    const Case c(random);
    const EnergySolution solution = solveEnergy(c.mobility, c.before, c.demand);
    expectSound(c, solution, i);
    if (HasFatalFailure()) return;
    ++count[static_cast<int>(solution.outcome)];
    const ContactImpulse& j = solution.contact.impulse;
    const Exact after = applied(c.situation, j.normal, j.tangent);
    const double scale = residual * c.normalScale(j);
    ASSERT_GE(static_cast<double>(after.normalAfter), -scale) << i << '\n' << c;
    ASSERT_LE(static_cast<double>(after.normalAfter),
              c.demand.maxRestitution * c.approach() + scale)
        << i << '\n'
        << c;

    // The rule by hand.
    const EnergyLine line(c.situation, c.slope);
    const Exact most = line.at(line.deepest());
    const double reach = ratioAfter(most);
    if (std::abs(reach - c.demand.energyRatio) < nearBound) continue;
    const std::optional<Real> root = line.larger(Real{c.demand.energyRatio} * most.energyBefore);
    const Exact wanted = root ? line.at(*root) : most;
    const double wantedRebound = static_cast<double>(wanted.normalAfter) / c.approach();
    const double rebound = std::clamp(wantedRebound, 0.0, c.demand.maxRestitution);
    const std::optional<Exact> physical = coulomb(c.situation, rebound, c.demand.friction);
    ASSERT_TRUE(physical.has_value());
    const bool bounded = std::abs(rebound - wantedRebound) > nearBound;
    const bool dragged = physical->regime != Regime::sliding && c.demand.friction > 0.0;
    if (ratioAfter(*physical) < 1.0 - nearBound) {
      const double tolerance = 1e-8 * static_cast<double>(physical->impulseNormal) *
                               (1.0 + 1e-3 / std::sqrt(std::abs(reach - c.demand.energyRatio)));
      ASSERT_NEAR(j.normal, static_cast<double>(physical->impulseNormal), tolerance)
          << i << '\n'
          << c << "wanted e " << wantedRebound;
      ASSERT_NEAR(j.tangent, static_cast<double>(physical->impulseTangent), tolerance) << i << '\n'
                                                                                       << c;
    }

    // The reason that it gives is true, and none is kept back.
    switch (solution.outcome) {
      case EnergyOutcome::met:
        ASSERT_NEAR(solution.energyRatio, c.demand.energyRatio, energyTolerance) << i << '\n' << c;
        ASSERT_TRUE(root.has_value()) << i << '\n' << c;
        break;
      case EnergyOutcome::limited_by_restitution:
        ASSERT_TRUE(wantedRebound < nearBound ||
                    wantedRebound > c.demand.maxRestitution - nearBound)
            << i << ' ' << wantedRebound << '\n'
            << c;
        break;
      case EnergyOutcome::limited_by_friction:
        ASSERT_TRUE(dragged || dragsBackwards(wanted, c.slope, -1e-9 * c.tangentScale(j)))
            << i << '\n'
            << c;
        break;
      case EnergyOutcome::below_reach:
        ASSERT_FALSE(root.has_value()) << i << '\n' << c;
        break;
      case EnergyOutcome::not_asked:
      case EnergyOutcome::no_break_through:
        FAIL() << "a rebound was asked for: " << i << '\n' << c;
    }
    if (root && !bounded && !dragged) {
      ASSERT_EQ(solution.outcome, EnergyOutcome::met) << i << '\n' << c;
    }
  }
  for (const EnergyOutcome outcome :
       {EnergyOutcome::met, EnergyOutcome::limited_by_restitution,
        EnergyOutcome::limited_by_friction, EnergyOutcome::below_reach}) {
    EXPECT_GT(count[static_cast<int>(outcome)], 200) << static_cast<int>(outcome);
  }
}

TEST(EnergyLaw, BreakThroughIsTheSmallerRootOrARebound) {
  Random random(305);
  int through = 0, rebounds = 0;
  for (int i = 0; i < 100'000; ++i) {
    Case c(random, EnergyRoot::break_through);
    if (i % 2 == 0) c.demand.energyRatio = random.uniform(0.8, 1.0);
    const EnergySolution solution = solveEnergy(c.mobility, c.before, c.demand);
    const ContactImpulse& j = solution.contact.impulse;
    const Exact after = applied(c.situation, j.normal, j.tangent);
    expectSound(c, solution, i);
    if (HasFatalFailure()) return;

    const EnergyLine line(c.situation, c.slope);
    const Exact most = line.at(line.deepest());
    if (std::abs(ratioAfter(most) - c.demand.energyRatio) < nearBound) continue;
    const std::optional<Real> root = line.smaller(Real{c.demand.energyRatio} * most.energyBefore);
    const Exact wanted = root ? line.at(*root) : most;
    const double normal = static_cast<double>(wanted.normalAfter), approach = c.approach();
    const double margin = 1e-7 * approach;
    const bool drags = dragsBackwards(wanted, c.slope, 0.0);
    if (root && normal > -approach + margin && normal < -margin && !drags) {
      ++through;
      ASSERT_EQ(solution.outcome, EnergyOutcome::met) << i << '\n' << c;
      ASSERT_NEAR(j.normal, static_cast<double>(*root), 1e-6 * static_cast<double>(line.deepest()))
          << i << '\n'
          << c;
      ASSERT_NEAR(solution.energyRatio, c.demand.energyRatio, energyTolerance) << i << '\n' << c;
      ASSERT_LT(static_cast<double>(after.normalAfter), 0.0) << i << '\n' << c;
    } else if (!root || normal < -approach - margin || normal > margin) {
      ++rebounds;
      ASSERT_EQ(solution.outcome, EnergyOutcome::no_break_through) << i << '\n' << c;
      EnergyDemand rebound = c.demand;
      rebound.root = EnergyRoot::rebound;
      const EnergySolution instead = solveEnergy(c.mobility, c.before, rebound);
      ASSERT_EQ(j.normal, instead.contact.impulse.normal) << i << '\n' << c;
      ASSERT_EQ(j.tangent, instead.contact.impulse.tangent) << i << '\n' << c;
      ASSERT_EQ(solution.energyRatio, instead.energyRatio) << i << '\n' << c;
    }
  }
  EXPECT_GT(through, 1'000);
  EXPECT_GT(rebounds, 1'000);
}

TEST(EnergyLaw, AsPrintedIsEq32) {
  Random random(306);
  for (int i = 0; i < 40'000; ++i) {
    const Case c(random, i % 2 == 0 ? EnergyRoot::rebound : EnergyRoot::break_through);
    const EnergySolution solution = solveEnergyAsPrinted(c.mobility, c.before, c.demand);
    const EnergyRoots roots = energyRoots(c.mobility, c.before, c.demand);
    const double wanted = !roots.real                            ? roots.deepest
                          : c.demand.root == EnergyRoot::rebound ? roots.larger
                                                                 : roots.smaller;
    const double expected = std::max(wanted, 0.0);
    const ContactImpulse& j = solution.contact.impulse;
    ASSERT_NEAR(j.normal, expected, 1e-12 * expected) << i << '\n' << c;
    ASSERT_NEAR(j.tangent, c.slope * expected, 1e-12 * expected) << i << '\n' << c;
    const Exact after = applied(c.situation, j.normal, j.tangent);
    ASSERT_NEAR(solution.energyRatio, ratioAfter(after), energyTolerance) << i << '\n' << c;
    if (roots.real && wanted > 0.0) {
      ASSERT_EQ(solution.outcome, EnergyOutcome::met) << i << '\n' << c;
      ASSERT_NEAR(solution.energyRatio, c.demand.energyRatio, energyTolerance) << i << '\n' << c;
    }
    if (!roots.real) {
      ASSERT_EQ(solution.outcome, EnergyOutcome::below_reach) << i << '\n' << c;
    }
  }
}

TEST(EnergyLaw, SeparatingContactsGetNoImpulse) {
  Random random(307);
  for (int i = 0; i < 2'000; ++i) {
    Case c(random, i % 2 == 0 ? EnergyRoot::rebound : EnergyRoot::break_through);
    c.before.normal = i % 5 == 0 ? 0.0 : random.uniform(0.0, 20.0);
    for (const EnergySolution& solution : {solveEnergy(c.mobility, c.before, c.demand),
                                           solveEnergyAsPrinted(c.mobility, c.before, c.demand)}) {
      ASSERT_EQ(solution.contact.regime, Regime::separating);
      ASSERT_EQ(solution.contact.impulse.normal, 0.0);
      ASSERT_EQ(solution.contact.impulse.tangent, 0.0);
      ASSERT_EQ(solution.energyRatio, 1.0);
    }
  }
}

TEST(EnergyLaw, AMirrorTurnsItRoundExactly) {
  Random random(308);
  for (int i = 0; i < 20'000; ++i) {
    Case c(random, i % 2 == 0 ? EnergyRoot::rebound : EnergyRoot::break_through);
    const Situation mirror = mirrored(c.situation);
    const EnergySolution a = solveEnergy(c.mobility, c.before, c.demand);
    const EnergySolution b =
        solveEnergy(contactMobility(mirror.vehicle, mirror.other, mirror.normal),
                    contactVelocity(mirror.vehicle, mirror.other, mirror.normal), c.demand);
    ASSERT_EQ(a.contact.impulse.normal, b.contact.impulse.normal) << i << '\n' << c;
    ASSERT_EQ(a.contact.impulse.tangent, -b.contact.impulse.tangent) << i << '\n' << c;
    ASSERT_EQ(a.outcome, b.outcome) << i << '\n' << c;
    ASSERT_EQ(a.energyRatio, b.energyRatio) << i << '\n' << c;
  }
}

TEST(EnergyLaw, SlowImpactsAreFastOnesInSmall) {
  Random random(309);
  constexpr double small = 0x1p-20;
  for (int i = 0; i < 20'000; ++i) {
    const Case c(random, i % 2 == 0 ? EnergyRoot::rebound : EnergyRoot::break_through);
    EnergyDemand slowDemand = c.demand;
    slowDemand.energyBefore *= small * small;
    const EnergySolution fast = solveEnergy(c.mobility, c.before, c.demand);
    const EnergySolution slow = solveEnergy(
        c.mobility, {.normal = small * c.before.normal, .tangent = small * c.before.tangent},
        slowDemand);
    ASSERT_EQ(slow.contact.impulse.normal, small * fast.contact.impulse.normal) << i << '\n' << c;
    ASSERT_EQ(slow.contact.impulse.tangent, small * fast.contact.impulse.tangent) << i << '\n' << c;
    ASSERT_EQ(slow.energyRatio, fast.energyRatio) << i << '\n' << c;
    ASSERT_EQ(slow.outcome, fast.outcome) << i << '\n' << c;
  }
}

TEST(EnergyLaw, HeadOnGoesThroughAsTheRootsSay) {
  // One mass without turning: v' = ∓ v √P.
  const ContactMobility mobility{.normal = 1.0 / 1500.0, .tangent = 1.0 / 1500.0};
  const ContactVelocity before{.normal = -26.8, .tangent = 0.0};
  EnergyDemand demand{.energyRatio = 0.04, .energyBefore = 0.5 * 1500.0 * 26.8 * 26.8};
  const EnergySolution rebound = solveEnergy(mobility, before, demand);
  EXPECT_EQ(rebound.outcome, EnergyOutcome::met);
  EXPECT_NEAR(rebound.contact.velocityAfter.normal, 26.8 * 0.2, 1e-11);
  demand.root = EnergyRoot::break_through;
  const EnergySolution through = solveEnergy(mobility, before, demand);
  EXPECT_EQ(through.outcome, EnergyOutcome::met);
  EXPECT_NEAR(through.contact.velocityAfter.normal, -26.8 * 0.2, 1e-11);
}

}  // namespace
}  // namespace bumper::tests
