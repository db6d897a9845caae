#pragma once

#include "bumper/base/api.h"
#include "bumper/response/angle_curve.h"
#include "bumper/response/planar_body.h"
#include "bumper/response/response_settings.h"

namespace BUMPER_API bumper {

/// One collision of a vehicle with a wall or another body: where and which way. Vectors are in the
/// frame of the motion that it was found for.
struct Impact {
  int wall = -1;                     ///< Segment::id
  Vector2 point = Vector2::Zero();   ///< contact point on the wall, m
  Vector2 normal = Vector2::Zero();  ///< unit, out of the wall into the vehicle
  Vector2 arm = Vector2::Zero();     ///< the vehicle's mass centre to the contact point, m
  /// The other body's mass centre, or the point of a moving barrier that its motion is given for,
  /// to the contact point, m; meaningless for a fixed wall.
  Vector2 otherArm = Vector2::Zero();
  double depth = 0.0;  ///< of the overlap when it was detected, m
};

/// The response to an impact.
struct ImpactResponse {
  Law law = Law::restitution;
  double approachSpeed = 0.0;  ///< m/s, > 0 when closing
  double restitution = 0.0;    ///< e(α), or the result of the energy law
  double friction = 0.0;       ///< μ(α)
  double energyAsked = 1.0;    ///< P(α); NaN under the restitution law
  /// Yaw-plane energy of all free bodies after / before; of one that hits a moving barrier as seen
  /// from that.
  double energyRatio = 1.0;
  EnergyOutcome outcome = EnergyOutcome::not_asked;
  bool brokeThrough = false;  ///< the vehicle goes on through the wall, EnergyRoot::break_through
  ContactSolution contact;
  PlanarImpulse impulse;  ///< on the vehicle
  PlanarMotion before;    ///< of the vehicle
  PlanarMotion after;
  PlanarMotion otherBefore;  ///< of the other body
  PlanarMotion otherAfter;
};

/// The direction of attack of an impact of a vehicle that moves as `motion` says on a fixed wall.
AttackDirection attackDirection(const Impact& impact, const PlanarMotion& motion,
                                AngleDefinition definition);

/// Its angle by all three definitions.
AnglesOfAttack anglesOfAttack(const Impact& impact, const PlanarMotion& motion);

/// How the rebound of the settings is modified.
enum class Rebound {
  as_set,
  none,     ///< the contact point does not rebound: ends a series of impacts at one instant
  elastic,  ///< as fast as the approach, by the restitution law: a lasting contact is carried by
            ///< many small impacts, none of which may dissipate energy
};

/// The response to an impact on a fixed wall: reads the curves at the angle of attack and evaluates
/// the law.
ImpactResponse respond(const Impact& impact, const PlanarBody& vehicle,
                       const ResponseSettings& settings, Rebound rebound = Rebound::as_set);

/// The same on another body, which takes the opposite impulse. The angle of attack is that of the
/// velocity relative to it (by AngleDefinition::heading still the vehicle's), the energies of the
/// energy law and of the result are those of both bodies, or the vehicle's as seen from a driven
/// one.
ImpactResponse respond(const Impact& impact, const PlanarBody& vehicle, const PlanarBody& other,
                       const ResponseSettings& settings, Rebound rebound = Rebound::as_set);

/// The response with `share`, in [0, 1], of its impulse: of a contact that is hardly one. It adds
/// no energy if the whole one does not.
ImpactResponse reduced(const ImpactResponse& whole, const Impact& impact, const PlanarBody& vehicle,
                       const PlanarBody& other, double share);

/// The response to an impact on a fixed wall, or on another body, by a given impulse, without a
/// law: one of those that end the approach at several points at once.
ImpactResponse plainResponse(const Impact& impact, const PlanarBody& vehicle,
                             const PlanarImpulse& impulse);
ImpactResponse plainResponse(const Impact& impact, const PlanarBody& vehicle,
                             const PlanarBody& other, const PlanarImpulse& impulse);

}  // namespace bumper
