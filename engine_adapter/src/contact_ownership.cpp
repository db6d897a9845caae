// Who owns a contact, Bumper or ODE. The rule is in the README.

#include <ode/ode.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "bumper/engine_adapter/responder.h"
#include "ode_vectors.h"
#include "pair_plane.h"
#include "responder_implementation.h"

namespace bumper {

namespace {

/// A vehicle's geom against a barrier's, in either order.
struct OwnedPair {
  const Vehicle* vehicle = nullptr;
  dBodyID body = nullptr;  // of the vehicle's geom
  const Barrier* barrier = nullptr;
  bool barrierFirst = false;
  explicit operator bool() const { return vehicle != nullptr; }
};

/// The vehicle that a geom is a part of; null if there is none, or it leans too far to own
/// contacts.
const Vehicle* uprightVehicle(const Responder::Implementation& responder, dGeomID geom) {
  if (geom == nullptr || dGeomIsSpace(geom) != 0) return nullptr;
  const dBodyID body = dGeomGetBody(geom);
  if (body == nullptr) return nullptr;
  const auto vehicle = responder.vehicleOfBody.find(body);
  const bool isOne = vehicle != responder.vehicleOfBody.end() && vehicle->second->isUpright();
  return isOne ? vehicle->second : nullptr;
}

OwnedPair ordered(const Responder::Implementation& responder, dGeomID vehicleGeom,
                  dGeomID barrierGeom) {
  const auto barrier = responder.barrierOfGeom.find(barrierGeom);
  if (barrier == responder.barrierOfGeom.end() || !barrier->second->isStill(barrierGeom)) return {};
  const Vehicle* const vehicle = uprightVehicle(responder, vehicleGeom);
  if (vehicle == nullptr) return {};
  return {.vehicle = vehicle, .body = dGeomGetBody(vehicleGeom), .barrier = barrier->second};
}

/// Two vehicles that meet at the heights of their bands: their contacts are Bumper's, but for those
/// of one that lies on the other.
struct OwnedVehicles {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< of the plane in which they meet
  bool areLevel = false;                          ///< neither can lie on the other

  [[nodiscard]] bool own(const Eigen::Vector3d& contactNormal) const {
    // A contact nearer the vertical, as a cosine, is one of a vehicle that lies on another.
    constexpr double steepest = 0.7071;
    return std::abs(up.dot(contactNormal)) < steepest;
  }
};

std::optional<OwnedVehicles> vehiclesOf(const Responder::Implementation& responder, dGeomID a,
                                        dGeomID b) {
  if (!responder.hasPairs()) return std::nullopt;
  const Vehicle* const one = uprightVehicle(responder, a);
  const Vehicle* const other = one != nullptr ? uprightVehicle(responder, b) : nullptr;
  if (other == nullptr || one == other) return std::nullopt;
  const VehiclePose pose = one->bodies.readPose();
  const VehiclePose others = other->bodies.readPose();
  const PairPlane plane(pose, others);
  if (!bandsOverlap(plane, pose, one->envelope, others, other->envelope) ||
      !responder.mayMeet(*one, *other)) {
    return std::nullopt;
  }
  // By so much of a band's height one may stand higher than the other and cannot lie on it.
  constexpr double levelShare = 0.5;
  const double higher = std::abs(plane.normal().dot(others.massCentre - pose.massCentre));
  const double band = std::min(one->envelope.bandHeight(), other->envelope.bandHeight());
  return OwnedVehicles{.up = plane.normal(), .areLevel = higher < levelShare * band};
}

/// The pair, if Bumper may own contacts of it.
OwnedPair pairOf(const Responder::Implementation& responder, dGeomID a, dGeomID b) {
  if (const OwnedPair pair = ordered(responder, a, b)) return pair;
  OwnedPair pair = ordered(responder, b, a);
  pair.barrierFirst = true;
  return pair;
}

// ODE calls geom transforms deprecated; applications have them all the same.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

/// Whether a geom is a transform around another, or around a transform around it.
bool holds(dGeomID transform, dGeomID geom) {
  while (transform != nullptr && dGeomGetClass(transform) == dGeomTransformClass) {
    transform = dGeomTransformGetGeom(transform);
    if (transform == geom) return true;
  }
  return false;
}

#pragma GCC diagnostic pop

/// A contact of a geom transform is, by ODE's default, one of the geom that it holds, which has
/// neither a body nor a space: the vehicle's or barrier's transform, or null.
dGeomID transformAround(const Responder::Implementation& responder, dGeomID geom) {
  for (const auto& [body, vehicle] : responder.vehicleOfBody) {
    for (dGeomID own = dBodyGetFirstGeom(body); own != nullptr; own = dBodyGetNextGeom(own)) {
      if (holds(own, geom)) return own;
    }
  }
  for (const auto& [own, barrier] : responder.barrierOfGeom) {
    if (barrier->isStill(own) && holds(own, geom)) return own;
  }
  return nullptr;
}

/// Finds the vehicle and barrier of each contact of one dCollide(), by the contact's own geoms:
/// those that were collided may be spaces. The same geoms follow one another, and are looked up
/// once.
class ContactPairs {
 public:
  ContactPairs(const Responder::Implementation& responder, dGeomID a, dGeomID b)
      : responder_(responder), a_(a), b_(b) {}

  const OwnedPair& pairOf(const dContactGeom& contact) {
    if (isKnown_ && contact.g1 == first_ && contact.g2 == second_) return pair_;
    first_ = contact.g1;
    second_ = contact.g2;
    isKnown_ = true;
    const bool swapped = first_ == b_ || second_ == a_;
    dGeomID const first = carrierOf(first_, swapped ? b_ : a_);
    dGeomID const second = carrierOf(second_, swapped ? a_ : b_);
    pair_ = bumper::pairOf(responder_, first, second);
    vehicles_ = vehiclesOf(responder_, first, second);
    if (pair_) pose_ = pair_.barrier->frame().toFrame(pair_.vehicle->bodies.readPose());
    return pair_;
  }
  /// Of the last contact.
  [[nodiscard]] const std::optional<OwnedVehicles>& vehicles() const { return vehicles_; }
  /// Of the last pair's vehicle, as its barrier sees it.
  [[nodiscard]] const VehiclePose& pose() const { return pose_; }

 private:
  /// The geom that a contact's geom belongs to: `collided` if that is not to be seen.
  [[nodiscard]] dGeomID carrierOf(dGeomID geom, dGeomID collided) const {
    if (geom == nullptr) return collided;
    if (geom == collided || dGeomGetBody(geom) != nullptr || dGeomGetSpace(geom) != nullptr ||
        responder_.barrierOfGeom.contains(geom)) {
      return geom;
    }
    const dGeomID transform = transformAround(responder_, geom);
    return transform != nullptr ? transform : collided;
  }

  const Responder::Implementation& responder_;
  dGeomID a_;
  dGeomID b_;
  bool isKnown_ = false;
  dGeomID first_ = nullptr;
  dGeomID second_ = nullptr;
  OwnedPair pair_;
  std::optional<OwnedVehicles> vehicles_;
  VehiclePose pose_;
};

struct Contact {
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
  int triangle;  // of the barrier's geom; −1 if it has none
};

/// Whether the contact is one with a wall that reaches into the vehicle's band.
bool isWithWall(const OwnedPair& pair, const VehiclePose& pose, const Contact& contact) {
  const Envelope& envelope = pair.vehicle->envelope;
  const WallPart part = pair.barrier->partAt(contact.triangle, contact.normal);
  if (part.kind == WallPart::Kind::none) return false;
  if (!envelope.inBand(pose, contact.place, part.foot, part.top)) return false;
  // A cap is the wall's for a vehicle that stands before the wall, and ground for the wheels of
  // one that drives up to its height.
  return part.kind == WallPart::Kind::face || envelope.isAboveBottom(pose, contact.place);
}

/// Whether it is one of the chassis with the foot of such a wall: Bumper resolves the wall, and the
/// foot would cause a second response.
bool isWithFoot(const OwnedPair& pair, const VehiclePose& pose, const Contact& contact) {
  if (pair.body != pair.vehicle->bodies.chassis()) return false;
  const std::optional<WallFoot> foot = pair.barrier->footAt(contact.triangle);
  const Envelope& envelope = pair.vehicle->envelope;
  return foot && envelope.isBelowTop(pose, contact.place) &&
         envelope.inBand(pose, contact.place, foot->foot, foot->top);
}

bool isOurs(const OwnedPair& pair, const VehiclePose& pose, const WorldFrame& frame,
            const dContactGeom& geom) {
  const BarrierFrame& walls = pair.barrier->frame();
  const Contact contact{.place = walls.toFrame(frame.vector(toVector(geom.pos))),
                        .normal = walls.directionToFrame(frame.direction(toVector(geom.normal))),
                        .triangle = pair.barrierFirst ? geom.side1 : geom.side2};
  // ODE gives no triangle index where two trimeshes meet along their edges.
  if (contact.triangle < 0 && dGeomGetClass(pair.barrier->geom()) == dTriMeshClass) {
    return pair.vehicle->envelope.isAboveBottom(pose, contact.place);
  }
  return isWithWall(pair, pose, contact) || isWithFoot(pair, pose, contact);
}

}  // namespace

bool Responder::claims(dGeomID a, dGeomID b) const {
  if (const auto vehicles = vehiclesOf(*implementation_, a, b)) return vehicles->areLevel;
  const OwnedPair pair = pairOf(*implementation_, a, b);
  // A mesh that holds ground too is decided contact by contact.
  if (!pair || !pair.barrier->hasWallsOnly()) return false;
  const VehiclePose pose = pair.barrier->frame().toFrame(pair.vehicle->bodies.readPose());
  return pair.vehicle->envelope.allInBand(pose, pair.barrier->highestFoot(),
                                          pair.barrier->lowestTop());
}

int Responder::keepUnclaimed(dGeomID a, dGeomID b, dContact* contacts, int count) const {
  ContactPairs pairs(*implementation_, a, b);
  const WorldFrame& frame = implementation_->worldFrame;
  const auto isBumpers = [&](const dContact& contact) {
    const OwnedPair& pair = pairs.pairOf(contact.geom);
    if (pairs.vehicles()) {
      return pairs.vehicles()->own(frame.direction(toVector(contact.geom.normal)));
    }
    return pair && isOurs(pair, pairs.pose(), frame, contact.geom);
  };
  return static_cast<int>(std::remove_if(contacts, contacts + count, isBumpers) - contacts);
}

}  // namespace bumper
