#pragma once

#include "bumper/base/api.h"
#include "bumper/response/angle_curve.h"
#include "bumper/response/energy_law.h"
#include "bumper/response/restitution_law.h"

namespace BUMPER_API bumper {

enum class Method {
  bumper,  ///< the paper's scheme with its gaps closed
  paper  ///< the paper to the letter: Eq. 17 uncapped, Eq. 32 unbounded, the overlap's own midpoint
};

enum class Law {
  restitution,  ///< the coefficient of restitution method
  energy        ///< the kinetic energy loss method
};

/// How walls respond. The defaults are the paper's.
struct ResponseSettings {
  Method method = Method::bumper;
  Law law = Law::restitution;
  /// The angle at which the curves below are read.
  AngleDefinition angle = AngleDefinition::contact_velocity;
  /// e(α), values in [0, 1] (Figure 4).
  AngleCurve restitution = AngleCurve::cosine(0.3, 0.05);
  /// What e refers to; Method::bumper and the restitution law only.
  RestitutionKind restitutionKind = RestitutionKind::newton;
  /// μ(α), values ≥ 0; with fraction_of_critical in [0, 1].
  AngleCurve friction = AngleCurve::cosine(0.3, 0.0);
  /// The energy law and Method::paper support coulomb only.
  Friction::Kind frictionKind = Friction::Kind::coulomb;
  /// P(α), values in [0, 1]: the fraction of yaw-plane energy that remains. Energy law only.
  AngleCurve energyRemaining = AngleCurve::cosine(0.92, 0.04);
  /// Energy law only.
  EnergyRoot energyRoot = EnergyRoot::rebound;
  /// A rebound of the energy law leaves with at most this times the approach speed; [0, 1].
  double maxRestitution = 0.3;
  /// The contact point is found at the depth that the approach speed reaches in this time, s, ≥ 0.
  /// Method::bumper only; response/README.md says how the default was chosen.
  double penetrationTime = 0.0025;
  /// What stands out of a wall, or gapes in it, by less than this does not catch a vehicle that
  /// slides along: a share of the outline's length, ≥ 0; 0.0045 are 2 cm for a car. The outline may
  /// lie as deep as that in such a feature, and is eased out. Method::bumper only.
  double smallestFeature = 0.0045;
  /// Length of the force pulse, s, ≥ 0, which starts at the impact; 0: one step. With a longer one
  /// the wall causes no further impact while its pulse runs, and the vehicle penetrates it by about
  /// v_n · contactTime / (2 (1 + e)).
  double contactTime = 0.0;
  /// Restitution fades to 0 as the approach speed falls from this to 0, m/s, ≥ 0, so that a vehicle
  /// against a wall comes to rest. Slower contacts cause no impact events.
  double restSpeed = 0.1;
};

/// Whether walls with these settings can break and let a vehicle through.
inline bool breaks(const ResponseSettings& settings) {
  return settings.law == Law::energy && settings.energyRoot == EnergyRoot::break_through;
}

/// Throws Error, naming the value, if one lies outside its range.
void validate(const ResponseSettings& settings);

}  // namespace bumper
