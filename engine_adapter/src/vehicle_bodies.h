#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "bumper/engine_adapter/vehicle.h"
#include "bumper/response/force_pulse.h"
#include "ode_vectors.h"
#include "turn.h"
#include "world_frame.h"

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

/// Where the numbers of a body are: in ODE, and these addresses do not change while the body lives.
/// Where world or chassis have other axes or another unit than Bumper, in copies that have its own.
struct BodyNumbers {
  const dReal* position;
  const dReal* rotation;
  const dReal* velocity;
  const dReal* turning;
  const dReal* force;
  const dReal* torque;
};

/// The chassis and its linked bodies: reads their common state, and moves them as one. Here the
/// world's numbers become Bumper's, and Bumper's forces the world's.
class VehicleBodies {
 public:
  /// The first body is the chassis; `axes` leads from its own axes to forward, left, up. The others
  /// are seen in axes turned alike.
  explicit VehicleBodies(std::vector<dBodyID> bodies, WorldFrame frame = {}, Turn axes = {});

  [[nodiscard]] dBodyID chassis() const { return bodies_.front(); }
  [[nodiscard]] std::span<const dBodyID> all() const { return bodies_; }
  [[nodiscard]] const WorldFrame& frame() const { return frame_; }

  /// Of all bodies, as of the last refresh() or read(), if they are copies.
  [[nodiscard]] std::span<const BodyNumbers> numbers() const { return numbers_; }
  [[nodiscard]] bool areCopied() const { return copies_ != nullptr; }
  void refresh() const;

  /// Of the chassis.
  [[nodiscard]] Eigen::Vector3d position() const { return positionOf(chassis()); }
  [[nodiscard]] Eigen::Vector3d velocity() const { return velocityOf(chassis()); }
  [[nodiscard]] Eigen::Matrix3d axes() const { return axesOf(chassis()); }
  /// Cosine of the angle between its z axis and the vertical.
  [[nodiscard]] double uprightness() const {
    return areCopied() ? axes()(2, 2) : dBodyGetRotation(chassis())[10];
  }
  /// From its axes to the world's.
  [[nodiscard]] Eigen::Quaterniond orientationInWorld() const;

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
  struct Copy {
    dVector3 position{};
    dMatrix3 rotation{};
    dVector3 velocity{};
    dVector3 turning{};
    dVector3 force{};
    dVector3 torque{};
  };

  [[nodiscard]] Eigen::Vector3d positionOf(dBodyID body) const {
    return frame_.vector(toVector(dBodyGetPosition(body)));
  }
  [[nodiscard]] Eigen::Vector3d velocityOf(dBodyID body) const {
    return frame_.vector(toVector(dBodyGetLinearVel(body)));
  }
  [[nodiscard]] Eigen::Matrix3d axesOf(dBodyID body) const {
    const Eigen::Matrix3d rotation = toMatrix(dBodyGetRotation(body));
    return areCopied() ? axes_.ofRows(frame_.turn().ofColumns(rotation)) : rotation;
  }
  /// In the axes of axesOf().
  [[nodiscard]] Eigen::Matrix3d inertiaOf(const dMass& mass) const;

  std::vector<dBodyID> bodies_;
  WorldFrame frame_;
  Turn axes_;
  std::unique_ptr<Copy[]> copies_;  // null in a usual world
  std::vector<BodyNumbers> numbers_;
};

}  // namespace bumper
