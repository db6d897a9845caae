#pragma once

#include <ode/ode.h>

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barrier.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/collision_step.h"
#include "free_space.h"
#include "guard_contacts.h"
#include "nearby_walls.h"
#include "vehicle_bodies.h"
#include "wall_query.h"
#include "warnings.h"
#include "world_clock.h"

namespace bumper {

struct Vehicle {
  Vehicle(VehicleId id, const VehicleParameters& itsParameters, const Band& band, double tiltLimit,
          std::string itsName, VehicleBodies itsBodies)
      : parameters(itsParameters),
        name(std::move(itsName)),
        bodies(std::move(itsBodies)),
        minUprightness(std::cos(tiltLimit)),
        freeSpace(bodies, itsParameters, band, minUprightness),
        query(itsParameters, band) {
    for (VehicleMemory* each : {&memory, &memoryBefore}) {
      each->vehicle = id;
      each->passages.reserve(4);
      each->contacts.reserve(4);
    }
  }

  VehicleParameters parameters;
  std::string name;
  VehicleBodies bodies;
  double minUprightness;
  FreeSpace freeSpace;
  WallQuery query;
  NearbyWalls nearby;
  GuardContacts guards;
  VehicleMemory memory;
  VehicleMemory memoryBefore;  // as it was before the last step()
  unsigned issues = step_issue::none;

  /// False also where the rotation is not finite.
  [[nodiscard]] bool isUpright() const { return uprightness(bodies.chassis()) >= minUprightness; }
};

struct JointGroupDeleter {
  void operator()(dJointGroupID group) const { dJointGroupDestroy(group); }
};

struct Responder::Implementation {
  dWorldID world = nullptr;
  ResponderOptions options;

  // Removed ones leave an empty place, so that an id never means another thing later.
  std::vector<std::unique_ptr<Barrier>> barriers;
  std::vector<std::unique_ptr<Vehicle>> vehicles;
  std::unordered_map<dGeomID, const Barrier*> barrierOfGeom;
  std::unordered_map<dBodyID, const Vehicle*> vehicleOfBody;
  Warnings warnings;

  double time = 0.0;
  double lastStep = 0.0;
  unsigned issues = step_issue::none;
  std::vector<ImpactEvent> events;

  double longestPenetrationTime = 0.0;  // of all barriers there ever were, s

  std::optional<WorldClock> clock;  // from the first vehicle on
  std::unique_ptr<dxJointGroup, JointGroupDeleter> guardJoints{dJointGroupCreate(0)};
  bool hasGuards = false;  // the group has joints

  // Scratch memory, kept from step to step.
  CollisionStep collision;
  std::vector<WallSegment> segments;
  std::vector<Vehicle*> active;  // a place for every vehicle

  /// What is known of the room around vehicles is no longer true.
  void forgetSurroundings();

  /// The step of those vehicles that are not certainly away from all walls.
  void stepAll(std::span<Vehicle* const> some, double h);
  void reconsiderLastStep(std::span<Vehicle* const> some);
  void stepVehicle(Vehicle& vehicle, double h);
  void collectWalls(Vehicle& vehicle, const VehicleState& state, const PlanarMotion& motion,
                    bool guarded, double h);
  void leaveOutPassages(Vehicle& vehicle);
  PlanarMotion answerCuts(Vehicle& vehicle, const VehicleState& state, const PlanarMotion& motion,
                          double h);
  void addGuards(Vehicle& vehicle, const VehicleState& state, const PlanarMotion& motion,
                 const PlanarMotion& after, double h);
  void answerContacts(Vehicle& vehicle, const VehicleState& state, PlanarMotion motion, double h);
  void give(Vehicle& vehicle, const VehicleState& state, double h);
  [[nodiscard]] static ImpactEvent eventAt(const Vehicle& vehicle, const Barrier& barrier, int wall,
                                           const Eigen::Vector3d& contact,
                                           const Eigen::Vector3d& normal);
  void reportLoads(Vehicle& vehicle, const VehicleState& state);
  void report(Vehicle& vehicle, const VehicleState& state, const Barrier& barrier, int wall,
              const StepImpact& each);
  void endContacts(Vehicle& vehicle);
};

}  // namespace bumper
