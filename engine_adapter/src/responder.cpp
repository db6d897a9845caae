#include "bumper/engine_adapter/responder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>
#include <utility>

#include "bumper/response/error.h"
#include "responder_implementation.h"
#include "room.h"
#include "vehicle_warnings.h"

namespace bumper {

namespace {

// Tolerances of the bodies' own mass and yaw inertia against the parameters.
constexpr double massTolerance = 0.01;
constexpr double inertiaTolerance = 0.05;

template <typename Thing>
Thing& registered(const std::vector<std::unique_ptr<Thing>>& things, int id, const char* kind) {
  if (Thing* thing = find(things, id)) return *thing;
  throw Error("this responder has no " + std::string(kind) + " with id " + std::to_string(id));
}

template <typename Thing>
void erase(std::vector<std::unique_ptr<Thing>>& things, const Thing& thing) {
  things.erase(std::find_if(things.begin(), things.end(),
                            [&](const auto& each) { return each.get() == &thing; }));
}

// In metres, of parameters in a world's unit.
VehicleParameters inMetres(const VehicleParameters& given, double metre) {
  VehicleParameters own = given;
  own.yawInertia /= metre * metre;
  for (double* length :
       {&own.massCentreToFront, &own.massCentreToRear, &own.width, &own.massCentreHeight}) {
    *length /= metre;
  }
  return own;
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

std::optional<std::string> warningOf(const Barrier& barrier) {
  const WallReport& report = barrier.report();
  if (static_cast<double>(report.droppedOnGuess) <=
      muchOnGuess * static_cast<double>(report.walls)) {
    return std::nullopt;
  }
  return "barrier '" + barrier.name() + "': " + std::to_string(report.droppedOnGuess) +
         " triangles steeper than 45° are taken for hillsides, beside " +
         std::to_string(report.walls) +
         " walls: if vehicles are to hit them, raise WallSelection::maxNormalUp to 0.7";
}

template <typename... Source>
std::unique_ptr<Barrier> makeBarrier(const Responder::Implementation& responder, BarrierId id,
                                     const BarrierOptions& options, std::string name,
                                     const Source&... source) {
  return std::make_unique<Barrier>(id, source..., responder.worldFrame, options, std::move(name),
                                   responder.options.response);
}

// A scene of the application's, in metres with z up.
template <typename Use>
auto withScene(const Responder::Implementation& responder, const Scene& scene, const Use& use) {
  if (responder.worldFrame.isUsual()) return use(scene);
  return use(responder.worldFrame.scene(scene));
}

// After barriers have changed or gone.
void lookAround(Responder::Implementation& responder) noexcept {
  responder.longestPenetrationTime = 0.0;
  responder.movingBarriers.clear();
  for (const std::unique_ptr<Barrier>& barrier : responder.barriers) {
    if (barrier->frame().moves()) responder.movingBarriers.push_back(barrier.get());
    responder.longestPenetrationTime =
        std::max(responder.longestPenetrationTime, barrier->longestPenetrationTime());
  }
  responder.forgetSurroundings();
}

// Everything that may fail comes first: a barrier is added as a whole or not at all.
template <typename... Source>
BarrierId add(Responder::Implementation& responder, const BarrierOptions& options, std::string name,
              const Source&... source) {
  responder.requireValid(options);
  const BarrierId id{responder.nextBarrier};
  if (name.empty()) name = "barrier " + std::to_string(id.value);
  auto barrier = makeBarrier(responder, id, options, std::move(name), source...);
  std::optional<std::string> warning = warningOf(*barrier);
  makeRoom(responder.barriers, 1);
  if (responder.movingBarriers.capacity() <= responder.barriers.size()) {
    responder.movingBarriers.reserve(responder.barriers.capacity());
  }
  responder.warnings.makeRoom(1);
  responder.barrierOfGeom.insert_or_assign(barrier->geom(), barrier.get());

  if (warning) responder.warnings.add(barrier.get(), std::move(*warning));
  responder.longestPenetrationTime =
      std::max(responder.longestPenetrationTime, barrier->longestPenetrationTime());
  if (barrier->frame().moves()) responder.movingBarriers.push_back(barrier.get());
  responder.barriers.push_back(std::move(barrier));
  ++responder.nextBarrier;
  responder.forgetSurroundings();
  return id;
}

// A geom at the same address may be another barrier by now.
void forgetGeom(Responder::Implementation& responder, const Barrier& barrier) noexcept {
  const auto entry = responder.barrierOfGeom.find(barrier.geom());
  if (entry != responder.barrierOfGeom.end() && entry->second == &barrier) {
    responder.barrierOfGeom.erase(entry);
  }
}

// The same barrier with other walls; likewise.
template <typename... Source>
void update(Responder::Implementation& responder, const Barrier& old, const BarrierOptions& options,
            const Source&... source) {
  std::unique_ptr<Barrier> fresh = makeBarrier(responder, old.id(), options, old.name(), source...);
  fresh->frame().takeOver(old.frame());
  fresh->frame().follow(fresh->geom(), responder.time, responder.lastStep);
  std::optional<std::string> warning = warningOf(*fresh);
  responder.warnings.makeRoom(1);
  responder.barrierOfGeom.insert_or_assign(fresh->geom(), fresh.get());

  for (const std::unique_ptr<Vehicle>& vehicle : responder.vehicles) {
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
  if (warning) responder.warnings.add(fresh.get(), std::move(*warning));
  const auto place = std::find_if(responder.barriers.begin(), responder.barriers.end(),
                                  [&](const auto& each) { return each.get() == &old; });
  *place = std::move(fresh);
  lookAround(responder);
}

void requireExisting(const Barrier& barrier) {
  const LentGeom* lent = barrier.mesh() != nullptr ? barrier.mesh()->lentGeom() : nullptr;
  if (lent == nullptr || lent->exists()) return;
  throw Error("updateBarrier: the geom of barrier '" + barrier.name() +
              "' was destroyed: remove the barrier and add it anew");
}

// A vehicle's geom is none of a barrier.
void requireNoVehicle(const Responder::Implementation& responder, dGeomID geom, const char* call) {
  const auto owner = responder.vehicleOfBody.find(dGeomGetBody(geom));
  if (owner == responder.vehicleOfBody.end()) return;
  throw Error(std::string(call) + ": the geom has a body of vehicle '" + owner->second->name + "'");
}

// The barrier's geom was moved, with or without a velocity, and nothing else: whether it was.
bool follow(Responder::Implementation& responder, Barrier& barrier) {
  requireNoVehicle(responder, barrier.geom(), "updateBarrier");
  if (!barrier.hasSameWalls()) return false;
  const bool moved = barrier.frame().moves();
  barrier.frame().follow(barrier.geom(), responder.time, responder.lastStep);
  if (barrier.frame().moves() != moved) lookAround(responder);
  return barrier.frame().moves();
}

// Whether a geom of the application's can become a barrier.
void requireUsable(const Responder::Implementation& responder, dGeomID geom) {
  if (geom == nullptr) throw Error("addBarrier: the geom is null");
  if (dGeomIsSpace(geom) != 0) throw Error("addBarrier: the geom is a space");
  requireNoVehicle(responder, geom, "addBarrier");
  const auto known = responder.barrierOfGeom.find(geom);
  if (known != responder.barrierOfGeom.end() && known->second->isStill(geom)) {
    throw Error("addBarrier: the geom is a barrier already");
  }
}

}  // namespace

void Responder::Implementation::requireValid(const BarrierOptions& given) const {
  if (given.response) validateSettings(*given.response, options);
  for (const auto& [material, settings] : given.materials) validateSettings(settings, options);
}

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
  implementation_->worldFrame = WorldFrame(options.axes);
}

Responder::~Responder() = default;
Responder::Responder(Responder&&) noexcept = default;
Responder& Responder::operator=(Responder&&) noexcept = default;

BarrierId Responder::addBarrier(const Scene& scene, const BarrierOptions& options) {
  std::string name = options.name.empty() ? scene.name : options.name;
  if (options.geom != nullptr) {
    requireUsable(*implementation_, options.geom);
    if (dGeomGetClass(options.geom) == dTriMeshClass) {
      throw Error("addBarrier: BarrierOptions::geom is a trimesh: add it as it is");
    }
  }
  return withScene(*implementation_, scene, [&](const Scene& own) {
    return options.geom == nullptr
               ? add(*implementation_, options, std::move(name), own)
               : add(*implementation_, options, std::move(name), options.geom, own);
  });
}

BarrierId Responder::addBarrier(dGeomID geom, const BarrierOptions& options) {
  requireUsable(*implementation_, geom);
  if (dGeomGetClass(geom) == dTriMeshClass && dGeomTriMeshGetTriMeshDataID(geom) == nullptr) {
    throw Error("addBarrier: the trimesh has no data");
  }
  return add(*implementation_, options, options.name, geom);
}

void Responder::updateBarrier(BarrierId barrier) {
  Implementation& self = *implementation_;
  Barrier& old = registered(self.barriers, barrier.value, "barrier");
  requireExisting(old);
  if (follow(self, old)) return;
  if (old.hasScene()) {
    throw Error("updateBarrier: the walls of barrier '" + old.name() +
                "' came from a scene, and its geom was not moved: give the scene as it is now");
  }
  update(self, old, old.options(), old.geom());
}

void Responder::updateBarrier(BarrierId barrier, const BarrierVelocity& velocity) {
  Implementation& self = *implementation_;
  Barrier& moved = registered(self.barriers, barrier.value, "barrier");
  requireExisting(moved);
  if (!velocity.linear.allFinite() || !velocity.angular.allFinite()) {
    throw Error("updateBarrier: the velocity of barrier '" + moved.name() + "' is not finite");
  }
  if (moved.frame().body() != nullptr || dGeomGetBody(moved.geom()) != nullptr) {
    throw Error("updateBarrier: barrier '" + moved.name() +
                "' has a body: set the velocity of that");
  }
  if (moved.primitive() != nullptr && !moved.primitive()->isPost()) {
    throw Error("updateBarrier: barrier '" + moved.name() + "' is a plane, and planes do not move");
  }
  if (!moved.hasSameWalls()) {
    if (moved.hasScene()) {
      throw Error("updateBarrier: the geom of barrier '" + moved.name() + "' has another shape");
    }
    update(self, moved, moved.options(), moved.geom());
  }
  Barrier& now = *find(self.barriers, barrier.value);
  now.frame().follow(now.geom(), self.time, self.lastStep);
  now.frame().setVelocity(velocity, self.time);
  lookAround(self);
}

void Responder::updateBarrier(BarrierId barrier, const Scene& scene) {
  const Barrier& old = registered(implementation_->barriers, barrier.value, "barrier");
  if (!old.hasScene()) {
    throw Error("updateBarrier: the walls of barrier '" + old.name() +
                "' are read from its geom: no scene is needed");
  }
  const LentGeom* lent = old.mesh()->lentGeom();
  if (lent == nullptr) {
    requireNoVehicle(*implementation_, old.geom(), "updateBarrier");
    withScene(*implementation_, scene, [&](const Scene& own) {
      update(*implementation_, old, old.options(), old.geom(), own);
    });
    return;
  }
  requireExisting(old);
  BarrierOptions options = old.options();
  // Its original space may be destroyed by now, and the geom in another.
  if (options.space != nullptr) options.space = dGeomGetSpace(lent->address());
  withScene(*implementation_, scene,
            [&](const Scene& own) { update(*implementation_, old, options, own); });
}

dGeomID Responder::geom(BarrierId barrier) const {
  const Barrier& self = registered(implementation_->barriers, barrier.value, "barrier");
  const LentGeom* lent = self.mesh() != nullptr ? self.mesh()->lentGeom() : nullptr;
  return lent != nullptr && lent->wentWithSpace() ? nullptr : self.geom();
}

const WallReport& Responder::report(BarrierId barrier) const {
  return registered(implementation_->barriers, barrier.value, "barrier").report();
}

VehicleId Responder::addVehicle(dBodyID chassis, const VehicleParameters& given,
                                const VehicleOptions& options) {
  validate(given);
  Implementation& self = *implementation_;
  const VehicleParameters parameters = inMetres(given, self.worldFrame.metre());
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
  Band band = asPaper ? plateBand(parameters) : defaultBand(parameters);
  if (options.band) {
    band = {.bottom = options.band->bottom / self.worldFrame.metre(),
            .top = options.band->top / self.worldFrame.metre()};
  }
  if (!(std::isfinite(band.bottom) && std::isfinite(band.top) && band.bottom < band.top)) {
    throw Error("addVehicle: the band reaches from " + std::to_string(band.bottom) + " m to " +
                std::to_string(band.top) + " m: the bottom must lie below the top");
  }

  VehicleBodies vehicleBodies(bodies, self.worldFrame, turnOf(options.axes));
  const VehicleState state = vehicleBodies.read();
  if (options.mover == Mover::world) {
    requireClose(state.mass, parameters.mass, massTolerance, "mass", "kg");
    requireClose(state.yawInertia, parameters.yawInertia, inertiaTolerance, "yaw inertia", "kg m²");
  }

  // Everything that may fail comes first.
  const int id = self.nextVehicle;
  const std::string name =
      options.name.empty() ? "vehicle " + std::to_string(id) : std::string(options.name);
  std::vector<std::string> warnings = warningsOf(vehicleBodies, parameters, band, name);
  std::optional<std::string> warningOfWorld = warningOf(self.world, self.worldFrame);
  auto vehicle = std::make_unique<Vehicle>(VehicleId{id}, parameters, band, options.tiltLimit, name,
                                           std::move(vehicleBodies), options.mover);
  self.warnings.makeRoom(warnings.size() + 1);
  makeRoom(self.vehicles, 1);
  // So that step() need not allocate when the first vehicle hits the first wall.
  const std::size_t count = self.vehicles.size() + 1;
  self.events.reserve(CollisionStep::maxImpacts + 16 * count);
  self.active.resize(std::max(self.active.size(), count));
  self.travellers.reserve(count);
  try {
    for (dBodyID body : bodies) self.vehicleOfBody.emplace(body, vehicle.get());
    self.traffic.add(vehicle->traveller);
  } catch (...) {
    for (dBodyID body : bodies) self.vehicleOfBody.erase(body);
    throw;
  }

  self.warnings.drop(nullptr);
  if (warningOfWorld) self.warnings.add(nullptr, std::move(*warningOfWorld));
  for (std::string& text : warnings) self.warnings.add(vehicle.get(), std::move(text));
  if (options.finiteRotation) {
    for (dBodyID body : bodies) dBodySetFiniteRotationMode(body, 1);
  }
  self.anyCopied = self.anyCopied || vehicle->bodies.areCopied();
  self.vehicles.push_back(std::move(vehicle));
  ++self.nextVehicle;
  if (!self.clock) self.clock.emplace(self.world);
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
  forgetGeom(*implementation_, removed);
  implementation_->warnings.drop(&removed);
  erase(implementation_->barriers, removed);
  lookAround(*implementation_);
}

void Responder::removeVehicle(VehicleId vehicle) {
  Implementation& self = *implementation_;
  Vehicle& removed = registered(self.vehicles, vehicle.value, "vehicle");
  for (dBodyID body : removed.bodies.all()) self.vehicleOfBody.erase(body);
  self.warnings.drop(&removed);
  std::erase_if(self.pairOptions, [&](const auto& rule) {
    return rule.first.first == vehicle.value || rule.first.second == vehicle.value;
  });
  for (const std::unique_ptr<Vehicle>& other : self.vehicles) {
    for (VehicleMemory* memory : {&other->memory, &other->memoryBefore}) {
      std::erase_if(memory->hits, [&](const VehicleHit& each) { return each.vehicle == vehicle; });
      std::erase_if(memory->contacts,
                    [&](const SustainedContact& each) { return each.with.vehicle == vehicle; });
    }
    for (GuardLoad& load : other->guards.loads()) {
      if (load.with.vehicle == vehicle) load.with = {};
    }
  }
  removed.guards.release();
  self.traffic.remove(removed.traveller);
  erase(self.vehicles, removed);
  if (self.vehicles.empty()) {
    self.warnings.drop(nullptr);
    self.clock.reset();
  }
}

Eigen::Vector3d Responder::position(VehicleId vehicle) const {
  const Vehicle& self = registered(implementation_->vehicles, vehicle.value, "vehicle");
  return implementation_->worldFrame.vectorInWorld(self.bodies.readPose().massCentre);
}

Eigen::Quaterniond Responder::orientation(VehicleId vehicle) const {
  return registered(implementation_->vehicles, vehicle.value, "vehicle")
      .bodies.orientationInWorld();
}

Eigen::Vector3d Responder::velocity(VehicleId vehicle) const {
  const Vehicle& self = registered(implementation_->vehicles, vehicle.value, "vehicle");
  const VehicleState state = self.bodies.read();
  const Eigen::Vector3d pending =
      self.memory.delivery.axes.leftCols<2>() * self.memory.pulse.pending().linear;
  return implementation_->worldFrame.vectorInWorld(state.velocity + pending / state.mass);
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
    saved.vehicles.push_back(vehicle->memory);
    const std::span<const GuardLoad> loads = vehicle->guards.loads();
    saved.vehicles.back().guards.assign(loads.begin(), loads.end());
  }
  for (const Barrier* barrier : implementation_->movingBarriers) {
    saved.barriers.push_back(barrier->frame().motion());
    saved.barriers.back().barrier = barrier->id();
  }
  return saved;
}

void Responder::restore(const SavedState& state) {
  Implementation& self = *implementation_;
  if (self.vehicles.size() != state.vehicles.size()) {
    throw Error("restore: the saved state is of " + std::to_string(state.vehicles.size()) +
                " vehicles, but " + std::to_string(self.vehicles.size()) + " are registered");
  }
  const auto requireWall = [&](BarrierId id, int wall) {
    const Barrier& barrier = registered(self.barriers, id.value, "barrier");
    if (wall >= 0 && wall < barrier.wallCount()) return;
    throw Error("restore: barrier '" + barrier.name() + "' has no wall number " +
                std::to_string(wall));
  };
  std::set<int> ids;
  for (const VehicleMemory& memory : state.vehicles) {
    const Vehicle& vehicle = registered(self.vehicles, memory.vehicle.value, "vehicle");
    if (!ids.insert(memory.vehicle.value).second) {
      throw Error("restore: the saved state has vehicle '" + vehicle.name + "' more than once");
    }
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
      } else {
        requireWall(contact.with.barrier, contact.wall);
      }
    }
    for (const GuardLoad& load : memory.guards) {
      if (load.with.vehicle != VehicleId{}) {
        registered(self.vehicles, load.with.vehicle.value, "vehicle");
      } else if (load.with.barrier != BarrierId{}) {
        requireWall(load.with.barrier, load.wall);
      }
    }
  }
  for (const BarrierMotion& motion : state.barriers) {
    const Barrier& barrier = registered(self.barriers, motion.barrier.value, "barrier");
    if (motion.position.allFinite() && motion.axes.allFinite() && motion.velocity.allFinite() &&
        motion.turning.allFinite()) {
      continue;
    }
    throw Error("restore: the motion of barrier '" + barrier.name() + "' is not finite");
  }
  // Copies first, which may fail; a step takes them as it takes those of a new vehicle.
  std::vector<std::array<VehicleMemory, 2>> copies(state.vehicles.size());
  for (std::size_t i = 0; i < copies.size(); ++i) {
    for (VehicleMemory& copy : copies[i]) {
      copy = state.vehicles[i];
      copy.guards.clear();
      keepRoom(copy);
    }
  }
  for (std::size_t i = 0; i < copies.size(); ++i) {
    Vehicle& vehicle = *find(self.vehicles, state.vehicles[i].vehicle.value);
    vehicle.memory = std::move(copies[i][0]);
    vehicle.memoryBefore = std::move(copies[i][1]);
    vehicle.guards.release();
    vehicle.guards.setLoads(state.vehicles[i].guards);
  }
  if (self.clock) self.clock->stop();
  dJointGroupEmpty(self.guardJoints.get());
  self.hasGuards = false;
  // One that has begun to move since stands still where it is until it is moved again.
  for (Barrier* barrier : self.movingBarriers) barrier->frame().stop();
  for (const BarrierMotion& motion : state.barriers) {
    find(self.barriers, motion.barrier.value)->frame().restore(motion);
  }
  lookAround(self);
  self.time = state.time;
}

double Responder::time() const { return implementation_->time; }

unsigned Responder::issues() const { return implementation_->issues; }

unsigned Responder::issues(VehicleId vehicle) const {
  return registered(implementation_->vehicles, vehicle.value, "vehicle").issues;
}

std::span<const std::string> Responder::warnings() const { return implementation_->warnings.all(); }

}  // namespace bumper
