#include "bumper/response/energy_law.h"

#include <algorithm>
#include <cmath>

#include "contact_solution.h"

namespace bumper {

namespace {

// The impulse's direction d = n + ratio · t, and what Eqs. 31–35 need of it. With F₀ Δt d = J d the
// energy change is closing · J + ½ mobility · J²: the paper's B/2 and A, up to Δt.
struct Direction {
  double ratio = 0.0;
  double closing = 0.0;     // q = v · d
  double mobility = 0.0;    // K = d · M d
  double normalGain = 0.0;  // Δv_n per J
};

Direction frictionDirection(const ContactMobility& mobility, const ContactVelocity& before,
                            double friction) {
  Direction d;
  if (before.tangent != 0.0) d.ratio = -std::copysign(friction, before.tangent);
  d.closing = before.normal + d.ratio * before.tangent;
  d.mobility =
      mobility.normal + 2.0 * d.ratio * mobility.coupling + d.ratio * d.ratio * mobility.tangent;
  d.normalGain = mobility.normal + d.ratio * mobility.coupling;
  return d;
}

EnergyRoots rootsAlong(const Direction& d, const EnergyDemand& demand) {
  EnergyRoots roots;
  roots.deepest = -d.closing / d.mobility;
  const double loss = (1.0 - demand.energyRatio) * demand.energyBefore;
  const double discriminant = d.closing * d.closing - 2.0 * d.mobility * loss;
  roots.real = discriminant >= 0.0;
  if (roots.real) {
    roots.larger = (-d.closing + std::sqrt(discriminant)) / d.mobility;
    // The product of the roots is known; taking the difference instead would cancel digits.
    roots.smaller = roots.larger > 0.0 ? 2.0 * loss / (d.mobility * roots.larger) : 0.0;
  }
  return roots;
}

EnergySolution finish(const ContactSolution& contact, const EnergyDemand& demand,
                      EnergyOutcome outcome) {
  EnergySolution solution;
  solution.contact = contact;
  solution.outcome = outcome;
  if (demand.energyBefore > 0.0) {
    solution.energyRatio = 1.0 + contact.energyChange / demand.energyBefore;
  }
  return solution;
}

EnergySolution separating(const ContactVelocity& before) {
  EnergySolution solution;
  solution.contact.velocityAfter = before;
  solution.outcome = EnergyOutcome::not_asked;
  return solution;
}

ContactSolution along(const Direction& d, double impulse, const ContactMobility& mobility,
                      const ContactVelocity& before) {
  ContactSolution contact =
      describe(mobility, before, {.normal = impulse, .tangent = d.ratio * impulse});
  contact.impulseRatio = d.ratio;
  contact.criticalRatio = criticalImpulseRatio(mobility, before, contact.restitution);
  contact.regime = slipRegime(before.tangent, contact.velocityAfter.tangent);
  return contact;
}

// The impulse along d, unless it would reverse the slip: then the clamp of the restitution law
// applies for the same normal velocity.
EnergySolution withoutDragging(const Direction& d, double impulse, EnergyOutcome outcome,
                               const ContactMobility& mobility, const ContactVelocity& before,
                               const EnergyDemand& demand) {
  const ContactSolution contact = along(d, impulse, mobility, before);
  const bool turned = contact.regime == Regime::reverse_slip || before.tangent == 0.0;
  if (!turned) return finish(contact, demand, outcome);
  const Friction friction{.kind = Friction::Kind::coulomb, .value = demand.friction};
  // Going on through the wall is a negative restitution, which the public law does not support.
  const ContactSolution capped =
      contact.restitution < 0.0
          ? solveForNormalVelocity(mobility, before, contact.restitution, friction)
          : solveRestitution(mobility, before, contact.restitution, friction);
  if (capped.impulseRatio == d.ratio) return finish(contact, demand, outcome);
  return finish(capped, demand,
                outcome == EnergyOutcome::met ? EnergyOutcome::limited_by_friction : outcome);
}

EnergySolution rebound(const Direction& d, const EnergyRoots& roots,
                       const ContactMobility& mobility, const ContactVelocity& before,
                       const EnergyDemand& demand) {
  EnergyOutcome outcome = roots.real ? EnergyOutcome::met : EnergyOutcome::below_reach;
  double impulse = roots.real ? roots.larger : roots.deepest;
  const double approach = -before.normal;
  const double leaving = before.normal + d.normalGain * impulse;
  const double allowed = std::clamp(leaving, 0.0, demand.maxRestitution * approach);
  if (allowed != leaving) {
    if (roots.real) outcome = EnergyOutcome::limited_by_restitution;
    if (d.normalGain <= 0.0) {
      // Full friction would pull the vehicle in; such a slip always reverses first.
      return finish(solveRestitution(mobility, before, allowed / approach,
                                     {.kind = Friction::Kind::coulomb, .value = demand.friction}),
                    demand, outcome);
    }
    impulse = (allowed - before.normal) / d.normalGain;
  }
  return withoutDragging(d, impulse, outcome, mobility, before, demand);
}

}  // namespace

EnergyRoots energyRoots(const ContactMobility& mobility, const ContactVelocity& before,
                        const EnergyDemand& demand) {
  return rootsAlong(frictionDirection(mobility, before, demand.friction), demand);
}

EnergySolution solveEnergy(const ContactMobility& mobility, const ContactVelocity& before,
                           const EnergyDemand& demand) {
  if (!(before.normal < 0.0)) return separating(before);
  const Direction d = frictionDirection(mobility, before, demand.friction);
  const EnergyRoots roots = rootsAlong(d, demand);
  if (demand.root == EnergyRoot::break_through) {
    if (roots.real) {
      EnergySolution through =
          withoutDragging(d, roots.smaller, EnergyOutcome::met, mobility, before, demand);
      const double after = through.contact.velocityAfter.normal;
      if (before.normal <= after && after < 0.0) return through;
    }
    EnergySolution stopped = rebound(d, roots, mobility, before, demand);
    stopped.outcome = EnergyOutcome::no_break_through;
    return stopped;
  }
  return rebound(d, roots, mobility, before, demand);
}

EnergySolution solveEnergyAsPrinted(const ContactMobility& mobility, const ContactVelocity& before,
                                    const EnergyDemand& demand) {
  if (!(before.normal < 0.0)) return separating(before);
  const Direction d = frictionDirection(mobility, before, demand.friction);
  const EnergyRoots roots = rootsAlong(d, demand);
  double impulse = roots.deepest;
  if (roots.real) {
    impulse = demand.root == EnergyRoot::rebound ? roots.larger : roots.smaller;
  }
  if (impulse <= 0.0) return separating(before);
  return finish(along(d, impulse, mobility, before), demand,
                roots.real ? EnergyOutcome::met : EnergyOutcome::below_reach);
}

}  // namespace bumper
