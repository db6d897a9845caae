#pragma once

#include <ode/ode.h>

#include <cmath>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barrier.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/collision_step.h"
#include "vehicle_bodies.h"
#include "wall_query.h"

namespace bumper {

/// Where a vehicle was when no wall was near, and how far it can come from there.
struct ClearPlace {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  double distance = 0.0;  ///< m; 0: there is a wall, or it is not known
  int stepsUntilLook = 0;
};

struct Vehicle {
  Vehicle(VehicleId id, const VehicleParameters& itsParameters, const Band& band, double tiltLimit,
          std::string itsName, VehicleBodies itsBodies)
      : parameters(itsParameters),
        name(std::move(itsName)),
        bodies(std::move(itsBodies)),
        query(itsParameters, band),
        minUprightness(std::cos(tiltLimit)) {
    memory.vehicle = id;
    memory.passages.reserve(4);
    memory.contacts.reserve(4);
    memoryBefore = memory;
  }

  VehicleParameters parameters;
  std::string name;
  VehicleBodies bodies;
  WallQuery query;
  double minUprightness;
  VehicleMemory memory;
  VehicleMemory memoryBefore;  // as it was before the last step()
  ClearPlace clear;
  unsigned issues = step_issue::none;

  /// False also where the rotation is not finite.
  [[nodiscard]] bool isUpright() const { return uprightness(bodies.chassis()) >= minUprightness; }
};

/// A vehicle's geom and a barrier's.
struct OwnedPair {
  const Vehicle* vehicle = nullptr;
  const Barrier* barrier = nullptr;
  explicit operator bool() const { return vehicle != nullptr; }
};

struct Responder::Implementation {
  dWorldID world = nullptr;
  ResponderOptions options;

  // Removed ones leave an empty place, so that an id never means another thing later.
  std::vector<std::unique_ptr<Barrier>> barriers;
  std::vector<std::unique_ptr<Vehicle>> vehicles;
  std::unordered_map<dGeomID, const Barrier*> barrierOfGeom;
  std::unordered_map<dBodyID, const Vehicle*> vehicleOfBody;
  std::vector<std::string> warnings;

  double time = 0.0;
  double lastStep = 0.0;
  unsigned issues = step_issue::none;
  std::vector<ImpactEvent> events;

  double longestPenetrationTime = 0.0;  // of all barriers there ever were, s

  // Scratch memory, kept from step to step.
  CollisionStep collision;
  std::vector<WallSegment> segments;
  std::vector<int> firstIds;  // of each barrier's walls among the segments' ids

  /// The pair in either order, if Bumper may own contacts of it.
  [[nodiscard]] OwnedPair pairOf(dGeomID a, dGeomID b) const;

  void reconsiderLastStep();
  void stepVehicle(Vehicle& vehicle, double h);
  void collectWalls(Vehicle& vehicle, const VehicleState& state, const PlanarMotion& motion,
                    double h);
  bool isFarFromWalls(Vehicle& vehicle, const VehicleState& state, double reach);
  void forgetClearPlaces();
  void leaveOutPassages(Vehicle& vehicle);
  void answerCuts(Vehicle& vehicle, const VehicleState& state, const PlanarMotion& motion,
                  double h);
  void answerContacts(Vehicle& vehicle, const VehicleState& state, PlanarMotion motion, double h);
  void give(Vehicle& vehicle, const VehicleState& state, double h);
  void report(Vehicle& vehicle, const VehicleState& state, const Barrier& barrier, int wall,
              const StepImpact& each);
  void endContacts(Vehicle& vehicle);
};

}  // namespace bumper
