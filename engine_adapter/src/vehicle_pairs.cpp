// Two vehicles: whether and how they respond to each other, and what they remember of it.

#include <ode/ode.h>

#include <algorithm>

#include "bumper/response/pair.h"
#include "pair_plane.h"
#include "responder_implementation.h"
#include "sustained_contacts.h"

namespace bumper {

namespace {

bool areJoined(const VehicleBodies& a, const VehicleBodies& b) {
  const auto isJoined = [&](dBodyID own) {
    return dBodyGetNumJoints(own) > 0 &&
           std::any_of(b.all().begin(), b.all().end(), [own](dBodyID other) {
             return dAreConnectedExcluding(own, other, dJointTypeContact) != 0;
           });
  };
  return std::any_of(a.all().begin(), a.all().end(), isJoined);
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
