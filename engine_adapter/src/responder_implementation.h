#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barrier.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/collision_step.h"
#include "bumper/response/island_step.h"
#include "ode_handles.h"
#include "registered_vehicle.h"
#include "space_barriers.h"
#include "traffic.h"
#include "warnings.h"
#include "world_clock.h"
#include "world_frame.h"

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

/// Two vehicles that may touch in a step, in the order of their island.
struct Meeting {
  Vehicle* first = nullptr;
  Vehicle* second = nullptr;
  PairFrame firstFrame;
  PairFrame secondFrame;
  bool isIn = false;  ///< it belongs to an island
};

struct BUMPER_HIDDEN Responder::Implementation {
  dWorldID world = nullptr;
  ResponderOptions options;
  WorldFrame worldFrame;
  bool anyCopied = false;  // a vehicle's numbers are not ODE's own

  // In the order of their ids. These are given once, so that none ever means another thing.
  std::vector<std::unique_ptr<Barrier>> barriers;
  std::vector<std::unique_ptr<Vehicle>> vehicles;
  std::vector<std::unique_ptr<BarrierSpace>> spaces;
  std::vector<Barrier*> movingBarriers;  // a place for every barrier
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

  std::map<std::pair<int, int>, PairOptions> pairOptions;  // by the lower id and the higher

  // Scratch memory, kept from step to step.
  CollisionStep collision;
  std::vector<Vehicle*> active;  // a place for every vehicle
  std::size_t activeCount = 0;
  Traffic traffic;
  std::vector<Traveller*> travellers;
  std::vector<Meeting> meetings;
  std::vector<Vehicle*> inIslands;
  IslandStep islands;
  std::vector<IslandMember> islandMembers;
  std::vector<IslandPair> islandPairs;
  std::vector<const Meeting*> islandMeetings;
  std::vector<StepOutcome> islandOutcomes;

  /// Throws Error if a barrier's settings are invalid.
  void requireValid(const BarrierOptions& given) const;

  /// Invalidates the known surroundings of vehicles.
  void forgetSurroundings();

  [[nodiscard]] std::span<Vehicle* const> activeNow() const { return {active.data(), activeCount}; }
  /// Whether any two vehicles may respond to each other.
  [[nodiscard]] bool hasPairs() const {
    return vehicles.size() > 1 && options.response.method == Method::bumper &&
           (options.vehiclesCollide || !pairOptions.empty());
  }

  // In worlds with other axes or units alone, and out of step()'s way in others.
  [[gnu::noinline]] void refreshCopies() const;  ///< of the bodies' numbers
  [[gnu::noinline]] void tellInWorld();          ///< the events
  /// The step of those vehicles that are not certainly away from all walls and other vehicles.
  void stepAll(std::span<Vehicle* const> some, double h);
  /// Corrects deliveries that the world's last step did not carry out as expected.
  void checkLastStep(std::span<Vehicle* const> some);
  void read(Vehicle& vehicle, double h);
  void readMovingBarriers();
  /// Whether a barrier that moves may meet it in the step, or is near enough to be guarded.
  [[nodiscard]] bool mayMeetMovingBarrier(Vehicle& vehicle, double h) const;
  void collectWalls(Vehicle& vehicle, double h);
  void solve(Vehicle& vehicle, double h);
  void applyOutcome(Vehicle& vehicle, const StepOutcome& outcome, double h);
  /// Within this distance, m, a wall's contacts are guarded in a step.
  [[nodiscard]] static double guardedDistance(const Vehicle& vehicle, double h);
  void addGuards(Vehicle& vehicle, std::span<const SpeculativeContact> contacts, double h);
  static void pushBack(const Barrier& barrier, const Vehicle& vehicle, const StepImpact& each,
                       double h);

  /// Null: they do not respond to each other.
  [[nodiscard]] const ResponseSettings* settingsOfPair(const Vehicle& a, const Vehicle& b) const;
  /// Whether their contacts can be Bumper's.
  [[nodiscard]] bool mayMeet(const Vehicle& a, const Vehicle& b) const;
  void findCompany(double h);
  void findIslands(double h);
  void joinIsland(const Meeting& meeting);
  void mergeIslands();
  void solveIslands(double h);
  void solveIsland(std::span<Vehicle* const> members, double h);
  void addPairGuards(const Meeting& meeting, const StepOutcome& first, const StepOutcome& second,
                     double h);
  void applyPairImpact(const Meeting& meeting, const PairImpact& each, double h);
  void reportPairImpact(const Meeting& meeting, const PairImpact& each);
  static std::pair<Vehicle*, Vehicle*> inOrderOfIds(Vehicle& a, Vehicle& b);
  [[nodiscard]] VehicleHit* hitBetween(Vehicle& a, Vehicle& b) const;
  [[nodiscard]] bool isPassing(Vehicle& a, Vehicle& b) const;
  [[nodiscard]] bool isNear(const Vehicle& vehicle, const ContactPartner& with) const;
  [[nodiscard]] static bool isNear(const Vehicle& a, const Vehicle& b);

  void deliver(Vehicle& vehicle, double h);

  /// Excludes from the walls nearby those that the vehicle passes through.
  void applyPassableWalls(Vehicle& vehicle) const;

  [[nodiscard]] const Vehicle& vehicleAt(const ContactPartner& with) const;
  [[nodiscard]] const ResponseSettings& settingsOf(const ContactPartner& with, int wall) const;
  [[nodiscard]] ImpactEvent eventWith(const Vehicle& vehicle, const ContactPartner& with, int wall,
                                      const Eigen::Vector3d& contact,
                                      const Eigen::Vector3d& normal) const;
  void reportLoads(Vehicle& vehicle);
  void reportImpact(Vehicle& vehicle, const Barrier& barrier, int wall, const StepImpact& each);
  void reportEndedContacts(Vehicle& vehicle);
};

}  // namespace bumper
