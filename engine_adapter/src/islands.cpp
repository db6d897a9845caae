// Vehicles that may hit each other in a step: those in each other's company, the islands of those
// that may touch, and the islands' steps.

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "bumper/response/pair.h"
#include "pair_plane.h"
#include "responder_implementation.h"

namespace bumper {

namespace {

// Penetration recovery and rounding of a step, m.
double marginOf(double h) { return 2.0 * CollisionStep::maxRecoverySpeed * h + 1e-3; }

// How often the fastest vehicle's speed one hit by it may leave with.
constexpr double thrownFaster = 2.0;

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

}  // namespace

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
      vehicle->issues = step_issue::none;
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
    const PlanarMotion own = meeting.firstFrame.inPlane(first->reading.motion);
    const PlanarMotion its = meeting.secondFrame.inPlane(second->reading.motion);
    const double gap = separation(first->envelope.outline(), own.placement(),
                                  second->envelope.outline(), its.placement())
                           .distance -
                       marginOf(h);
    const double speeds = own.velocity.norm() + its.velocity.norm();
    const bool hitsWalls =
        !first->nearby.all().segments.empty() || !second->nearby.all().segments.empty();
    const double closing = hitsWalls ? speeds : (own.velocity - its.velocity).norm();
    const double turning = first->turningSpeed() + second->turningSpeed();
    const bool isHeld = first->reading.isHeld || second->reading.isHeld;
    const double guarded =
        isHeld && options.guardContacts
            ? guardDistance(std::max(own.velocity.norm(), its.velocity.norm()), h)
            : 0.0;
    meeting.isIn = gap <= std::max(h * (closing + turning), guarded);
    const double thrown = h * thrownFaster * (one->companySpeed + other->companySpeed + turning);
    if (meeting.isIn || gap <= thrown) meetings.push_back(meeting);
  }
  std::erase_if(meetings, [this](const Meeting& meeting) {
    return !mayMeet(*meeting.first, *meeting.second) || isPassing(*meeting.first, *meeting.second);
  });

  // Those that a vehicle of an island may be thrown against belong to it.
  for (const Meeting& meeting : meetings) {
    if (meeting.isIn) joinIsland(meeting);
  }
  for (bool grew = true; grew;) {
    grew = false;
    for (Meeting& meeting : meetings) {
      if (meeting.isIn || (meeting.first->island < 0 && meeting.second->island < 0)) continue;
      meeting.isIn = grew = true;
      joinIsland(meeting);
    }
  }
  std::erase_if(meetings, [](const Meeting& meeting) { return !meeting.isIn; });
  mergeIslands();
}

// Each vehicle begins with an island of its own.
void Responder::Implementation::joinIsland(const Meeting& meeting) {
  for (Vehicle* vehicle : {meeting.first, meeting.second}) {
    if (vehicle->island >= 0) continue;
    vehicle->island = static_cast<int>(inIslands.size());
    inIslands.push_back(vehicle);
  }
}

// All vehicles that meetings join get the least of their numbers.
void Responder::Implementation::mergeIslands() {
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
  for (Vehicle* vehicle : inIslands) vehicle->island = -1;
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
    addPairGuards(*meeting, islandOutcomes[static_cast<std::size_t>(meeting->first->islandPlace)],
                  islandOutcomes[static_cast<std::size_t>(meeting->second->islandPlace)], h);
  }
}

}  // namespace bumper
