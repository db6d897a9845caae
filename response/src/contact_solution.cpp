#include "contact_solution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bumper {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// J* D: the impulse that ends the slip and leaves with −e v_n, up to the factor D > 0.
ContactImpulse stickingImpulse(const ContactMobility& mobility, const ContactVelocity& before,
                               double restitution) {
  const double gain = -(1.0 + restitution) * before.normal;
  return {.normal = gain * mobility.tangent + mobility.coupling * before.tangent,
          .tangent = -before.tangent * mobility.normal - gain * mobility.coupling};
}

}  // namespace

double againstSlip(double slip) { return slip > 0.0 ? -1.0 : (slip < 0.0 ? 1.0 : 0.0); }

double normalImpulse(const ContactMobility& mobility, const ContactVelocity& before,
                     double restitution, double ratio) {
  return -(1.0 + restitution) * before.normal / (mobility.normal + ratio * mobility.coupling);
}

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

}  // namespace bumper
