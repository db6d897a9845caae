#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "barrier.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/collision_step.h"
#include "ode_handles.h"
#include "registered_vehicle.h"
#include "warnings.h"
#include "world_clock.h"

namespace bumper {

inline int idOf(const Barrier& barrier) { return barrier.id().value; }
inline int idOf(const Vehicle& vehicle) { return vehicle.memory.vehicle.value; }

/// The one with that id among things in the order of their ids; null if there is none.
template <typename Thing>
Thing* find(const std::vector<std::unique_ptr<Thing>>& things, int id) {
  const auto found =
      std::lower_bound(things.begin(), things.end(), id,
                       [](const auto& each, int wanted) { return idOf(*each) < wanted; });
  return found != things.end() && idOf(**found) == id ? found->get() : nullptr;
}

struct Responder::Implementation {
  dWorldID world = nullptr;
  ResponderOptions options;

  // In the order of their ids. These are given once, so that none ever means another thing.
  std::vector<std::unique_ptr<Barrier>> barriers;
  std::vector<std::unique_ptr<Vehicle>> vehicles;
  int nextBarrier = 0;
  int nextVehicle = 0;
  std::unordered_map<dGeomID, const Barrier*> barrierOfGeom;
  std::unordered_map<dBodyID, const Vehicle*> vehicleOfBody;
  Warnings warnings;

  double time = 0.0;
  double lastStep = 0.0;
  unsigned issues = step_issue::none;
  std::vector<ImpactEvent> events;

  double longestPenetrationTime = 0.0;  // of all barriers, s

  std::optional<WorldClock> clock;  // as long as there are vehicles
  OwnJointGroup guardJoints{dJointGroupCreate(0)};
  bool hasGuards = false;  // the group has joints

  // Scratch memory, kept from step to step.
  CollisionStep collision;
  std::vector<Vehicle*> active;  // a place for every vehicle

  /// Invalidates the known surroundings of vehicles.
  void forgetSurroundings();

  /// The step of those vehicles that are not certainly away from all walls.
  void stepAll(std::span<Vehicle* const> some, double h);
  /// Corrects deliveries that the world's last step did not carry out as expected.
  void checkLastStep(std::span<Vehicle* const> some);
  void read(Vehicle& vehicle, double h);
  void collectWalls(Vehicle& vehicle, double h);
  void solve(Vehicle& vehicle, double h);
  void addGuards(Vehicle& vehicle, const PlanarMotion& after, double h);
  void deliver(Vehicle& vehicle, double h);

  /// Excludes from the walls nearby those that the vehicle passes through.
  void applyPassableWalls(Vehicle& vehicle) const;

  [[nodiscard]] static ImpactEvent eventAt(const Vehicle& vehicle, const Barrier& barrier, int wall,
                                           const Eigen::Vector3d& contact,
                                           const Eigen::Vector3d& normal);
  void reportLoads(Vehicle& vehicle);
  void reportImpact(Vehicle& vehicle, const Barrier& barrier, int wall, const StepImpact& each);
  void reportEndedContacts(Vehicle& vehicle);
};

}  // namespace bumper
