#pragma once

#include "bumper/base/api.h"
#include "bumper/response/contact_solve.h"

namespace BUMPER_API bumper {

/// How the contact point slides in an impact.
enum class Regime {
  separating,   ///< it does not approach: no impulse
  sliding,      ///< it keeps sliding in the same direction, at full friction
  sticking,     ///< friction ends the slip
  reverse_slip  ///< the normal impulse reverses the slip; full friction opposes the reversed slip
};

/// Friction at the contact, Eq. 36.
struct Friction {
  enum class Kind {
    coulomb,  ///< |J_t| ≤ value · J_n
    /// J_t/J_n = value · (the impulse ratio that just ends the slip), after Brach; where no
    /// compressive impulse ends the slip the value is taken as Coulomb's.
    fraction_of_critical
  };
  Kind kind = Kind::coulomb;
  double value = 0.0;  ///< ≥ 0; a fraction of the critical ratio lies in [0, 1]
};

/// What restitution refers to.
enum class RestitutionKind {
  newton,         ///< the normal velocity after, −e v_n; friction is that of the whole impact
  kudlich_slibar  ///< the whole impulse, 1 + e times the one that ends the approach
};

/// A law's solution for one contact point.
struct ContactSolution {
  ContactImpulse impulse;         ///< on the vehicle, N s
  ContactVelocity velocityAfter;  ///< of the contact point, m/s
  double restitution = 0.0;       ///< −v_n'/v_n attained
  double impulseRatio = 0.0;      ///< J_t/J_n
  /// J_t/J_n that just ends the slip at this restitution; NaN where no compressive impulse does.
  double criticalRatio = 0.0;
  double energyChange = 0.0;  ///< J, ≤ 0
  Regime regime = Regime::separating;
  bool restitutionLowered = false;  ///< the requested restitution would have added energy
};

/// The coefficient-of-restitution method (Eqs. 3–17): the impulse after which the contact point
/// leaves with −e v_n, friction opposing the slip that remains.
///
/// It equals Eq. 17 wherever full friction does not reverse the slip. Where it would, Eq. 17 drags
/// the contact point backwards; here the impulse ratio stops at the critical one. Where the
/// requested restitution would add energy (never seen within the paper's 0 to 0.3 for both e and
/// μ), it is lowered until none is added, and `restitutionLowered` is set.
///
/// `restitution` lies in [0, 1]. All but criticalRatio is finite for finite input with A > 0, B >
/// 0, A B > C².
ContactSolution solveRestitution(const ContactMobility& mobility, const ContactVelocity& before,
                                 double restitution, const Friction& friction);

/// The law of Kudlich and Slibar, which reconstruction programs use: the impulse that ends the
/// approach, with friction up to the ratio that ends the slip too, times 1 + e. It never adds
/// energy for e ≤ 1. Ranges as above.
ContactSolution solveKudlichSlibar(const ContactMobility& mobility, const ContactVelocity& before,
                                   double restitution, const Friction& friction);

/// Eq. 17 as printed: full friction against the initial slip, even if that reverses it. Added are
/// only the test for a separating contact, and no impulse where h − μk ≤ 0.
ContactSolution solveRestitutionAsPrinted(const ContactMobility& mobility,
                                          const ContactVelocity& before, double restitution,
                                          double friction);

}  // namespace bumper
