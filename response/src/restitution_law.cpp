#include "bumper/response/restitution_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_solution.h"

namespace bumper {

namespace {

// A gain that rounding alone can make of an impact that neither takes nor gives energy.
constexpr double energyRounding = 1e-13;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double againstSlip(double slip) { return slip > 0.0 ? -1.0 : (slip < 0.0 ? 1.0 : 0.0); }

bool createsEnergy(const ContactSolution& solution, const ContactVelocity& before) {
  const double scale = std::abs(before.normal * solution.impulse.normal) +
                       std::abs(before.tangent * solution.impulse.tangent);
  return solution.energyChange > energyRounding * scale;
}

// J* D: the impulse that ends the slip and leaves with −e v_n, up to the factor D > 0.
ContactImpulse stickingImpulse(const ContactMobility& mobility, const ContactVelocity& before,
                               double restitution) {
  const double gain = -(1.0 + restitution) * before.normal;
  return {.normal = gain * mobility.tangent + mobility.coupling * before.tangent,
          .tangent = -before.tangent * mobility.normal - gain * mobility.coupling};
}

// J_n for a normal velocity after of −e v_n when J_t = ratio · J_n (Eq. 17 with a signed μ).
double normalImpulse(const ContactMobility& mobility, const ContactVelocity& before,
                     double restitution, double ratio) {
  return -(1.0 + restitution) * before.normal / (mobility.normal + ratio * mobility.coupling);
}

}  // namespace

ContactSolution describe(const ContactMobility& mobility, const ContactVelocity& before,
                         const ContactImpulse& impulse) {
  ContactSolution solution;
  solution.impulse = impulse;
  solution.velocityAfter = afterImpulse(before, mobility, impulse);
  solution.restitution = -solution.velocityAfter.normal / before.normal;
  solution.impulseRatio = impulse.normal != 0.0 ? impulse.tangent / impulse.normal : 0.0;
  solution.energyChange = energyChange(before, mobility, impulse);
  return solution;
}

Regime slipRegime(double before, double after) {
  return before * after < 0.0 ? Regime::reverse_slip : Regime::sliding;
}

double criticalImpulseRatio(const ContactMobility& mobility, const ContactVelocity& before,
                            double restitution) {
  const ContactImpulse stick = stickingImpulse(mobility, before, restitution);
  return stick.normal > 0.0 ? stick.tangent / stick.normal : nan;
}

ContactSolution solveForNormalVelocity(const ContactMobility& mobility,
                                       const ContactVelocity& before, double restitution,
                                       const Friction& friction) {
  const ContactImpulse stick = stickingImpulse(mobility, before, restitution);
  const bool canStick = stick.normal > 0.0;
  const double critical = canStick ? stick.tangent / stick.normal : nan;

  // The slip after the impact grows steadily with the impulse ratio λ, at q D / (A + λC)² with
  // q = −(1+e) v_n, and vanishes at the critical ratio: one clamp covers sliding, sticking and
  // reverse slip.
  //
  // A + λC stays positive. It is linear in λ, A > 0 at λ = 0 and q / J_n* > 0 at the critical
  // ratio, and the clamp leaves λ between those two. Where J_n* ≤ 0 there is no critical ratio;
  // then q B + C v_t ≤ 0, so friction against the slip has the sign of C and λC ≥ 0.
  double ratio = 0.0;
  if (!canStick) {
    ratio = againstSlip(before.tangent) * friction.value;
  } else if (friction.kind == Friction::Kind::coulomb) {
    ratio = std::clamp(critical, -friction.value, friction.value);
  } else {
    ratio = friction.value * critical;
  }
  const bool sticks = canStick && ratio == critical;

  ContactImpulse impulse;
  if (sticks) {
    // Not q / (A + λC), which is 0 / 0 where a fast slip jams.
    impulse = {.normal = stick.normal / mobility.determinant(),
               .tangent = stick.tangent / mobility.determinant()};
  } else {
    impulse.normal = normalImpulse(mobility, before, restitution, ratio);
    impulse.tangent = ratio * impulse.normal;
  }
  ContactSolution solution = describe(mobility, before, impulse);
  // By construction; read off the velocities it would be noise where the slip is much faster.
  solution.restitution = restitution;
  solution.impulseRatio = ratio;
  solution.criticalRatio = critical;
  solution.regime =
      sticks ? Regime::sticking : slipRegime(before.tangent, solution.velocityAfter.tangent);
  return solution;
}

ContactSolution solveRestitution(const ContactMobility& mobility, const ContactVelocity& before,
                                 double restitution, const Friction& friction) {
  if (!(before.normal < 0.0)) {
    ContactSolution none;
    none.velocityAfter = before;
    return none;
  }
  ContactSolution solution = solveForNormalVelocity(mobility, before, restitution, friction);
  if (!createsEnergy(solution, before)) return solution;

  // Without restitution an impact with capped friction only loses energy; find the largest
  // restitution that still does. Each halving is exact to keep: 60 of them reach rounding.
  double safe = 0.0;
  double tooMuch = restitution;
  solution = solveForNormalVelocity(mobility, before, safe, friction);
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (safe + tooMuch);
    const ContactSolution trial = solveForNormalVelocity(mobility, before, middle, friction);
    if (trial.energyChange > 0.0) {
      tooMuch = middle;
    } else {
      safe = middle;
      solution = trial;
    }
  }
  solution.restitutionLowered = true;
  return solution;
}

ContactSolution solveRestitutionAsPrinted(const ContactMobility& mobility,
                                          const ContactVelocity& before, double restitution,
                                          double friction) {
  const double ratio = againstSlip(before.tangent) * friction;
  const double denominator = mobility.normal + ratio * mobility.coupling;  // h − μk
  if (!(before.normal < 0.0) || denominator <= 0.0) {
    ContactSolution none;
    none.velocityAfter = before;
    return none;
  }
  const double normal = normalImpulse(mobility, before, restitution, ratio);
  ContactSolution solution =
      describe(mobility, before, {.normal = normal, .tangent = ratio * normal});
  solution.impulseRatio = ratio;
  solution.criticalRatio = criticalImpulseRatio(mobility, before, restitution);
  solution.regime = slipRegime(before.tangent, solution.velocityAfter.tangent);
  return solution;
}

}  // namespace bumper
