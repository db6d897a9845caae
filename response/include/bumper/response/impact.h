#pragma once

#include "bumper/response/angle_curve.h"
#include "bumper/response/contact_point.h"
#include "bumper/response/response_settings.h"

namespace bumper {

/// One collision of a vehicle with a wall: where and which way. Vectors are in the frame of the
/// motion that it was found for.
struct Impact {
  int wall = -1;                     ///< WallSegment::id
  Vector2 point = Vector2::Zero();   ///< contact point on the wall, m
  Vector2 normal = Vector2::Zero();  ///< unit, out of the wall into the vehicle
  Vector2 arm = Vector2::Zero();     ///< mass centre to contact point, m
  double depth = 0.0;                ///< of the overlap when it was noticed, m
};

/// What the response makes of an impact.
struct ImpactResponse {
  Law law = Law::restitution;
  double approachSpeed = 0.0;  ///< m/s, > 0 when closing
  double restitution = 0.0;    ///< asked by e(α), or as it came out of the energy law
  double friction = 0.0;       ///< asked by μ(α)
  double energyAsked = 1.0;    ///< P(α); NaN under the restitution law
  double energyRatio = 1.0;    ///< yaw-plane energy after / before
  EnergyOutcome outcome = EnergyOutcome::not_asked;
  bool brokeThrough = false;  ///< the vehicle goes on through the wall, EnergyRoot::break_through
  ContactSolution contact;
  PlanarImpulse impulse;  ///< on the vehicle
  PlanarMotion before;
  PlanarMotion after;
};

/// The direction of attack of an impact of a vehicle that moves as `motion` says.
AttackDirection attackDirection(const Impact& impact, const PlanarMotion& motion,
                                AngleDefinition definition);

/// Its angle by all three definitions.
AnglesOfAttack anglesOfAttack(const Impact& impact, const PlanarMotion& motion);

/// What becomes of the rebound that the settings ask for.
enum class Rebound {
  as_set,
  none,     ///< the contact point stays: many impacts at one instant come to an end
  elastic,  ///< it leaves as fast as it came, the restitution law answers: a contact that lasts is
            ///< held by many small impacts, none of which may take energy
};

/// The response to an impact of a vehicle of the given mass and yaw inertia that moves as `motion`
/// says against a fixed wall: reads the curves at the angle of attack and asks the law.
ImpactResponse respond(const Impact& impact, const PlanarMotion& motion, double mass,
                       double yawInertia, const ResponseSettings& settings,
                       Rebound rebound = Rebound::as_set);

/// The same for an impulse that no law asked for: it is one of those that end the approach at
/// several points at once.
ImpactResponse plainResponse(const Impact& impact, const PlanarMotion& motion, double mass,
                             double yawInertia, const PlanarImpulse& impulse);

}  // namespace bumper
