#include "bumper/engine_adapter/responder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "bumper/response/error.h"
#include "ode_vectors.h"
#include "responder_implementation.h"

namespace bumper {

namespace {

// How far the bodies' own mass and yaw inertia may lie from the parameters.
constexpr double massTolerance = 0.01;
constexpr double inertiaTolerance = 0.05;

template <typename Thing>
Thing& registered(const std::vector<std::unique_ptr<Thing>>& things, int id, const char* kind) {
  if (id < 0 || static_cast<std::size_t>(id) >= things.size() ||
      things[static_cast<std::size_t>(id)] == nullptr) {
    throw Error("this responder has no " + std::string(kind) + " with id " + std::to_string(id));
  }
  return *things[static_cast<std::size_t>(id)];
}

void requireClose(double actual, double given, double tolerance, const char* what,
                  const char* unit) {
  if (std::abs(actual - given) <= tolerance * given) return;
  std::ostringstream message;
  message << "addVehicle: the bodies' " << what << " is " << actual << ' ' << unit
          << ", but the parameters say " << given << ' ' << unit << ": they may differ by "
          << 100.0 * tolerance
          << " %. Is every body that moves with the chassis among the linked bodies?";
  throw Error(message.str());
}

void warnOfLosses(dBodyID body, const std::string& vehicle, std::vector<std::string>& warnings) {
  const auto warn = [&](const char* what) {
    warnings.push_back("vehicle '" + vehicle + "': a body has " + what +
                       ", which takes a part of every impulse");
  };
  if (dBodyGetLinearDamping(body) > 0.0) warn("linear damping");
  if (dBodyGetAngularDamping(body) > 0.0) warn("angular damping");
  if (std::isfinite(dBodyGetMaxAngularSpeed(body)) && dBodyGetMaxAngularSpeed(body) < 1e6) {
    warn("a maximum angular speed");
  }
}

// A wheel on a joint that is not linked hangs on the chassis as dead weight that no law knows of.
void warnOfStrangers(dBodyID body, std::span<const dBodyID> vehicle, const std::string& name,
                     std::vector<std::string>& warnings) {
  for (int i = 0; i < dBodyGetNumJoints(body); ++i) {
    const dJointID joint = dBodyGetJoint(body, i);
    if (dJointGetType(joint) == dJointTypeContact) continue;
    for (const int side : {0, 1}) {
      const dBodyID other = dJointGetBody(joint, side);
      if (other == nullptr || std::find(vehicle.begin(), vehicle.end(), other) != vehicle.end()) {
        continue;
      }
      warnings.push_back("vehicle '" + name +
                         "': a joint leads to a body that is not among the linked bodies; if it "
                         "moves with the chassis as one, impulses will be wrong by its mass");
    }
  }
}

OwnedPair ordered(const Responder::Implementation& responder, dGeomID vehicleGeom,
                  dGeomID barrierGeom) {
  if (dGeomIsSpace(vehicleGeom) != 0) return {};
  const dBodyID body = dGeomGetBody(vehicleGeom);
  if (body == nullptr) return {};
  const auto barrier = responder.barrierOfGeom.find(barrierGeom);
  if (barrier == responder.barrierOfGeom.end()) return {};
  const auto vehicle = responder.vehicleOfBody.find(body);
  if (vehicle == responder.vehicleOfBody.end() || !vehicle->second->isUpright()) return {};
  return {.vehicle = vehicle->second, .barrier = barrier->second};
}

template <typename Source>
BarrierId add(Responder::Implementation& responder, const Source& source,
              const BarrierOptions& options, std::string name) {
  if (options.response) {
    validate(*options.response);
    if (options.response->method != responder.options.response.method) {
      throw Error("BarrierOptions::response: all barriers of a responder follow the same method");
    }
  }
  if (name.empty()) name = "barrier " + std::to_string(responder.barriers.size());
  const bool exact = responder.options.contactSource == ContactSource::exact_cut;
  // Built whole before anything refers to it.
  auto barrier = std::make_unique<Barrier>(
      source, options, std::move(name),
      exact ? BarrierMesh::Query::list_triangles : BarrierMesh::Query::make_contacts,
      responder.options.response);
  responder.barrierOfGeom.emplace(barrier->mesh.geom(), barrier.get());
  responder.barriers.push_back(std::move(barrier));
  return {static_cast<int>(responder.barriers.size()) - 1};
}

}  // namespace

OwnedPair Responder::Implementation::pairOf(dGeomID a, dGeomID b) const {
  const OwnedPair pair = ordered(*this, a, b);
  return pair ? pair : ordered(*this, b, a);
}

Responder::Responder(dWorldID world, const ResponderOptions& options) {
  if (world == nullptr) throw Error("Responder: the world is null");
  if (dCheckConfiguration("ODE_double_precision") == 0) {
    throw Error("Responder: this ODE is not built in double precision");
  }
  validate(options.response);
  implementation_ = std::make_unique<Implementation>();
  implementation_->world = world;
  implementation_->options = options;
}

Responder::~Responder() = default;
Responder::Responder(Responder&&) noexcept = default;
Responder& Responder::operator=(Responder&&) noexcept = default;

BarrierId Responder::addBarrier(const Scene& scene, const BarrierOptions& options) {
  return add(*implementation_, scene, options, options.name.empty() ? scene.name : options.name);
}

BarrierId Responder::addBarrier(dGeomID trimesh, const BarrierOptions& options) {
  if (trimesh == nullptr) throw Error("addBarrier: the geom is null");
  if (dGeomGetClass(trimesh) != dTriMeshClass) {
    throw Error("addBarrier: the geom is of ODE class " + std::to_string(dGeomGetClass(trimesh)) +
                ": only a trimesh can be a barrier");
  }
  if (dGeomTriMeshGetTriMeshDataID(trimesh) == nullptr) {
    throw Error("addBarrier: the trimesh has no data");
  }
  if (dGeomGetBody(trimesh) != nullptr) {
    throw Error("addBarrier: the trimesh has a body: a barrier must stand still");
  }
  if (implementation_->barrierOfGeom.contains(trimesh)) {
    throw Error("addBarrier: the trimesh is a barrier already");
  }
  return add(*implementation_, trimesh, options, options.name);
}

dGeomID Responder::geom(BarrierId barrier) const {
  return registered(implementation_->barriers, barrier.value, "barrier").mesh.geom();
}

const WallReport& Responder::report(BarrierId barrier) const {
  return registered(implementation_->barriers, barrier.value, "barrier").mesh.report();
}

VehicleId Responder::addVehicle(dBodyID chassis, const VehicleParameters& parameters,
                                const VehicleOptions& options) {
  validate(parameters);
  Implementation& self = *implementation_;
  std::vector<dBodyID> bodies{chassis};
  bodies.insert(bodies.end(), options.linkedBodies.begin(), options.linkedBodies.end());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string what = i == 0 ? "the chassis" : "linked body " + std::to_string(i - 1);
    if (bodies[i] == nullptr) throw Error("addVehicle: " + what + " is null");
    if (dBodyGetWorld(bodies[i]) != self.world) {
      throw Error("addVehicle: " + what + " belongs to another world");
    }
    if (dBodyIsKinematic(bodies[i]) != 0) {
      throw Error("addVehicle: " + what + " is kinematic: no force moves it");
    }
    const auto end = bodies.begin() + static_cast<std::ptrdiff_t>(i);
    if (self.vehicleOfBody.contains(bodies[i]) ||
        std::find(bodies.begin(), end, bodies[i]) != end) {
      throw Error("addVehicle: " + what + " is part of a vehicle already");
    }
  }
  if (!(options.tiltLimit > 0.0 && options.tiltLimit < 0.5 * std::numbers::pi)) {
    throw Error("addVehicle: the tilt limit is " + std::to_string(options.tiltLimit) +
                " rad: it must lie between 0 and π/2");
  }
  const bool asPaper = self.options.response.method == Method::paper;
  const Band band =
      options.band.value_or(asPaper ? plateBand(parameters) : defaultBand(parameters));
  if (!(std::isfinite(band.bottom) && std::isfinite(band.top) && band.bottom < band.top)) {
    throw Error("addVehicle: the band reaches from " + std::to_string(band.bottom) + " m to " +
                std::to_string(band.top) + " m: the bottom must lie below the top");
  }

  VehicleBodies vehicleBodies(bodies);
  const VehicleState state = vehicleBodies.read();
  requireClose(state.mass, parameters.mass, massTolerance, "mass", "kg");
  requireClose(state.yawInertia, parameters.yawInertia, inertiaTolerance, "yaw inertia", "kg m²");

  const int id = static_cast<int>(self.vehicles.size());
  const std::string name =
      options.name.empty() ? "vehicle " + std::to_string(id) : std::string(options.name);
  auto vehicle = std::make_unique<Vehicle>(parameters, band, options.tiltLimit, name,
                                           std::move(vehicleBodies));
  for (dBodyID body : bodies) {
    warnOfLosses(body, name, self.warnings);
    warnOfStrangers(body, bodies, name, self.warnings);
    self.vehicleOfBody.emplace(body, vehicle.get());
  }
  self.vehicles.push_back(std::move(vehicle));
  // So that step() need not allocate when the first vehicle hits the first wall.
  self.events.reserve(self.vehicles.size() * CollisionStep::maxImpacts);
  self.segments.reserve(512);
  return {id};
}

void Responder::removeBarrier(BarrierId barrier) {
  Barrier& removed = registered(implementation_->barriers, barrier.value, "barrier");
  for (const std::unique_ptr<Vehicle>& vehicle : implementation_->vehicles) {
    if (vehicle != nullptr) std::erase(vehicle->brokenThrough, &removed);
  }
  implementation_->barrierOfGeom.erase(removed.mesh.geom());
  implementation_->barriers[static_cast<std::size_t>(barrier.value)].reset();
}

void Responder::removeVehicle(VehicleId vehicle) {
  const Vehicle& removed = registered(implementation_->vehicles, vehicle.value, "vehicle");
  for (dBodyID body : removed.bodies.all()) implementation_->vehicleOfBody.erase(body);
  implementation_->vehicles[static_cast<std::size_t>(vehicle.value)].reset();
}

bool Responder::claims(dGeomID a, dGeomID b) const {
  const OwnedPair pair = implementation_->pairOf(a, b);
  // A mesh that holds ground too is sorted out contact by contact.
  if (!pair || !pair.barrier->mesh.hasWallsOnly()) return false;
  return pair.vehicle->query.allInBand(pair.vehicle->bodies.read(),
                                       pair.barrier->mesh.highestFoot(),
                                       pair.barrier->mesh.lowestTop());
}

int Responder::keepUnclaimed(dGeomID a, dGeomID b, dContact* contacts, int count) const {
  const OwnedPair pair = implementation_->pairOf(a, b);
  if (!pair) return count;
  const BarrierMesh& mesh = pair.barrier->mesh;
  const VehicleState state = pair.vehicle->bodies.read();
  const auto isOurs = [&](const dContact& contact) {
    const int triangle = contact.geom.g1 == mesh.geom() ? contact.geom.side1 : contact.geom.side2;
    const Eigen::Vector3d place = toVector(contact.geom.pos);
    const WallQuery& query = pair.vehicle->query;
    // ODE numbers no triangle where two trimeshes meet along their edges.
    if (triangle < 0) return query.isAboveBottom(state, place);
    const WallPart part = mesh.partOf(triangle);
    if (part.kind == WallPart::Kind::none) return false;
    if (!query.inBand(state, place, part.foot, part.top)) return false;
    // A cap is the wall's for a vehicle that stands before the wall, and ground for the wheels of
    // one that drives up to its height.
    return part.kind == WallPart::Kind::face || query.isAboveBottom(state, place);
  };
  return static_cast<int>(std::remove_if(contacts, contacts + count, isOurs) - contacts);
}

double Responder::time() const { return implementation_->time; }

unsigned Responder::issues() const { return implementation_->issues; }

unsigned Responder::issues(VehicleId vehicle) const {
  return registered(implementation_->vehicles, vehicle.value, "vehicle").issues;
}

std::span<const std::string> Responder::warnings() const { return implementation_->warnings; }

}  // namespace bumper
