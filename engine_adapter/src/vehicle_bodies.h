#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <utility>
#include <vector>

#include "bumper/engine_adapter/vehicle.h"
#include "bumper/response/force_pulse.h"

namespace bumper {

/// Where a vehicle is.
struct VehiclePose {
  Eigen::Vector3d massCentre;  ///< world
  Eigen::Matrix3d axes;        ///< columns: forward, left, up in the world

  [[nodiscard]] Eigen::Vector3d up() const { return axes.col(2); }
};

/// A vehicle's bodies at one instant, as one rigid body.
struct VehicleState : VehiclePose {
  Eigen::Vector3d velocity;  ///< of the mass centre, world
  double yawRate = 0.0;      ///< of the chassis about its own z axis
  double mass = 0.0;
  double yawInertia = 0.0;  ///< about the chassis' z axis through the mass centre
  /// What the forces already added to the bodies, and gravity, will change within the step.
  Eigen::Vector3d acceleration;
  double yawAcceleration = 0.0;

  [[nodiscard]] bool isFinite() const;
  [[nodiscard]] Eigen::Vector3d toWorld(const Vector2& inYawPlane) const {
    return axes.leftCols<2>() * inYawPlane;
  }
  /// Of the point at `arm` from the mass centre, turning about the z axis alone.
  [[nodiscard]] Eigen::Vector3d velocityAt(const Eigen::Vector3d& arm) const {
    return velocity + yawRate * up().cross(arm);
  }
};

/// The chassis and its linked bodies: reads their common state, and moves them as one.
class VehicleBodies {
 public:
  /// The first body is the chassis.
  explicit VehicleBodies(std::vector<dBodyID> bodies) : bodies_(std::move(bodies)) {}

  [[nodiscard]] dBodyID chassis() const { return bodies_.front(); }
  [[nodiscard]] std::span<const dBodyID> all() const { return bodies_; }
  [[nodiscard]] VehicleState read() const;
  [[nodiscard]] VehiclePose readPose() const;
  /// Whether ODE has put all of them to sleep.
  [[nodiscard]] bool areAsleep() const;
  /// Whether no force moves one of them.
  [[nodiscard]] bool anyKinematic() const;

  /// Adds forces and torques that give every body its share of the force at the common mass centre
  /// and of the moment about the chassis' z axis, as parts of one rigid body: no roll, no pitch, no
  /// load on the joints. `force` is in the yaw plane, in the vehicle's axes.
  void push(const VehicleState& state, const PlanarForce& force) const;

  /// The same as changes of velocity, at once.
  void changeVelocity(const VehicleState& state, const PlanarImpulse& impulse) const;

 private:
  std::vector<dBodyID> bodies_;
};

/// Cosine of the angle between the chassis' z axis and the vertical.
inline double uprightness(dBodyID chassis) { return dBodyGetRotation(chassis)[10]; }

}  // namespace bumper
