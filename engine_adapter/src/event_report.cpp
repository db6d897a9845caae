// Events: impacts, and contacts that begin and end.

#include <algorithm>
#include <utility>

#include "bumper/response/pair.h"
#include "pair_plane.h"
#include "responder_implementation.h"
#include "sustained_contacts.h"

namespace bumper {

namespace {

// A contact that begins more slowly than this, m/s, is rounding.
constexpr double noticedSpeed = 1e-6;

// What an event has from the law.
void describe(const Impact& impact, const ImpactResponse& response, ImpactEvent& event) {
  event.arm = rotated(impact.arm, -response.before.yaw);
  event.law = response.law;
  PlanarMotion relative = response.before;
  relative.velocity -= velocityAt(response.otherBefore, impact.otherArm);
  event.angles = anglesOfAttack(impact, relative);
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
  event.energyAsked = response.energyAsked;
  event.energyRatio = response.energyRatio;
  event.energyLost = -response.contact.energyChange;
  event.outcome = response.outcome;
  event.regime = response.contact.regime;
}

// Of the other vehicle of a guard contact, which took the opposite impulse.
void describeOther(const Vehicle& other, const Eigen::Vector3d& contact,
                   const Eigen::Vector3d& impulse, ImpactEvent& event) {
  const VehicleState state = other.bodies.read();
  const Eigen::Vector3d arm = contact - state.massCentre;
  event.otherArm = (state.axes.transpose() * arm).head<2>();
  event.otherVelocityBefore = event.otherVelocityAfter = state.velocity;
  event.otherYawRateBefore = event.otherYawRateAfter = state.yawRate;
  if (other.mover != Mover::world) return;
  event.otherVelocityBefore += impulse / state.mass;
  event.otherYawRateBefore += arm.cross(impulse).dot(state.up()) / state.yawInertia;
}

}  // namespace

const Vehicle& Responder::Implementation::vehicleAt(const ContactPartner& with) const {
  return *find(vehicles, with.vehicle.value);
}

const ResponseSettings& Responder::Implementation::settingsOf(const ContactPartner& with,
                                                              int wall) const {
  const Barrier& barrier = *find(barriers, with.barrier.value);
  return barrier.settings(barrier.settingsNumberOf(wall));
}

// `wall` is any of those that make one face with the one that was hit, if a barrier was.
ImpactEvent Responder::Implementation::eventWith(const Vehicle& vehicle, const ContactPartner& with,
                                                 int wall, const Eigen::Vector3d& contact,
                                                 const Eigen::Vector3d& normal) const {
  ImpactEvent event;
  event.vehicle = vehicle.name;
  if (with.vehicle != VehicleId{}) {
    event.otherVehicle = vehicleAt(with).name;
  } else {
    const Barrier& barrier = *find(barriers, with.barrier.value);
    event.barrier = barrier.name();
    event.triangle = barrier.triangleOf(barrier.wallAt(wall, barrier.frame().toFrame(contact)));
    event.material = barrier.materialOf(wall);
  }
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

  const ContactPartner with{.barrier = barrier.id()};
  const bool hard =
      response.approachSpeed > impactSpeed(vehicle.memory.contacts, with, settingsOf(with, wall)) &&
      !each.slides;
  const bool begins = addToContact(vehicle.memory.contacts,
                                   {.with = with,
                                    .wall = wall,
                                    .impulseNormal = response.contact.impulse.normal,
                                    .impulseTangent = response.contact.impulse.tangent,
                                    .energyLost = energyLost,
                                    .contact = contact,
                                    .normal = normal},
                                   when, !hard && response.approachSpeed > noticedSpeed);
  if (!hard && !begins) return;

  ImpactEvent event = eventWith(vehicle, with, wall, contact, normal);
  event.time = when;
  event.phase = hard ? EventPhase::impact : EventPhase::contact_begin;
  describe(impact, response, event);
  const Eigen::Vector3d rising = state.up().dot(state.velocity) * state.up();
  event.velocityBefore = state.toWorld(response.before.velocity) + rising;
  event.velocityAfter = state.toWorld(response.after.velocity) + rising;
  events.push_back(event);
}

// Of two vehicles, as seen by the one that was registered first.
void Responder::Implementation::reportPairImpact(const Meeting& meeting, const PairImpact& each) {
  const VehicleState& state = meeting.first->reading.state;
  const PairPlane plane(state, meeting.second->reading.state);
  PairHit hit{.time = each.time, .impact = each.impact, .response = each.response};
  const auto [vehicle, other] = inOrderOfIds(*meeting.first, *meeting.second);
  if (vehicle != meeting.first) hit = asSeenByOther(hit);
  const Impact& impact = hit.impact;
  const ImpactResponse& response = hit.response;
  const ContactPartner with{.vehicle = other->memory.vehicle};
  const ResponseSettings& settings = *settingsOfPair(*vehicle, *other);
  const double when = time + hit.time;
  std::vector<SustainedContact>& contacts = vehicle->memory.contacts;
  // A corner that turns along the other's side hits it again and again, ever more softly.
  const bool goesOn = hitBetween(*vehicle, *other) != nullptr;
  const double least =
      goesOn ? impactInContact * settings.restSpeed : impactSpeed(contacts, with, settings);
  const bool hard = response.approachSpeed > least;
  // Between the heights of both, whichever is the first in the plane.
  const double higher =
      plane.normal().dot(meeting.second->reading.state.massCentre - state.massCentre);
  const Eigen::Vector3d contact = plane.placeOf(impact.point) + 0.5 * higher * plane.normal();
  const Eigen::Vector3d normal = plane.toWorld(impact.normal);
  const bool begins = addToContact(contacts,
                                   {.with = with,
                                    .impulseNormal = response.contact.impulse.normal,
                                    .impulseTangent = response.contact.impulse.tangent,
                                    .energyLost = -response.contact.energyChange,
                                    .contact = contact,
                                    .normal = normal},
                                   when, !hard && response.approachSpeed > noticedSpeed);
  if (!hard && !begins) return;

  ImpactEvent event = eventWith(*vehicle, with, 0, contact, normal);
  event.time = when;
  event.phase = hard ? EventPhase::impact : EventPhase::contact_begin;
  describe(impact, response, event);
  const auto velocityOf = [&](const Vehicle& which, const PlanarMotion& motion) {
    const Eigen::Vector3d up = plane.normal();
    return Eigen::Vector3d(plane.toWorld(motion.velocity) +
                           up.dot(which.reading.state.velocity) * up);
  };
  event.velocityBefore = velocityOf(*vehicle, response.before);
  event.velocityAfter = velocityOf(*vehicle, response.after);
  event.otherArm = rotated(impact.otherArm, -response.otherBefore.yaw);
  event.otherVelocityBefore = velocityOf(*other, response.otherBefore);
  event.otherVelocityAfter = velocityOf(*other, response.otherAfter);
  event.otherYawRateBefore = response.otherBefore.yawRate;
  event.otherYawRateAfter = response.otherAfter.yawRate;
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
    if (load.with == ContactPartner{} || normalImpulse <= 0.0) continue;
    const bool isVehicle = load.with.vehicle != VehicleId{};
    const ResponseSettings* settings = isVehicle ? settingsOfPair(vehicle, vehicleAt(load.with))
                                                 : &settingsOf(load.with, load.wall);
    if (settings == nullptr) continue;
    const Eigen::Vector3d along = state.up().cross(load.normal);
    Eigen::Vector3d after = state.velocityAt(load.arm);
    if (isVehicle) {
      const VehicleState other = vehicleAt(load.with).bodies.read();
      after -= other.velocityAt(load.contact - other.massCentre);
    }
    const Eigen::Vector3d velocity = 0.5 * (load.velocity + after);
    const ContactShare share{.with = load.with,
                             .wall = load.wall,
                             .impulseNormal = normalImpulse,
                             .impulseTangent = impulse.dot(along),
                             .energyLost = -impulse.dot(velocity),
                             .contact = load.contact,
                             .normal = load.normal};
    const double change = normalImpulse / state.mass;
    const bool hard = change > impactSpeed(contacts, load.with, *settings);
    const bool begins = addToContact(contacts, share, time, change > noticedSpeed);
    const bool rises = raiseLoad(contacts, load.with, load.force.dot(load.normal));
    const bool isImpact = hard && rises;
    if (!isImpact && !begins) continue;
    ImpactEvent event = eventWith(vehicle, load.with, load.wall, load.contact, load.normal);
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
    event.velocityBefore = state.velocity - impulse / state.mass;
    event.velocityAfter = state.velocity;
    event.speedAfter = (state.axes.transpose() * state.velocity).head<2>().norm();
    event.speedBefore = (state.axes.transpose() * event.velocityBefore).head<2>().norm();
    if (isVehicle) describeOther(vehicleAt(load.with), load.contact, impulse, event);
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

bool Responder::Implementation::isNear(const Vehicle& vehicle, const ContactPartner& with) const {
  if (with.vehicle != VehicleId{}) {
    return isNear(vehicle, vehicleAt(with));
  }
  const Outline around = vehicle.envelope.outline().grown(contactDistance);
  const NearbyWalls& nearby = vehicle.nearby;
  const std::span<const Segment> walls = nearby.all().segments;
  return std::any_of(walls.begin(), walls.end(), [&](const Segment& wall) {
    return nearby.ownerOf(wall).barrier == with.barrier && findTouch(around, {}, wall).has_value();
  });
}

void Responder::Implementation::reportEndedContacts(Vehicle& vehicle) {
  std::erase_if(vehicle.memory.contacts, [&](const SustainedContact& contact) {
    const ContactPartner& with = contact.with;
    if (time - contact.last < contactPause || isNear(vehicle, with)) return false;
    ImpactEvent event = eventWith(vehicle, with, contact.wall, contact.contact, contact.normal);
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
