#pragma once

#include "bumper/base/api.h"
#include "bumper/response/restitution_law.h"

namespace BUMPER_API bumper {

/// Which root of Eq. 32 is wanted.
enum class EnergyRoot {
  rebound,       ///< the larger force: the vehicle leaves the wall
  break_through  ///< the smaller force: the vehicle loses energy and goes on through the wall
};

/// How the energy after an impact compares with the energy required. Where several reasons apply:
/// no_break_through before below_reach before limited_by_restitution before limited_by_friction.
enum class EnergyOutcome {
  not_asked,               ///< another law was used
  met,                     ///< the required energy remains
  limited_by_restitution,  ///< the rebound required lies outside [0, maxRestitution]
  limited_by_friction,     ///< the impulse required would drag the contact point backwards
  below_reach,      ///< no impulse in this direction dissipates that much: the most is dissipated
  no_break_through  ///< the smaller root does not let the vehicle through: it rebounds
};

/// The inputs of the energy method for one contact.
struct EnergyDemand {
  double energyRatio = 1.0;     ///< P: the fraction of energy that is to remain (Eq. 18), [0, 1]
  double energyBefore = 0.0;    ///< E₁: yaw-plane energy before the impact (Eq. 25), J
  double friction = 0.0;        ///< μ ≥ 0 (Eq. 36)
  double maxRestitution = 0.3;  ///< rebound speed at most this times the approach speed
  EnergyRoot root = EnergyRoot::rebound;
};

/// Both roots of Eq. 32, as impulses along the direction n − sign(v_t) μ t per unit of its normal
/// component, N s.
struct EnergyRoots {
  bool real = false;     ///< false: P lies below what any impulse in this direction can reach
  double smaller = 0.0;  ///< meaningful only if real
  double larger = 0.0;
  double deepest = 0.0;  ///< the impulse that takes most energy
};

/// Eqs. 19–35 with F₀ Δt as the unknown.
EnergyRoots energyRoots(const ContactMobility& mobility, const ContactVelocity& before,
                        const EnergyDemand& demand);

struct EnergySolution {
  ContactSolution contact;
  double energyRatio = 1.0;  ///< P attained
  EnergyOutcome outcome = EnergyOutcome::met;
};

/// The kinetic energy loss method (Eqs. 18–35) within physical bounds. A rebound takes the larger
/// root, or the impulse that dissipates most if there is no real root; its normal velocity is then
/// kept within [0, maxRestitution] times the approach speed, and if the slip would be reversed the
/// restitution law applies for that normal velocity. A break-through takes the smaller root if the
/// contact point still approaches after it, but no faster than before.
EnergySolution solveEnergy(const ContactMobility& mobility, const ContactVelocity& before,
                           const EnergyDemand& demand);

/// Eq. 32 as printed: the requested root, without bounds; without a real root the impulse that
/// dissipates most. A negative root (a pull) gives no impulse.
EnergySolution solveEnergyAsPrinted(const ContactMobility& mobility, const ContactVelocity& before,
                                    const EnergyDemand& demand);

}  // namespace bumper
