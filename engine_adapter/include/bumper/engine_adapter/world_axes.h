#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "bumper/base/api.h"
#include "bumper/response/impact_event.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// The axes and the length unit of an ODE world, which is right-handed.
///
/// Places, velocities, forces, scenes, a vehicle's parameters and band, and events are in the
/// world's axes and unit: in one of centimetres a speed is in cm/s, a force in kg cm/s², a yaw
/// inertia in kg cm². What settings state in metres (ResponseSettings, WallSelection, WallReport)
/// stays in metres, so that their defaults hold in every world.
struct WorldAxes {
  /// Up, unit to 1e-6. An axis of the world (±x, ±y, ±z) costs no rounding.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  /// So many of the world's length units make a metre: 100 in a world of centimetres. Finite,
  /// positive.
  double metre = 1.0;
};

/// The axes of a chassis body, in its own frame. Unit and perpendicular, both to 1e-6.
struct ChassisAxes {
  Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

/// Throw Error, naming the value.
void validate(const WorldAxes& axes);
void validate(const ChassisAxes& axes);

/// The same in metres with z up, for recordings and pictures, which know no other axes: a place or
/// velocity, the orientation of Responder::orientation(), a scene, an event. An axis of the world
/// that is up becomes z without rounding, the others follow in turn (y up: z becomes x, x becomes
/// y); any other direction becomes z by the smallest rotation. They throw Error if the axes are
/// invalid.
Eigen::Vector3d zUp(const Eigen::Vector3d& vector, const WorldAxes& axes);
Eigen::Quaterniond zUp(const Eigen::Quaterniond& orientation, const WorldAxes& axes);
Scene zUp(const Scene& scene, const WorldAxes& axes);
ImpactEvent zUp(const ImpactEvent& event, const WorldAxes& axes);

}  // namespace bumper
