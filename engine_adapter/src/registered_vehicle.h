#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bumper/engine_adapter/responder.h"
#include "envelope.h"
#include "free_space.h"
#include "guard_contacts.h"
#include "nearby_walls.h"
#include "traffic.h"
#include "vehicle_bodies.h"

namespace bumper {

/// So that a step need not allocate.
inline void keepRoom(VehicleMemory& memory) {
  memory.passable.reserve(4);
  memory.contacts.reserve(4);
  memory.hits.reserve(8);
}

/// A registered vehicle: its data, its surroundings, and its state kept from step to step.
struct Vehicle {
  Vehicle(VehicleId id, const VehicleParameters& itsParameters, const Band& band, double tiltLimit,
          std::string itsName, VehicleBodies itsBodies, Mover itsMover)
      : parameters(itsParameters),
        name(std::move(itsName)),
        bodies(std::move(itsBodies)),
        mover(itsMover),
        minUprightness(std::cos(tiltLimit)),
        envelope(itsParameters, band),
        freeSpace(bodies, envelope, minUprightness),
        guards(bodies.frame()) {
    traveller.vehicle = this;
    const BodyNumbers& chassis = bodies.numbers().front();
    traveller.position = chassis.position;
    traveller.rotation = chassis.rotation;
    traveller.velocity = chassis.velocity;
    traveller.turning = chassis.turning;
    traveller.force = chassis.force;
    traveller.forceAllowed = Traffic::accelerationAllowed * itsParameters.mass;
    const VehiclePose pose = bodies.readPose();
    const dReal* at = traveller.position;
    const Eigen::Vector3d away = pose.massCentre - Eigen::Vector3d(at[0], at[1], at[2]);
    traveller.massCentre = (pose.axes.transpose() * away).head<2>();
    traveller.outline = envelope.outline();
    traveller.radius = envelope.outline().radius() + away.norm();
    for (VehicleMemory* each : {&memory, &memoryBefore}) {
      each->vehicle = id;
      keepRoom(*each);
    }
  }
  ~Vehicle() = default;
  Vehicle(const Vehicle&) = delete;
  Vehicle& operator=(const Vehicle&) = delete;
  Vehicle(Vehicle&&) = delete;
  Vehicle& operator=(Vehicle&&) = delete;

  /// Its state as read before anything is solved in a step.
  struct Reading {
    /// If false the rest is meaningless: it is left alone, or certainly away from all walls.
    bool takesPart = false;
    VehicleState state;
    /// In its own axes, as it would be in this step without walls.
    PlanarMotion motion;
    /// Joints act on it too, and it may get guard contacts.
    bool isHeld = false;
    /// ODE has put it to sleep; it takes part because another vehicle may wake it.
    bool isAsleep = false;
  };

  VehicleParameters parameters;
  std::string name;
  VehicleBodies bodies;
  Mover mover;
  double minUprightness;
  Envelope envelope;
  FreeSpace freeSpace;
  NearbyWalls nearby;
  GuardContacts guards;
  Reading reading;
  VehicleMemory memory;
  VehicleMemory memoryBefore;  // as it was before the last step()
  unsigned issues = step_issue::none;

  // Of this step.
  Traveller traveller;
  bool isFar = false;       ///< certainly away from all walls
  bool isAlone = true;      ///< certainly away from all other vehicles
  bool isActive = false;    ///< … not both
  bool hasCompany = false;  ///< another vehicle may meet it
  /// No barrier that moves and may meet it is faster, m/s; negative: none may.
  double barrierSpeed = -1.0;
  bool isHit = false;    ///< by another vehicle
  int island = -1;       ///< its number; −1: none
  int islandPlace = -1;  ///< its place among the island's members

  /// False also where the rotation is not finite.
  [[nodiscard]] bool isUpright() const { return bodies.uprightness() >= minUprightness; }

  /// By its yaw rate no point of the outline moves faster about the mass centre, m/s.
  [[nodiscard]] double turningSpeed() const {
    return std::abs(reading.motion.yawRate) * envelope.outline().radius();
  }

  /// The parameters for the law: the outline as given, mass and inertia of the bodies when last
  /// read.
  [[nodiscard]] VehicleParameters parametersNow() const {
    VehicleParameters result = parameters;
    if (mover == Mover::other_host) return result;
    if (mover == Mover::application) {
      result.mass = result.yawInertia = std::numeric_limits<double>::infinity();
      return result;
    }
    result.mass = reading.state.mass;
    result.yawInertia = reading.state.yawInertia;
    return result;
  }
};

}  // namespace bumper
