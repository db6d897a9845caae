#pragma once

#include <ode/ode.h>

#include <optional>
#include <span>
#include <string>

#include "bumper/base/api.h"
#include "bumper/engine_adapter/world_axes.h"
#include "bumper/response/response_settings.h"
#include "bumper/response/vehicle_parameters.h"

namespace BUMPER_API bumper {

/// Names a vehicle of one responder.
struct VehicleId {
  int value = -1;
  bool operator==(const VehicleId&) const = default;
};

/// The heights above the ground, in the world's length unit, measured along the vehicle's z axis,
/// at which walls hit the outline. Whatever lies lower (kerbs) or higher (bridges) stays ODE's.
struct Band {
  double bottom = 0.0;
  double top = 0.0;
};

/// 0.3 m to 0.2 m above the mass centre; for a very low mass centre from half its height. Of
/// parameters in metres.
Band defaultBand(const VehicleParameters& vehicle);

/// The paper's plate at mass-centre height, likewise.
Band plateBand(const VehicleParameters& vehicle);

/// How two vehicles of one responder respond to each other.
struct PairOptions {
  /// False: their contacts are ODE's, as if one of them were not registered.
  bool collide = true;
  /// Empty: ResponderOptions::vehicleResponse.
  std::optional<ResponseSettings> response{};
};

/// Who moves a vehicle.
enum class Mover {
  world,  ///< this responder's world: walls and other vehicles act on it
  /// The application, whatever it hits: a gate, a train, a lift, a car on rails. Others are hit by
  /// it as by a body of infinite mass.
  application,
  /// Another host or engine, which answers for its walls and applies its share of an impact of two:
  /// the opposite of the one here. The law takes its mass and yaw inertia from the parameters. Both
  /// hosts get the same result if both start from the same two states.
  other_host
};

struct VehicleOptions {
  /// The name in events; empty: "vehicle <number>".
  std::string name{};
  /// One that this world does not move gets no force here, and meets no barrier: its body, best a
  /// kinematic one, has the pose and velocity that the application gives it before each step().
  Mover mover = Mover::world;
  /// Bodies that move with the chassis as one, such as wheels on joints. They share every impulse
  /// as parts of one rigid body would. A trailer is a vehicle of its own. Copied by addVehicle.
  std::span<const dBodyID> linkedBodies{};
  /// Default: defaultBand() of the parameters, or plateBand() if the responder follows
  /// Method::paper.
  std::optional<Band> band{};
  /// Beyond this angle between the vehicle's z axis and the vertical, rad, in (0, π/2), Bumper
  /// leaves the vehicle's contacts to ODE: it is rolling over.
  double tiltLimit = 0.5235987755982988;  // 30°
  /// Sets ODE's finite rotation mode on the bodies. With ODE's usual rotation update yaw angles are
  /// off by (yaw rate · h)³ / 12 in each step; with this one, impacts are exact to rounding.
  bool finiteRotation = false;
  /// Which way the chassis points in its own frame: x forward and z up, unless it was modelled in
  /// another way. In a world where y is up, y usually is for the chassis too.
  ChassisAxes axes{};
};

/// The parameters of a vehicle whose mass and yaw inertia are those of its ODE bodies, about their
/// common mass centre. All in the world's length unit. Throws Error on a null body or invalid axes.
VehicleParameters parametersFromBodies(dBodyID chassis, std::span<const dBodyID> linkedBodies,
                                       double massCentreToFront, double massCentreToRear,
                                       double width, double massCentreHeight,
                                       const ChassisAxes& axes = {});

/// The same with an outline that encloses the bodies' geoms as they lie now, at whatever height.
/// The width is twice the distance from the mass centre to the farther side. Boxes, spheres,
/// capsules, cylinders, convexes, trimeshes and geom transforms are measured; heightfields and
/// classes of the application's own cannot be, nor a convex in a geom transform, and are left out,
/// as are rays and geoms without category and collide bits. Throws Error on a null body, if nothing
/// can be measured, or if the mass centre does not lie between the geoms' ends.
VehicleParameters parametersFromGeoms(dBodyID chassis, std::span<const dBodyID> linkedBodies,
                                      double massCentreHeight, const ChassisAxes& axes = {});

}  // namespace bumper
