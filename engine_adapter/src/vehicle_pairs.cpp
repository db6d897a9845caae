// Vehicles that meet: which pairs may touch in a step, the islands that they make, and what the
// islands' steps mean for each vehicle.

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "bumper/response/pair.h"
#include "pair_plane.h"
#include "responder_implementation.h"
#include "sustained_contacts.h"

namespace bumper {

namespace {

// Penetration recovery and rounding of a step, m.
double marginOf(double h) { return 2.0 * CollisionStep::maxRecoverySpeed * h + 1e-3; }

// How often the fastest vehicle's speed one hit by it may leave with.
constexpr double thrownFaster = 2.0;

bool areJoined(const VehicleBodies& a, const VehicleBodies& b) {
  const auto isJoined = [&](dBodyID own) {
    return dBodyGetNumJoints(own) > 0 &&
           std::any_of(b.all().begin(), b.all().end(), [own](dBodyID other) {
             return dAreConnectedExcluding(own, other, dJointTypeContact) != 0;
           });
  };
  return std::any_of(a.all().begin(), a.all().end(), isJoined);
}

// Where vehicles are, and how they move: an order that does not depend on their registration.
bool comesBefore(const Vehicle* a, const Vehicle* b) {
  const auto key = [](const Vehicle* vehicle) {
    const VehicleState& state = vehicle->reading.state;
    const Eigen::Vector3d& place = state.massCentre;
    const Eigen::Vector3d& velocity = state.velocity;
    return std::array<double, 8>{place.x(),    place.y(),    place.z(),     velocity.x(),
                                 velocity.y(), velocity.z(), state.yawRate, state.mass};
  };
  return key(a) < key(b);
}

PlanarMotion inPlane(const PairFrame& frame, const PlanarMotion& motion) {
  const Placement place(frame.origin, frame.yaw);
  return {.position = frame.origin + place.turned(motion.position),
          .yaw = frame.yaw + motion.yaw,
          .velocity = place.turned(motion.velocity),
          .yawRate = motion.yawRate};
}

double spin(const Vehicle& vehicle) {
  return std::abs(vehicle.reading.motion.yawRate) * vehicle.envelope.outline().radius();
}

}  // namespace

const ResponseSettings* Responder::Implementation::settingsOfPair(const Vehicle& a,
                                                                  const Vehicle& b) const {
  const auto rule = pairOptions.find(std::minmax(a.memory.vehicle.value, b.memory.vehicle.value));
  if (rule == pairOptions.end()) {
    return options.vehiclesCollide ? &options.vehicleResponse : nullptr;
  }
  if (!rule->second.collide) return nullptr;
  return rule->second.response ? &*rule->second.response : &options.vehicleResponse;
}

bool Responder::Implementation::mayMeet(const Vehicle& a, const Vehicle& b) const {
  if (settingsOfPair(a, b) == nullptr || areJoined(a.bodies, b.bodies)) return false;
  const double level = a.bodies.readPose().up().dot(b.bodies.readPose().up());
  return level >= std::max(a.minUprightness, b.minUprightness);
}

// Adds the partners of those that may meet another vehicle in the step to those that are active.
void Responder::Implementation::findCompany(double h) {
  for (Vehicle* vehicle : activeNow()) {
    if (!vehicle->isAlone) travellers.push_back(&vehicle->traveller);
  }
  traffic.look(travellers, time, h);
  travellers.clear();
  const std::size_t before = activeCount;
  for (const auto& [one, other] : traffic.pairs()) {
    for (Vehicle* vehicle : {one->vehicle, other->vehicle}) {
      vehicle->hasCompany = true;
      if (vehicle->isActive) continue;
      vehicle->isActive = true;
      active[activeCount++] = vehicle;
    }
  }
  if (activeCount == before) return;
  std::sort(active.begin(), active.begin() + static_cast<std::ptrdiff_t>(activeCount),
            [](const Vehicle* a, const Vehicle* b) {
              return a->memory.vehicle.value < b->memory.vehicle.value;
            });
}

// Of the pairs of vehicles in each other's company those that may touch in the step.
void Responder::Implementation::findIslands(double h) {
  meetings.clear();
  for (const auto& [one, other] : traffic.pairs()) {
    Vehicle* first = one->vehicle;
    Vehicle* second = other->vehicle;
    if (!first->reading.takesPart || !second->reading.takesPart || !first->isUpright() ||
        !second->isUpright() || (first->mover != Mover::world && second->mover != Mover::world)) {
      continue;
    }
    if (comesBefore(second, first)) std::swap(first, second);
    const VehicleState& state = first->reading.state;
    const VehicleState& others = second->reading.state;
    const PairPlane plane(state, others);
    if (!bandsOverlap(plane, state, first->envelope, others, second->envelope)) continue;
    Meeting meeting{.first = first,
                    .second = second,
                    .firstFrame = plane.frameOf(state),
                    .secondFrame = plane.frameOf(others)};
    const PlanarMotion own = inPlane(meeting.firstFrame, first->reading.motion);
    const PlanarMotion its = inPlane(meeting.secondFrame, second->reading.motion);
    meeting.gap = separation(first->envelope.outline(), own.placement(), second->envelope.outline(),
                             its.placement())
                      .distance -
                  marginOf(h);
    const double speeds = own.velocity.norm() + its.velocity.norm();
    const bool hitsWalls =
        !first->nearby.all().segments.empty() || !second->nearby.all().segments.empty();
    const double closing = hitsWalls ? speeds : (own.velocity - its.velocity).norm();
    const double turning = spin(*first) + spin(*second);
    const bool isHeld = first->reading.isHeld || second->reading.isHeld;
    const double guarded =
        isHeld && options.guardContacts
            ? guardDistance(std::max(own.velocity.norm(), its.velocity.norm()), h)
            : 0.0;
    meeting.isIn = meeting.gap <= std::max(h * (closing + turning), guarded);
    meeting.reach = h * thrownFaster * (one->companySpeed + other->companySpeed + turning);
    if (meeting.isIn || meeting.gap <= meeting.reach) meetings.push_back(meeting);
  }
  std::erase_if(meetings, [this](const Meeting& meeting) {
    return !mayMeet(*meeting.first, *meeting.second) || isPassing(*meeting.first, *meeting.second);
  });

  // Those that a vehicle of an island may be thrown against belong to it.
  for (bool grew = true; grew;) {
    grew = false;
    for (Meeting& meeting : meetings) {
      if (meeting.isIn) {
        grew |= !meeting.first->isInIsland || !meeting.second->isInIsland;
        meeting.first->isInIsland = meeting.second->isInIsland = true;
      } else if (meeting.first->isInIsland || meeting.second->isInIsland) {
        meeting.isIn = true;
        grew = true;
      }
    }
  }
  std::erase_if(meetings, [](const Meeting& meeting) { return !meeting.isIn; });
  joinIslands();
}

// Numbers the islands: all vehicles that meetings join get the least of their numbers.
void Responder::Implementation::joinIslands() {
  inIslands.clear();
  for (const Meeting& meeting : meetings) {
    for (Vehicle* vehicle : {meeting.first, meeting.second}) {
      if (vehicle->island >= 0) continue;
      vehicle->island = static_cast<int>(inIslands.size());
      inIslands.push_back(vehicle);
    }
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const Meeting& meeting : meetings) {
      int& first = meeting.first->island;
      int& second = meeting.second->island;
      changed |= first != second;
      first = second = std::min(first, second);
    }
  }
  std::sort(inIslands.begin(), inIslands.end(), [](const Vehicle* a, const Vehicle* b) {
    return a->island != b->island ? a->island < b->island : comesBefore(a, b);
  });
}

void Responder::Implementation::solveIslands(double h) {
  for (auto first = inIslands.begin(); first != inIslands.end();) {
    const auto last = std::find_if(first, inIslands.end(), [&](const Vehicle* vehicle) {
      return vehicle->island != (*first)->island;
    });
    solveIsland({first, last}, h);
    first = last;
  }
  for (Vehicle* vehicle : inIslands) {
    vehicle->island = -1;
    vehicle->isInIsland = false;
  }
  inIslands.clear();
}

void Responder::Implementation::solveIsland(std::span<Vehicle* const> members, double h) {
  islandMembers.clear();
  islandPairs.clear();
  islandMeetings.clear();
  for (std::size_t i = 0; i < members.size(); ++i) {
    Vehicle& vehicle = *members[i];
    vehicle.islandPlace = static_cast<int>(i);
    vehicle.isHit = false;
    islandMembers.push_back({.vehicle = vehicle.parametersNow(),
                             .motion = vehicle.reading.motion,
                             .walls = vehicle.nearby.all()});
  }
  for (const Meeting& meeting : meetings) {
    if (meeting.first->island != members.front()->island) continue;
    islandMeetings.push_back(&meeting);
  }
  std::sort(islandMeetings.begin(), islandMeetings.end(), [](const Meeting* a, const Meeting* b) {
    return std::tie(a->first->islandPlace, a->second->islandPlace) <
           std::tie(b->first->islandPlace, b->second->islandPlace);
  });
  for (const Meeting* meeting : islandMeetings) {
    islandPairs.push_back({.first = meeting->first->islandPlace,
                           .second = meeting->second->islandPlace,
                           .firstFrame = meeting->firstFrame,
                           .secondFrame = meeting->secondFrame,
                           .settings = settingsOfPair(*meeting->first, *meeting->second)});
  }
  islands.resolve(islandMembers, islandPairs, h);
  for (const PairImpact& impact : islands.pairImpacts()) {
    applyPairImpact(*islandMeetings[static_cast<std::size_t>(impact.pair)], impact, h);
  }
  // What pushes one of them pushes all.
  const bool anyHeld = options.guardContacts &&
                       std::any_of(members.begin(), members.end(),
                                   [](const Vehicle* each) { return each->reading.isHeld; });
  islandOutcomes.clear();
  for (std::size_t i = 0; i < members.size(); ++i) islandOutcomes.push_back(islands.outcome(i));
  for (std::size_t i = 0; i < members.size(); ++i) {
    Vehicle& vehicle = *members[i];
    const StepOutcome& outcome = islandOutcomes[i];
    if (vehicle.mover != Mover::world) continue;
    if (!vehicle.reading.isAsleep || vehicle.isHit || !outcome.shift.velocity.isZero()) {
      applyOutcome(vehicle, outcome, h);
    }
    if (!anyHeld) continue;
    vehicle.reading.isHeld = true;
    if (vehicle.nearby.all().segments.empty()) continue;
    addGuards(vehicle,
              islands.speculativeContacts(i, vehicle.reading.motion, outcome.after,
                                          guardedDistance(vehicle, h), h),
              h);
  }
  if (!anyHeld) return;
  for (const Meeting* meeting : islandMeetings) {
    addPairGuards(*meeting, islands.outcome(static_cast<std::size_t>(meeting->first->islandPlace)),
                  islands.outcome(static_cast<std::size_t>(meeting->second->islandPlace)), h);
  }
}

// So that what pushes one of them does not push it through the other.
void Responder::Implementation::addPairGuards(const Meeting& meeting, const StepOutcome& first,
                                              const StepOutcome& second, double h) {
  const auto inStep = [](const Vehicle& vehicle, const PairFrame& frame,
                         const StepOutcome& outcome) {
    return OutlineInStep{.outline = vehicle.envelope.outline(),
                         .start = inPlane(frame, vehicle.reading.motion),
                         .end = inPlane(frame, outcome.after)};
  };
  const OutlineInStep own = inStep(*meeting.first, meeting.firstFrame, first);
  const OutlineInStep its = inStep(*meeting.second, meeting.secondFrame, second);
  const ResponseSettings& settings = *settingsOfPair(*meeting.first, *meeting.second);
  const double speed = std::max(own.start.velocity.norm(), its.start.velocity.norm());
  const double depth = enteredDepth((own.start.velocity - its.start.velocity).norm() +
                                        spin(*meeting.first) + spin(*meeting.second),
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

// Adds the impulse of an impact of two vehicles to their force pulses, and to the events.
void Responder::Implementation::applyPairImpact(const Meeting& meeting, const PairImpact& each,
                                                double h) {
  const ResponseSettings& settings = *settingsOfPair(*meeting.first, *meeting.second);
  const bool presses = each.response.approachSpeed < impactInContact * settings.restSpeed;
  const bool isLong = settings.contactTime > 0.0 && !presses;
  const auto act = [&](Vehicle& vehicle, const PairFrame& frame, const Vector2& arm, double sign) {
    if (vehicle.mover != Mover::world) return;
    const Vector2 linear = sign * each.response.impulse.linear;
    const PlanarImpulse own{.linear = Placement({}, frame.yaw).turnedBack(linear),
                            .angular = cross(arm, linear)};
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

std::pair<Vehicle*, Vehicle*> Responder::Implementation::inOrderOfIds(Vehicle& a, Vehicle& b) {
  return a.memory.vehicle.value < b.memory.vehicle.value ? std::pair(&a, &b) : std::pair(&b, &a);
}

// What the one that was registered first remembers of the other; null: nothing.
VehicleHit* Responder::Implementation::hitBetween(Vehicle& a, Vehicle& b) const {
  const auto [early, late] = inOrderOfIds(a, b);
  const VehicleId id = late->memory.vehicle;
  std::vector<VehicleHit>& hits = early->memory.hits;
  std::erase_if(hits, [this](const VehicleHit& hit) {
    return time >= hit.passableUntil && time > hit.last + contactPause;
  });
  const auto hit = std::find_if(hits.begin(), hits.end(),
                                [id](const VehicleHit& each) { return each.vehicle == id; });
  return hit != hits.end() ? &*hit : nullptr;
}

// Whether a long force pulse between them runs.
bool Responder::Implementation::isPassing(Vehicle& a, Vehicle& b) const {
  const VehicleHit* const hit = hitBetween(a, b);
  return hit != nullptr && time < hit->passableUntil;
}

bool Responder::Implementation::isNear(const Vehicle& a, const Vehicle& b) {
  const VehiclePose pose = a.bodies.readPose();
  const VehiclePose others = b.bodies.readPose();
  const PairPlane plane(pose, others);
  const auto placeOf = [&](const VehiclePose& each) {
    const PairFrame frame = plane.frameOf(each);
    return Placement(frame.origin, frame.yaw);
  };
  return separation(a.envelope.outline(), placeOf(pose), b.envelope.outline(), placeOf(others))
             .distance <= contactDistance;
}

}  // namespace bumper
