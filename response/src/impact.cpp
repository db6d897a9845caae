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

}  // namespace

ImpactResponse respond(const Impact& impact, const PlanarMotion& motion, double mass,
                       double yawInertia, const ResponseSettings& settings,
                       double restitutionScale) {
  const ContactBody vehicle{.inverseMass = 1.0 / mass,
                            .inverseYawInertia = 1.0 / yawInertia,
                            .arm = impact.arm,
                            .velocity = motion.velocity,
                            .yawRate = motion.yawRate};
  const ContactBody barrier;
  const ContactMobility mobility = contactMobility(vehicle, barrier, impact.normal);
  const ContactVelocity velocity = contactVelocity(vehicle, barrier, impact.normal);
  const double energyBefore = yawPlaneEnergy(motion, mass, yawInertia);

  ImpactResponse response;
  response.law = settings.law;
  response.before = motion;
  response.approachSpeed = -velocity.normal;
  response.angles = {
      .contactVelocity = std::atan2(std::abs(velocity.normal), std::abs(velocity.tangent)),
      .centreVelocity = angleToWall(motion.velocity, impact.normal),
      .heading = angleToWall(rotated(Vector2::UnitX(), motion.yaw), impact.normal)};
  const double angle = response.angles.by(settings.angle);
  response.friction = settings.friction(angle);

  double fade = restitutionScale;
  if (settings.method == Method::bumper && settings.restSpeed > 0.0) {
    fade *= std::clamp(response.approachSpeed / settings.restSpeed, 0.0, 1.0);
  }

  if (settings.law == Law::energy) {
    response.energyAsked = settings.energyRemaining(angle);
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
    response.restitution = fade * settings.restitution(angle);
    response.contact = answerByRestitution(
        mobility, velocity, response.restitution,
        {.kind = settings.frictionKind, .value = response.friction}, settings.method);
  }
  response.impulse = onVehicle(response.contact.impulse, impact.normal, impact.arm);
  response.after = afterImpulse(motion, response.impulse, mass, yawInertia);
  if (energyBefore > 0.0) {
    response.energyRatio = yawPlaneEnergy(response.after, mass, yawInertia) / energyBefore;
  }
  return response;
}

}  // namespace bumper
