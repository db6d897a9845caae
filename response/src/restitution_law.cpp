#include "bumper/response/restitution_law.h"

#include <cmath>

#include "contact_solution.h"

namespace bumper {

namespace {

// An energy gain that rounding alone can cause in an elastic impact.
constexpr double energyRounding = 1e-13;

bool createsEnergy(const ContactSolution& solution, const ContactVelocity& before) {
  const double scale = std::abs(before.normal * solution.impulse.normal) +
                       std::abs(before.tangent * solution.impulse.tangent);
  return solution.energyChange > energyRounding * scale;
}

}  // namespace

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
  // restitution that still does. 60 bisections reach rounding.
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

ContactSolution solveKudlichSlibar(const ContactMobility& mobility, const ContactVelocity& before,
                                   double restitution, const Friction& friction) {
  const ContactSolution compression = solveRestitution(mobility, before, 0.0, friction);
  if (compression.regime == Regime::separating) return compression;
  const double times = 1.0 + restitution;
  ContactSolution solution = describe(mobility, before,
                                      {.normal = times * compression.impulse.normal,
                                       .tangent = times * compression.impulse.tangent});
  solution.impulseRatio = compression.impulseRatio;
  solution.criticalRatio = compression.criticalRatio;
  solution.regime = compression.regime;
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
