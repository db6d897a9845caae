#include "bumper/engine_adapter/responder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "bumper/response/error.h"
#include "responder_implementation.h"
#include "vehicle_warnings.h"

namespace bumper {

namespace {

// Tolerances of the bodies' own mass and yaw inertia against the parameters.
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

void validateSettings(const ResponseSettings& settings, const ResponderOptions& usual) {
  validate(settings);
  if (settings.method != usual.response.method) {
    throw Error("BarrierOptions: all barriers of a responder follow the same method");
  }
}

void validateOfPair(const ResponseSettings& settings, const char* what) {
  validate(settings);
  if (settings.method == Method::paper) {
    throw Error(std::string(what) + ": the paper's method has no law for two vehicles");
  }
  if (breaks(settings))
    throw Error(std::string(what) + ": vehicles do not break through each other");
}

// Of a barrier where more than this part of what may be a wall was dropped on a guess.
constexpr double muchOnGuess = 0.1;

void warnOfGuesses(Warnings& warnings, const Barrier& barrier) {
  const WallReport& report = barrier.report();
  if (static_cast<double>(report.droppedOnGuess) <=
      muchOnGuess * static_cast<double>(report.walls)) {
    return;
  }
  warnings.add(&barrier,
               "barrier '" + barrier.name() + "': " + std::to_string(report.droppedOnGuess) +
                   " triangles steeper than 45° are taken for hillsides, beside " +
                   std::to_string(report.walls) +
                   " walls: if vehicles are to hit them, raise WallSelection::maxNormalUp to 0.7");
}

template <typename... Source>
std::unique_ptr<Barrier> makeBarrier(const Responder::Implementation& responder, BarrierId id,
                                     const BarrierOptions& options, std::string name,
                                     const Source&... source) {
  return std::make_unique<Barrier>(id, source..., options, std::move(name),
                                   responder.options.response);
}

// Builds the barrier whole before anything refers to it.
template <typename... Source>
BarrierId add(Responder::Implementation& responder, const BarrierOptions& options, std::string name,
              const Source&... source) {
  if (options.response) validateSettings(*options.response, responder.options);
  for (const auto& [material, settings] : options.materials) {
    validateSettings(settings, responder.options);
  }
  const BarrierId id{static_cast<int>(responder.barriers.size())};
  if (name.empty()) name = "barrier " + std::to_string(id.value);
  auto barrier = makeBarrier(responder, id, options, std::move(name), source...);
  responder.longestPenetrationTime =
      std::max(responder.longestPenetrationTime, barrier->longestPenetrationTime());
  responder.barrierOfGeom.insert_or_assign(barrier->geom(), barrier.get());
  warnOfGuesses(responder.warnings, *barrier);
  responder.barriers.push_back(std::move(barrier));
  responder.forgetSurroundings();
  return id;
}

// A geom at the same address may be another barrier by now.
void forgetGeom(Responder::Implementation& responder, const Barrier& barrier) {
  const auto entry = responder.barrierOfGeom.find(barrier.geom());
  if (entry != responder.barrierOfGeom.end() && entry->second == &barrier) {
    responder.barrierOfGeom.erase(entry);
  }
}

// The same barrier with other walls.
template <typename... Source>
void update(Responder::Implementation& responder, const Barrier& old, const BarrierOptions& options,
            const Source&... source) {
  std::unique_ptr<Barrier> fresh = makeBarrier(responder, old.id(), options, old.name(), source...);
  for (const std::unique_ptr<Vehicle>& vehicle : responder.vehicles) {
    if (vehicle == nullptr) continue;
    for (VehicleMemory* memory : {&vehicle->memory, &vehicle->memoryBefore}) {
      for (SustainedContact& contact : memory->contacts) {
        if (contact.with.barrier == old.id())
          contact.wall = std::min(contact.wall, fresh->wallCount() - 1);
      }
    }
    for (GuardLoad& load : vehicle->guards.loads()) {
      if (load.with.barrier == old.id()) load.wall = std::min(load.wall, fresh->wallCount() - 1);
    }
  }
  forgetGeom(responder, old);
  responder.warnings.drop(&old);
  warnOfGuesses(responder.warnings, *fresh);
  responder.barrierOfGeom.insert_or_assign(fresh->geom(), fresh.get());
  responder.barriers[static_cast<std::size_t>(old.id().value)] = std::move(fresh);
  responder.forgetSurroundings();
}

void requireStanding(dGeomID geom, const char* call) {
  if (dGeomGetBody(geom) != nullptr) {
    throw Error(std::string(call) + ": the geom has a body: a barrier must stand still");
  }
}

// Whether a geom of the application's can become a barrier.
void requireUsable(const Responder::Implementation& responder, dGeomID geom) {
  if (geom == nullptr) throw Error("addBarrier: the geom is null");
  if (dGeomIsSpace(geom) != 0) throw Error("addBarrier: the geom is a space");
  requireStanding(geom, "addBarrier");
  const auto known = responder.barrierOfGeom.find(geom);
  if (known != responder.barrierOfGeom.end() && known->second->isStill(geom)) {
    throw Error("addBarrier: the geom is a barrier already");
  }
}

}  // namespace

Responder::Responder(dWorldID world, const ResponderOptions& options) {
  if (world == nullptr) throw Error("Responder: the world is null");
  if (dCheckConfiguration("ODE_double_precision") == 0) {
    throw Error("Responder: this ODE is not built in double precision");
  }
  validate(options.response);
  validateOfPair(options.vehicleResponse, "ResponderOptions::vehicleResponse");
  implementation_ = std::make_unique<Implementation>();
  implementation_->world = world;
  implementation_->options = options;
}

Responder::~Responder() = default;
Responder::Responder(Responder&&) noexcept = default;
Responder& Responder::operator=(Responder&&) noexcept = default;

BarrierId Responder::addBarrier(const Scene& scene, const BarrierOptions& options) {
  std::string name = options.name.empty() ? scene.name : options.name;
  if (options.geom == nullptr) return add(*implementation_, options, std::move(name), scene);
  requireUsable(*implementation_, options.geom);
  if (dGeomGetClass(options.geom) == dTriMeshClass) {
    throw Error("addBarrier: BarrierOptions::geom is a trimesh: add it as it is");
  }
  return add(*implementation_, options, std::move(name), options.geom, scene);
}

BarrierId Responder::addBarrier(dGeomID geom, const BarrierOptions& options) {
  requireUsable(*implementation_, geom);
  if (dGeomGetClass(geom) == dTriMeshClass && dGeomTriMeshGetTriMeshDataID(geom) == nullptr) {
    throw Error("addBarrier: the trimesh has no data");
  }
  return add(*implementation_, options, options.name, geom);
}

void Responder::updateBarrier(BarrierId barrier) {
  const Barrier& old = registered(implementation_->barriers, barrier.value, "barrier");
  if (old.hasScene()) {
    throw Error("updateBarrier: the walls of barrier '" + old.name() +
                "' came from a scene: give the scene as it is now");
  }
  requireStanding(old.geom(), "updateBarrier");
  update(*implementation_, old, old.options(), old.geom());
}

void Responder::updateBarrier(BarrierId barrier, const Scene& scene) {
  const Barrier& old = registered(implementation_->barriers, barrier.value, "barrier");
  if (!old.hasScene()) {
    throw Error("updateBarrier: the walls of barrier '" + old.name() +
                "' are read from its geom: no scene is needed");
  }
  const LentGeom* lent = old.mesh()->lentGeom();
  if (lent == nullptr) {
    requireStanding(old.geom(), "updateBarrier");
    update(*implementation_, old, old.options(), old.geom(), scene);
    return;
  }
  if (!lent->exists()) {
    throw Error("updateBarrier: the geom of barrier '" + old.name() +
                "' was destroyed: remove the barrier and add it anew");
  }
  BarrierOptions options = old.options();
  // Its original space may be destroyed by now, and the geom in another.
  if (options.space != nullptr) options.space = dGeomGetSpace(lent->address());
  update(*implementation_, old, options, scene);
}

dGeomID Responder::geom(BarrierId barrier) const {
  const Barrier& self = registered(implementation_->barriers, barrier.value, "barrier");
  const LentGeom* lent = self.mesh() != nullptr ? self.mesh()->lentGeom() : nullptr;
  return lent != nullptr && lent->wentWithSpace() ? nullptr : self.geom();
}

const WallReport& Responder::report(BarrierId barrier) const {
  return registered(implementation_->barriers, barrier.value, "barrier").report();
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
    if (options.mover == Mover::world && dBodyIsKinematic(bodies[i]) != 0) {
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

  const VehicleBodies vehicleBodies(bodies);
  const VehicleState state = vehicleBodies.read();
  if (options.mover == Mover::world) {
    requireClose(state.mass, parameters.mass, massTolerance, "mass", "kg");
    requireClose(state.yawInertia, parameters.yawInertia, inertiaTolerance, "yaw inertia", "kg m²");
  }

  const int id = static_cast<int>(self.vehicles.size());
  const std::string name =
      options.name.empty() ? "vehicle " + std::to_string(id) : std::string(options.name);
  auto vehicle = std::make_unique<Vehicle>(VehicleId{id}, parameters, band, options.tiltLimit, name,
                                           vehicleBodies, options.mover);
  self.warnings.drop(nullptr);
  if (std::optional<std::string> text = warningOf(self.world)) self.warnings.add(nullptr, *text);
  for (std::string& text : warningsOf(vehicleBodies, parameters, band, name)) {
    self.warnings.add(vehicle.get(), std::move(text));
  }
  for (dBodyID body : bodies) {
    if (options.finiteRotation) dBodySetFiniteRotationMode(body, 1);
    self.vehicleOfBody.emplace(body, vehicle.get());
  }
  self.vehicles.push_back(std::move(vehicle));
  if (!self.clock) self.clock.emplace(self.world);
  // So that step() need not allocate when the first vehicle hits the first wall.
  self.events.reserve(CollisionStep::maxImpacts + 16 * self.vehicles.size());
  self.active.resize(self.vehicles.size());
  self.travellers.reserve(self.vehicles.size());
  self.traffic.add(self.vehicles.back()->traveller);
  return {id};
}

void Responder::setPair(VehicleId a, VehicleId b, const PairOptions& options) {
  Implementation& self = *implementation_;
  registered(self.vehicles, a.value, "vehicle");
  registered(self.vehicles, b.value, "vehicle");
  if (a == b) throw Error("setPair: both vehicles are the same");
  if (options.response) validateOfPair(*options.response, "setPair");
  self.pairOptions.insert_or_assign(std::minmax(a.value, b.value), options);
}

void Responder::removeBarrier(BarrierId barrier) {
  const Barrier& removed = registered(implementation_->barriers, barrier.value, "barrier");
  for (const std::unique_ptr<Vehicle>& vehicle : implementation_->vehicles) {
    if (vehicle == nullptr) continue;
    for (VehicleMemory* memory : {&vehicle->memory, &vehicle->memoryBefore}) {
      std::erase_if(memory->passable,
                    [&](const PassableWall& each) { return each.barrier == barrier; });
      std::erase_if(memory->contacts,
                    [&](const SustainedContact& each) { return each.with.barrier == barrier; });
    }
    for (GuardLoad& load : vehicle->guards.loads()) {
      if (load.with.barrier == barrier) load.with = {};
    }
  }
  implementation_->forgetSurroundings();
  forgetGeom(*implementation_, removed);
  implementation_->warnings.drop(&removed);
  implementation_->barriers[static_cast<std::size_t>(barrier.value)].reset();
}

void Responder::removeVehicle(VehicleId vehicle) {
  const Vehicle& removed = registered(implementation_->vehicles, vehicle.value, "vehicle");
  for (dBodyID body : removed.bodies.all()) implementation_->vehicleOfBody.erase(body);
  implementation_->warnings.drop(&removed);
  std::erase_if(implementation_->pairOptions, [&](const auto& rule) {
    return rule.first.first == vehicle.value || rule.first.second == vehicle.value;
  });
  for (const std::unique_ptr<Vehicle>& other : implementation_->vehicles) {
    if (other == nullptr) continue;
    for (VehicleMemory* memory : {&other->memory, &other->memoryBefore}) {
      std::erase_if(memory->hits, [&](const VehicleHit& each) { return each.vehicle == vehicle; });
      std::erase_if(memory->contacts,
                    [&](const SustainedContact& each) { return each.with.vehicle == vehicle; });
    }
    for (GuardLoad& load : other->guards.loads()) {
      if (load.with.vehicle == vehicle) load.with = {};
    }
  }
  std::unique_ptr<Vehicle>& place =
      implementation_->vehicles[static_cast<std::size_t>(vehicle.value)];
  place->guards.release();
  implementation_->traffic.remove(place->traveller);
  place.reset();
}

Eigen::Vector3d Responder::position(VehicleId vehicle) const {
  return registered(implementation_->vehicles, vehicle.value, "vehicle")
      .bodies.readPose()
      .massCentre;
}

Eigen::Quaterniond Responder::orientation(VehicleId vehicle) const {
  const Vehicle& self = registered(implementation_->vehicles, vehicle.value, "vehicle");
  const dReal* q = dBodyGetQuaternion(self.bodies.chassis());
  return {q[0], q[1], q[2], q[3]};
}

Eigen::Vector3d Responder::velocity(VehicleId vehicle) const {
  const Vehicle& self = registered(implementation_->vehicles, vehicle.value, "vehicle");
  const VehicleState state = self.bodies.read();
  const Eigen::Vector3d pending =
      self.memory.delivery.axes.leftCols<2>() * self.memory.pulse.pending().linear;
  return state.velocity + pending / state.mass;
}

double Responder::yawRate(VehicleId vehicle) const {
  const Vehicle& self = registered(implementation_->vehicles, vehicle.value, "vehicle");
  const VehicleState state = self.bodies.read();
  return state.yawRate + self.memory.pulse.pending().angular / state.yawInertia;
}

SavedState Responder::save() const {
  SavedState saved;
  saved.time = implementation_->time;
  for (const std::unique_ptr<Vehicle>& vehicle : implementation_->vehicles) {
    if (vehicle == nullptr) continue;
    saved.vehicles.push_back(vehicle->memory);
    const std::span<const GuardLoad> loads = vehicle->guards.loads();
    saved.vehicles.back().guards.assign(loads.begin(), loads.end());
  }
  return saved;
}

void Responder::restore(const SavedState& state) {
  Implementation& self = *implementation_;
  const auto present = std::count_if(self.vehicles.begin(), self.vehicles.end(),
                                     [](const auto& vehicle) { return vehicle != nullptr; });
  if (static_cast<std::size_t>(present) != state.vehicles.size()) {
    throw Error("restore: the saved state is of " + std::to_string(state.vehicles.size()) +
                " vehicles, but " + std::to_string(present) + " are registered");
  }
  for (const VehicleMemory& memory : state.vehicles) {
    registered(self.vehicles, memory.vehicle.value, "vehicle");
    for (const PassableWall& wall : memory.passable) {
      const Barrier& barrier = registered(self.barriers, wall.barrier.value, "barrier");
      if (wall.settings < 0 || wall.settings >= barrier.settingsCount()) {
        throw Error("restore: barrier '" + barrier.name() + "' has no settings number " +
                    std::to_string(wall.settings));
      }
    }
    for (const VehicleHit& other : memory.hits) {
      registered(self.vehicles, other.vehicle.value, "vehicle");
    }
    for (const SustainedContact& contact : memory.contacts) {
      if (contact.with.vehicle != VehicleId{}) {
        registered(self.vehicles, contact.with.vehicle.value, "vehicle");
        continue;
      }
      const Barrier& barrier = registered(self.barriers, contact.with.barrier.value, "barrier");
      if (contact.wall < 0 || contact.wall >= barrier.wallCount()) {
        throw Error("restore: barrier '" + barrier.name() + "' has no wall number " +
                    std::to_string(contact.wall));
      }
    }
  }
  for (const VehicleMemory& memory : state.vehicles) {
    Vehicle& vehicle = *self.vehicles[static_cast<std::size_t>(memory.vehicle.value)];
    vehicle.memory = memory;
    vehicle.memory.guards.clear();
    vehicle.memoryBefore = vehicle.memory;
    vehicle.guards.release();
    vehicle.guards.setLoads(memory.guards);
  }
  if (self.clock) self.clock->stop();
  dJointGroupEmpty(self.guardJoints.get());
  self.hasGuards = false;
  self.forgetSurroundings();
  self.time = state.time;
}

double Responder::time() const { return implementation_->time; }

unsigned Responder::issues() const { return implementation_->issues; }

unsigned Responder::issues(VehicleId vehicle) const {
  return registered(implementation_->vehicles, vehicle.value, "vehicle").issues;
}

std::span<const std::string> Responder::warnings() const { return implementation_->warnings.all(); }

}  // namespace bumper
