#include "bumper/response/restitution_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_solution.h"

namespace bumper {

namespace {

// A gain that rounding alone can make of an impact that neither takes nor gives energy.
constexpr double energyRounding = 1e-13;

double againstSlip(double slip) { return slip > 0.0 ? -1.0 : (slip < 0.0 ? 1.0 : 0.0); }

bool createsEnergy(const ContactSolution& solution, const ContactVelocity& before) {
  const double scale = std::abs(before.normal * solution.impulse.normal) +
                       std::abs(before.tangent * solution.impulse.tangent);
  return solution.energyChange > energyRounding * scale;
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
  const double gain = -(1.0 + restitution) * before.normal;
  // Both share the factor 1/D > 0, which drops out of their ratio.
  const double normal = gain * mobility.tangent + mobility.coupling * before.tangent;
  const double tangent = -before.tangent * mobility.normal - gain * mobility.coupling;
  if (normal <= 0.0) {
    return againstSlip(before.tangent) * std::numeric_limits<double>::infinity();
  }
  return tangent / normal;
}

ContactSolution solveForNormalVelocity(const ContactMobility& mobility,
                                       const ContactVelocity& before, double restitution,
                                       const Friction& friction) {
  const double critical = criticalImpulseRatio(mobility, before, restitution);
  double ratio = 0.0;
  bool sticks = false;
  if (friction.kind == Friction::Kind::coulomb || std::isinf(critical)) {
    // The slip after the impact grows steadily with the ratio λ, at q D / (A + λC)² with
    // q = −(1+e) v_n, and vanishes at the critical ratio: one clamp covers sliding, sticking and
    // reverse slip.
    //
    // A + λC stays positive. It is linear in λ, A > 0 at λ = 0 and q / J_n* > 0 at the critical
    // ratio, and the clamp leaves λ between those two. Where J_n* ≤ 0 there is no critical ratio;
    // then q B + C v_t ≤ 0, so friction against the slip has the sign of C and λC ≥ 0.
    ratio = std::clamp(critical, -friction.value, friction.value);
    sticks = ratio == critical;
  } else {
    ratio = friction.value * critical;
    sticks = friction.value == 1.0;
  }
  const double normal = normalImpulse(mobility, before, restitution, ratio);
  ContactSolution solution =
      describe(mobility, before, {.normal = normal, .tangent = ratio * normal});
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
