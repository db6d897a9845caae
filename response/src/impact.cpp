// One impact of a vehicle on a wall or another body: curves are read at the angle of attack, a law
// gives the impulse, and the impulse the motions after it.

#include "bumper/response/impact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bumper {

namespace {

EnergySolution answerByEnergy(const ContactMobility& mobility, const ContactVelocity& velocity,
                              const EnergyDemand& demand, Method method) {
  return method == Method::paper ? solveEnergyAsPrinted(mobility, velocity, demand)
                                 : solveEnergy(mobility, velocity, demand);
}

ContactSolution answerByRestitution(const ContactMobility& mobility,
                                    const ContactVelocity& velocity, double restitution,
                                    const Friction& friction, Method method) {
  return method == Method::paper
             ? solveRestitutionAsPrinted(mobility, velocity, restitution, friction.value)
             : solveRestitution(mobility, velocity, restitution, friction);
}

// The data of an impact before its response.
ImpactResponse before(const PlanarBody& vehicle, const PlanarBody& other,
                      const ContactVelocity& velocity) {
  ImpactResponse response;
  response.before = vehicle.motion;
  response.otherBefore = other.motion;
  response.otherAfter = other.motion;
  response.approachSpeed = -velocity.normal;
  return response;
}

// Of all free bodies; of one vehicle alone as seen from what it hits: a gate that hits a vehicle at
// rest gives it energy, and loses none.
double energyOf(const Impact& impact, const PlanarBody& vehicle, const PlanarBody& other) {
  if (other.isFree()) return vehicle.energy() + other.energy();
  PlanarBody seen = vehicle;
  seen.motion.velocity -= velocityAt(other.motion, impact.otherArm - impact.arm);
  seen.motion.yawRate -= other.motion.yawRate;
  return seen.energy();
}

// Applies an impulse to the vehicle, and its opposite to the other body.
void apply(ImpactResponse& response, const Impact& impact, PlanarBody vehicle, PlanarBody other,
           const PlanarImpulse& impulse) {
  const double energyBefore = energyOf(impact, vehicle, other);
  vehicle.apply(impulse);
  other.apply({.linear = -impulse.linear, .angular = -cross(impact.otherArm, impulse.linear)});
  response.impulse = impulse;
  response.after = vehicle.motion;
  response.otherAfter = other.motion;
  if (energyBefore > 0.0) {
    response.energyRatio = energyOf(impact, vehicle, other) / energyBefore;
  }
}

// The vehicle's motion relative to the other body.
PlanarMotion relativeMotion(const Impact& impact, const PlanarBody& vehicle,
                            const PlanarBody& other) {
  PlanarMotion relative = vehicle.motion;
  relative.velocity -= velocityAt(other.motion, impact.otherArm);
  return relative;
}

}  // namespace

AttackDirection attackDirection(const Impact& impact, const PlanarMotion& motion,
                                AngleDefinition definition) {
  switch (definition) {
    case AngleDefinition::contact_velocity:
      break;
    case AngleDefinition::centre_velocity:
      return attackOn(motion.velocity, impact.normal);
    case AngleDefinition::heading:
      return attackOn(rotated(Vector2::UnitX(), motion.yaw), impact.normal);
  }
  return attackOn(velocityAt(motion, impact.arm), impact.normal);
}

AnglesOfAttack anglesOfAttack(const Impact& impact, const PlanarMotion& motion) {
  const auto by = [&](AngleDefinition definition) {
    return attackDirection(impact, motion, definition).angle();
  };
  return {.contactVelocity = by(AngleDefinition::contact_velocity),
          .centreVelocity = by(AngleDefinition::centre_velocity),
          .heading = by(AngleDefinition::heading)};
}

ImpactResponse respond(const Impact& impact, const PlanarBody& vehicle,
                       const ResponseSettings& settings, Rebound rebound) {
  return respond(impact, vehicle, PlanarBody{}, settings, rebound);
}

ImpactResponse respond(const Impact& impact, const PlanarBody& vehicle, const PlanarBody& other,
                       const ResponseSettings& settings, Rebound rebound) {
  const ContactBody own = contactBody(vehicle, impact.arm);
  const ContactBody others = contactBody(other, impact.otherArm);
  const ContactMobility mobility = contactMobility(own, others, impact.normal);
  const ContactVelocity velocity = contactVelocity(own, others, impact.normal);

  ImpactResponse response = before(vehicle, other, velocity);
  response.law = rebound == Rebound::elastic ? Law::restitution : settings.law;
  const AttackDirection attack =
      attackDirection(impact, relativeMotion(impact, vehicle, other), settings.angle);
  response.friction = settings.friction(attack);

  double fade = rebound == Rebound::none ? 0.0 : 1.0;
  if (settings.method == Method::bumper && settings.restSpeed > 0.0) {
    fade *= std::clamp(response.approachSpeed / settings.restSpeed, 0.0, 1.0);
  }

  if (settings.law == Law::energy && rebound != Rebound::elastic) {
    response.energyAsked = settings.energyRemaining(attack);
    const EnergySolution solution =
        answerByEnergy(mobility, velocity,
                       {.energyRatio = response.energyAsked,
                        .energyBefore = energyOf(impact, vehicle, other),
                        .friction = response.friction,
                        .maxRestitution = fade * settings.maxRestitution,
                        .root = settings.energyRoot},
                       settings.method);
    response.contact = solution.contact;
    response.outcome = solution.outcome;
    response.restitution = solution.contact.restitution;
    response.brokeThrough = settings.energyRoot == EnergyRoot::break_through &&
                            solution.outcome != EnergyOutcome::no_break_through &&
                            solution.contact.velocityAfter.normal < 0.0;
  } else {
    response.energyAsked = std::numeric_limits<double>::quiet_NaN();
    response.restitution = rebound == Rebound::elastic ? 1.0 : fade * settings.restitution(attack);
    const Friction friction{.kind = settings.frictionKind, .value = response.friction};
    response.contact = settings.restitutionKind == RestitutionKind::kudlich_slibar
                           ? solveKudlichSlibar(mobility, velocity, response.restitution, friction)
                           : answerByRestitution(mobility, velocity, response.restitution, friction,
                                                 settings.method);
  }
  apply(response, impact, vehicle, other,
        onVehicle(response.contact.impulse, impact.normal, impact.arm));
  return response;
}

ImpactResponse reduced(const ImpactResponse& whole, const Impact& impact, const PlanarBody& vehicle,
                       const PlanarBody& other, double share) {
  const ContactBody own = contactBody(vehicle, impact.arm);
  const ContactBody others = contactBody(other, impact.otherArm);
  const ContactMobility mobility = contactMobility(own, others, impact.normal);
  const ContactVelocity before = contactVelocity(own, others, impact.normal);
  ImpactResponse response = whole;
  ContactSolution& contact = response.contact;
  contact.impulse = {.normal = share * whole.contact.impulse.normal,
                     .tangent = share * whole.contact.impulse.tangent};
  contact.velocityAfter = afterImpulse(before, mobility, contact.impulse);
  contact.restitution = -contact.velocityAfter.normal / before.normal;
  contact.energyChange = energyChange(before, mobility, contact.impulse);
  response.restitution = contact.restitution;
  apply(response, impact, vehicle, other, onVehicle(contact.impulse, impact.normal, impact.arm));
  return response;
}

ImpactResponse plainResponse(const Impact& impact, const PlanarBody& vehicle,
                             const PlanarImpulse& impulse) {
  return plainResponse(impact, vehicle, PlanarBody{}, impulse);
}

ImpactResponse plainResponse(const Impact& impact, const PlanarBody& vehicle,
                             const PlanarBody& other, const PlanarImpulse& impulse) {
  const ContactBody own = contactBody(vehicle, impact.arm);
  const ContactBody others = contactBody(other, impact.otherArm);
  const ContactVelocity velocity = contactVelocity(own, others, impact.normal);
  const ContactMobility mobility = contactMobility(own, others, impact.normal);
  ImpactResponse response = before(vehicle, other, velocity);
  response.energyAsked = std::numeric_limits<double>::quiet_NaN();
  response.contact.impulse = {.normal = impulse.linear.dot(impact.normal),
                              .tangent = impulse.linear.dot(turnedLeft(impact.normal))};
  response.contact.criticalRatio = std::numeric_limits<double>::quiet_NaN();
  apply(response, impact, vehicle, other, impulse);
  response.contact.velocityAfter = afterImpulse(velocity, mobility, response.contact.impulse);
  response.contact.energyChange = energyChange(velocity, mobility, response.contact.impulse);
  response.contact.regime = Regime::sticking;
  return response;
}

}  // namespace bumper
