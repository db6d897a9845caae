// Events: impacts, and contacts that begin and end.

#include <algorithm>
#include <utility>

#include "responder_implementation.h"
#include "sustained_contacts.h"

namespace bumper {

namespace {

// A contact that begins more slowly than this, m/s, is rounding.
constexpr double noticedSpeed = 1e-6;

}  // namespace

// `wall` is any of those that make one face with the one that was hit.
ImpactEvent Responder::Implementation::eventAt(const Vehicle& vehicle, const Barrier& barrier,
                                               int wall, const Eigen::Vector3d& contact,
                                               const Eigen::Vector3d& normal) {
  ImpactEvent event;
  event.vehicle = vehicle.name;
  event.barrier = barrier.name();
  event.triangle = barrier.triangleOf(barrier.wallAt(wall, contact));
  event.material = barrier.materialOf(wall);
  event.contact = contact;
  event.normal = normal;
  return event;
}

void Responder::Implementation::reportImpact(Vehicle& vehicle, const Barrier& barrier, int wall,
                                             const StepImpact& each) {
  const VehicleState& state = vehicle.reading.state;
  const Impact& impact = each.impact;
  const ImpactResponse& response = each.response;
  const Eigen::Vector3d contact = state.massCentre + state.toWorld(impact.point);
  const Eigen::Vector3d normal = state.toWorld(impact.normal);
  const double when = time + each.time;
  const double energyLost = -response.contact.energyChange;

  const ResponseSettings& settings = barrier.settings(barrier.settingsNumberOf(wall));
  const bool hard =
      response.approachSpeed > impactSpeed(vehicle.memory.contacts, barrier.id(), settings) &&
      !each.slides;
  const bool begins = addToContact(vehicle.memory.contacts,
                                   {.barrier = barrier.id(),
                                    .wall = wall,
                                    .impulseNormal = response.contact.impulse.normal,
                                    .impulseTangent = response.contact.impulse.tangent,
                                    .energyLost = energyLost,
                                    .contact = contact,
                                    .normal = normal},
                                   when, !hard && response.approachSpeed > noticedSpeed);
  if (!hard && !begins) return;

  ImpactEvent event = eventAt(vehicle, barrier, wall, contact, normal);
  event.time = when;
  event.phase = hard ? EventPhase::impact : EventPhase::contact_begin;
  event.arm = rotated(impact.arm, -response.before.yaw);
  event.law = response.law;
  event.angles = anglesOfAttack(impact, response.before);
  event.approachSpeed = response.approachSpeed;
  event.restitution = response.restitution;
  event.friction = response.friction;
  event.impulseNormal = response.contact.impulse.normal;
  event.impulseTangent = response.contact.impulse.tangent;
  event.impulseRatio = response.contact.impulseRatio;
  event.criticalImpulseRatio = response.contact.criticalRatio;
  event.deltaV = (response.after.velocity - response.before.velocity).norm();
  event.yawRateBefore = response.before.yawRate;
  event.yawRateAfter = response.after.yawRate;
  event.speedBefore = response.before.velocity.norm();
  event.speedAfter = response.after.velocity.norm();
  event.velocityAfter =
      state.toWorld(response.after.velocity) + state.up().dot(state.velocity) * state.up();
  event.energyAsked = response.energyAsked;
  event.energyRatio = response.energyRatio;
  event.energyLost = energyLost;
  event.outcome = response.outcome;
  event.regime = response.contact.regime;
  events.push_back(event);
}

// The guard contacts' loads in the world's last step. They are added to the contact with the wall;
// the rise of a load is reported as an impact.
void Responder::Implementation::reportLoads(Vehicle& vehicle) {
  const VehicleState& state = vehicle.reading.state;
  std::vector<SustainedContact>& contacts = vehicle.memory.contacts;
  fadeLoads(contacts, lastStep);
  for (const GuardLoad& load : vehicle.guards.loads()) {
    const Eigen::Vector3d impulse = lastStep * load.force;
    const double normalImpulse = impulse.dot(load.normal);
    if (load.barrier == BarrierId{} || normalImpulse <= 0.0) continue;
    const Barrier& barrier = *find(barriers, load.barrier.value);
    const ResponseSettings& settings = barrier.settings(barrier.settingsNumberOf(load.wall));
    const Eigen::Vector3d along = state.up().cross(load.normal);
    const Eigen::Vector3d velocity = 0.5 * (load.velocity + state.velocityAt(load.arm));
    const ContactShare share{.barrier = barrier.id(),
                             .wall = load.wall,
                             .impulseNormal = normalImpulse,
                             .impulseTangent = impulse.dot(along),
                             .energyLost = -impulse.dot(velocity),
                             .contact = load.contact,
                             .normal = load.normal};
    const double change = normalImpulse / state.mass;
    const bool hard = change > impactSpeed(contacts, barrier.id(), settings);
    const bool begins = addToContact(contacts, share, time, change > noticedSpeed);
    const bool rises = raiseLoad(contacts, barrier.id(), load.force.dot(load.normal));
    const bool isImpact = hard && rises;
    if (!isImpact && !begins) continue;
    ImpactEvent event = eventAt(vehicle, barrier, load.wall, load.contact, load.normal);
    event.time = time;
    event.arm = (state.axes.transpose() * load.arm).head<2>();
    event.approachSpeed = -load.velocity.dot(load.normal);
    event.impulseNormal = share.impulseNormal;
    event.impulseTangent = share.impulseTangent;
    event.impulseRatio = share.impulseTangent / share.impulseNormal;
    event.deltaV = impulse.norm() / state.mass;
    event.yawRateAfter = state.yawRate;
    event.yawRateBefore =
        state.yawRate - load.arm.cross(impulse).dot(state.up()) / state.yawInertia;
    event.velocityAfter = state.velocity;
    event.speedAfter = (state.axes.transpose() * state.velocity).head<2>().norm();
    event.speedBefore =
        (state.axes.transpose() * (state.velocity - impulse / state.mass)).head<2>().norm();
    event.energyLost = share.energyLost;
    event.regime = Regime::sticking;
    for (const auto& [is, phase] :
         {std::pair(isImpact, EventPhase::impact), std::pair(begins, EventPhase::contact_begin)}) {
      event.phase = phase;
      if (is) events.push_back(event);
    }
  }
  vehicle.guards.forget();
}

void Responder::Implementation::reportEndedContacts(Vehicle& vehicle) {
  Outline around = vehicle.envelope.outline();
  around.front += contactDistance;
  around.rear += contactDistance;
  around.halfWidth += contactDistance;
  const NearbyWalls& nearby = vehicle.nearby;
  const std::span<const Segment> walls = nearby.all().segments;
  std::erase_if(vehicle.memory.contacts, [&](const SustainedContact& contact) {
    if (time - contact.last < contactPause) return false;
    const bool near = std::any_of(walls.begin(), walls.end(), [&](const Segment& wall) {
      return nearby.ownerOf(wall).barrier == contact.barrier &&
             findTouch(around, {}, wall).has_value();
    });
    if (near) return false;
    const Barrier& barrier = *find(barriers, contact.barrier.value);
    ImpactEvent event = eventAt(vehicle, barrier, contact.wall, contact.contact, contact.normal);
    event.time = contact.last;
    event.phase = EventPhase::contact_end;
    event.impulseNormal = contact.impulseNormal;
    event.impulseTangent = contact.impulseTangent;
    event.energyLost = contact.energyLost;
    event.duration = contact.last - contact.begun;
    events.push_back(event);
    return true;
  });
}

}  // namespace bumper
