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

ContactBody bodyAt(const Impact& impact, const PlanarMotion& motion, double mass,
                   double yawInertia) {
  return {.inverseMass = 1.0 / mass,
          .inverseYawInertia = 1.0 / yawInertia,
          .arm = impact.arm,
          .velocity = motion.velocity,
          .yawRate = motion.yawRate};
}

// What is known of an impact before anything answers it.
ImpactResponse before(const PlanarMotion& motion, const ContactVelocity& velocity) {
  ImpactResponse response;
  response.before = motion;
  response.approachSpeed = -velocity.normal;
  return response;
}

void apply(ImpactResponse& response, const PlanarImpulse& impulse, double mass, double yawInertia) {
  response.impulse = impulse;
  response.after = afterImpulse(response.before, impulse, mass, yawInertia);
  const double energyBefore = yawPlaneEnergy(response.before, mass, yawInertia);
  if (energyBefore > 0.0) {
    response.energyRatio = yawPlaneEnergy(response.after, mass, yawInertia) / energyBefore;
  }
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

ImpactResponse respond(const Impact& impact, const PlanarMotion& motion, double mass,
                       double yawInertia, const ResponseSettings& settings, Rebound rebound) {
  const ContactBody vehicle = bodyAt(impact, motion, mass, yawInertia);
  const ContactMobility mobility = contactMobility(vehicle, impact.normal);
  const ContactVelocity velocity = contactVelocity(vehicle, impact.normal);
  const double energyBefore = yawPlaneEnergy(motion, mass, yawInertia);

  ImpactResponse response = before(motion, velocity);
  response.law = rebound == Rebound::elastic ? Law::restitution : settings.law;
  const AttackDirection attack = attackDirection(impact, motion, settings.angle);
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
                        .energyBefore = energyBefore,
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
    response.contact = answerByRestitution(
        mobility, velocity, response.restitution,
        {.kind = settings.frictionKind, .value = response.friction}, settings.method);
  }
  apply(response, onVehicle(response.contact.impulse, impact.normal, impact.arm), mass, yawInertia);
  return response;
}

ImpactResponse plainResponse(const Impact& impact, const PlanarMotion& motion, double mass,
                             double yawInertia, const PlanarImpulse& impulse) {
  const ContactBody vehicle = bodyAt(impact, motion, mass, yawInertia);
  const ContactVelocity velocity = contactVelocity(vehicle, impact.normal);
  ImpactResponse response = before(motion, velocity);
  response.energyAsked = std::numeric_limits<double>::quiet_NaN();
  response.contact.impulse = {.normal = impulse.linear.dot(impact.normal),
                              .tangent = impulse.linear.dot(turnedLeft(impact.normal))};
  response.contact.criticalRatio = std::numeric_limits<double>::quiet_NaN();
  apply(response, impulse, mass, yawInertia);
  response.contact.velocityAfter =
      contactVelocity(bodyAt(impact, response.after, mass, yawInertia), impact.normal);
  response.contact.energyChange =
      yawPlaneEnergy(response.after, mass, yawInertia) - yawPlaneEnergy(motion, mass, yawInertia);
  response.contact.regime = Regime::sticking;
  return response;
}

}  // namespace bumper
