// What an island's step means for two of its vehicles: force pulses, and guard contacts.

#include <algorithm>

#include "pair_plane.h"
#include "responder_implementation.h"
#include "sustained_contacts.h"

namespace bumper {

// Adds the impulse of an impact of two vehicles to their force pulses, and to the events.
void Responder::Implementation::applyPairImpact(const Meeting& meeting, const PairImpact& each,
                                                double h) {
  const ResponseSettings& settings = *settingsOfPair(*meeting.first, *meeting.second);
  const bool presses = each.response.approachSpeed < impactInContact * settings.restSpeed;
  const bool isLong = settings.contactTime > 0.0 && !presses;
  const auto act = [&](Vehicle& vehicle, const PairFrame& frame, const Vector2& arm, double sign) {
    if (vehicle.mover != Mover::world) return;
    const PlanarImpulse own = frame.onMember(sign * each.response.impulse.linear, arm);
    ForcePulse& pulse = vehicle.memory.pulse;
    if (isLong) {
      pulse.addLong(own, each.time, settings.contactTime);
    } else {
      pulse.add(own, each.time, h);
    }
    vehicle.isHit = true;
    vehicle.freeSpace.leave();
  };
  act(*meeting.first, meeting.firstFrame, each.impact.arm, 1.0);
  act(*meeting.second, meeting.secondFrame, each.impact.otherArm, -1.0);
  reportPairImpact(meeting, each);
  if (!presses) {
    VehicleHit* hit = hitBetween(*meeting.first, *meeting.second);
    if (hit == nullptr) {
      const auto [early, late] = inOrderOfIds(*meeting.first, *meeting.second);
      hit = &early->memory.hits.emplace_back(VehicleHit{.vehicle = late->memory.vehicle});
    }
    hit->last = time + each.time;
    if (isLong) hit->passableUntil = time + each.time + settings.contactTime;
  }
}

// So that what pushes one of them does not push it through the other.
void Responder::Implementation::addPairGuards(const Meeting& meeting, const StepOutcome& first,
                                              const StepOutcome& second, double h) {
  const auto inStep = [](const Vehicle& vehicle, const PairFrame& frame,
                         const StepOutcome& outcome) {
    return OutlineInStep{.outline = vehicle.envelope.outline(),
                         .start = frame.inPlane(vehicle.reading.motion),
                         .end = frame.inPlane(outcome.after)};
  };
  const OutlineInStep own = inStep(*meeting.first, meeting.firstFrame, first);
  const OutlineInStep its = inStep(*meeting.second, meeting.secondFrame, second);
  const ResponseSettings& settings = *settingsOfPair(*meeting.first, *meeting.second);
  const double speed = std::max(own.start.velocity.norm(), its.start.velocity.norm());
  const double depth =
      enteredDepth((own.start.velocity - its.start.velocity).norm() +
                       meeting.first->turningSpeed() + meeting.second->turningSpeed(),
                   settings.contactTime);
  const VehicleState& state = meeting.first->reading.state;
  const VehicleState& others = meeting.second->reading.state;
  const PairPlane plane(state, others);
  const Eigen::Vector3d up = plane.normal();
  const double higher = 0.5 * up.dot(others.massCentre - state.massCentre);
  const bool swapped = meeting.second->memory.vehicle.value < meeting.first->memory.vehicle.value;
  const double sign = swapped ? -1.0 : 1.0;
  Vehicle& vehicle = swapped ? *meeting.second : *meeting.first;
  Vehicle& other = swapped ? *meeting.first : *meeting.second;
  const SpeculativePairContacts near =
      speculativePairContacts(own, its, guardDistance(speed, h), depth, h);
  for (const SpeculativePairContact& contact : near.all()) {
    const bool slides =
        contact.gap <= slidingGap && settings.frictionKind == Friction::Kind::coulomb;
    const Vector2& arm = swapped ? contact.otherArm : contact.arm;
    vehicle.guards.add(
        GuardContacts::PairGuard{
            .other = other.memory.vehicle,
            .chassis = other.bodies.chassis(),
            .place = vehicle.reading.state.massCentre + plane.toWorld(arm) + sign * higher * up,
            .arm = plane.toWorld(arm),
            .normal = plane.toWorld(sign * contact.normal),
            .velocity = plane.toWorld(sign * contact.velocity),
            .room = contact.room,
            .friction =
                slides ? settings.friction(attackOn(contact.velocity, contact.normal)) : 0.0},
        guardJoints.get(), vehicle.bodies.chassis(), {.time = time, .size = h});
    hasGuards = true;
  }
}

}  // namespace bumper
