#pragma once

#include "bumper/response/restitution_law.h"

namespace bumper {

/// The sign of friction for a slip velocity.
double againstSlip(double slip);

/// J_n for a normal velocity after of −e v_n when J_t = ratio · J_n (Eq. 17 with a signed μ).
double normalImpulse(const ContactMobility& mobility, const ContactVelocity& before,
                     double restitution, double ratio);

/// Fills in what follows from an impulse; `regime` is left to the caller.
ContactSolution describe(const ContactMobility& mobility, const ContactVelocity& before,
                         const ContactImpulse& impulse);

/// Sliding or reverse slip, by the tangential velocities before and after.
Regime slipRegime(double before, double after);

/// The impulse ratio J_t/J_n that ends both the slip and the normal velocity −e v_n (Brach's
/// critical impulse ratio); NaN where no compressive impulse does.
double criticalImpulseRatio(const ContactMobility& mobility, const ContactVelocity& before,
                            double restitution);

/// solveRestitution for a normal velocity after of −e v_n with e in (−1, 1]: negative for a vehicle
/// that goes on through the wall.
ContactSolution solveForNormalVelocity(const ContactMobility& mobility,
                                       const ContactVelocity& before, double restitution,
                                       const Friction& friction);

}  // namespace bumper
