#pragma once

#include <ode/ode.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barrier_mesh.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/collision_step.h"
#include "vehicle_bodies.h"
#include "wall_query.h"

namespace bumper {

struct Barrier {
  template <typename Source>
  Barrier(const Source& source, const BarrierOptions& options, std::string name,
          BarrierMesh::Query query, const ResponseSettings& usual)
      : mesh(source, options, std::move(name), query),
        own(options.response),
        settings(own ? &*own : &usual) {}

  BarrierMesh mesh;
  std::optional<ResponseSettings> own;
  /// Its own or the responder's: barriers with the same settings form one wall where they meet.
  const ResponseSettings* settings;
};

/// Learns what acts on a vehicle besides the forces that are known before a step, joints above all:
/// the difference between the last step's outcome and what it should have been.
class UnknownForces {
 public:
  /// Adds the last step's unknown accelerations to the state's; they rarely change within a step.
  void foresee(VehicleState& state) const;
  /// What the coming step should do by the known forces and the impulse in the vehicle's frame.
  void expect(const VehicleState& known, const PlanarImpulse& impulse, double h);
  /// The vehicle's motion is no longer its own.
  void forget() { step_ = 0.0; }

 private:
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  double yawRate_ = 0.0;
  double step_ = 0.0;  // 0: nothing is expected
};

struct Vehicle {
  Vehicle(const VehicleParameters& itsParameters, const Band& band, double tiltLimit,
          std::string itsName, VehicleBodies itsBodies)
      : parameters(itsParameters),
        name(std::move(itsName)),
        bodies(std::move(itsBodies)),
        query(itsParameters, band),
        minUprightness(std::cos(tiltLimit)) {}

  VehicleParameters parameters;
  std::string name;
  VehicleBodies bodies;
  WallQuery query;
  double minUprightness;
  UnknownForces unknown;
  std::vector<const Barrier*> brokenThrough;  // and not left yet
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
  unsigned issues = step_issue::none;
  std::vector<ImpactEvent> events;

  // Scratch memory, kept from step to step.
  CollisionStep collision;
  std::vector<WallSegment> segments;
  std::vector<int> firstIds;  // of each barrier's walls among the segments' ids

  /// The pair in either order, if Bumper may own contacts of it.
  [[nodiscard]] OwnedPair pairOf(dGeomID a, dGeomID b) const;

  void stepVehicle(Vehicle& vehicle, double h);
  void appendSegments(Vehicle& vehicle, const VehicleState& state, double reach,
                      const Barrier& barrier, int firstId);
  PlanarImpulse impulseOfCuts(Vehicle& vehicle, const VehicleState& state, double h);
  PlanarImpulse impulseOfContacts(Vehicle& vehicle, const VehicleState& state, double h);
  void report(const Vehicle& vehicle, const VehicleState& state, const Barrier& barrier, int wall,
              const Impact& impact, const ImpactResponse& response);
};

}  // namespace bumper
