#pragma once

#include <ode/ode.h>

#include <Eigen/Core>

#include "bumper/engine_adapter/saved_state.h"
#include "bumper/response/planar_motion.h"
#include "vehicle_bodies.h"
#include "world_frame.h"

namespace bumper {

/// Where the walls of a barrier are that moves: they were read once, in the world, and move as a
/// rigid body with the barrier's body or geom. Places and directions of that time are the frame's.
class BarrierFrame {
 public:
  /// The walls are read now, of a geom that may have a body.
  BarrierFrame(dGeomID geom, WorldFrame world);

  /// Whether they may ever be elsewhere than where they were read.
  [[nodiscard]] bool moves() const { return moves_; }
  /// The body that moves it; null if the application does, or nobody.
  [[nodiscard]] dBodyID body() const { return body_; }
  [[nodiscard]] const BarrierMotion& motion() const { return now_; }
  void restore(const BarrierMotion& motion);
  /// It stands still where it is, and never moved before.
  void stop();
  /// The walls were read anew, of a barrier that moved so far like this.
  void takeOver(const BarrierFrame& before);

  /// The geom may have another place or body than before, `time` seconds into the simulation, whose
  /// last step had a size of `lastStep`. Two such moves in successive steps have a velocity.
  void follow(dGeomID geom, double time, double lastStep);
  /// … and moves so in the coming step; in the world's axes and unit.
  void setVelocity(const BarrierVelocity& velocity, double time);
  /// Before a step: from the body. One that was not moved since the last step stands still.
  void read(double time);

  /// Of one that does not move the frame is the world, to the last bit.
  [[nodiscard]] Eigen::Vector3d toFrame(const Eigen::Vector3d& place) const;
  [[nodiscard]] Eigen::Vector3d toWorld(const Eigen::Vector3d& place) const;
  [[nodiscard]] Eigen::Vector3d directionToFrame(const Eigen::Vector3d& direction) const;
  [[nodiscard]] Eigen::Vector3d directionToWorld(const Eigen::Vector3d& direction) const;
  /// A vehicle as the walls see it.
  [[nodiscard]] VehiclePose toFrame(const VehiclePose& pose) const;
  [[nodiscard]] VehicleState toFrame(const VehicleState& state) const;

  /// In a vehicle's yaw plane, in its axes with the mass centre as origin.
  [[nodiscard]] PlanarMotion inYawPlane(const VehiclePose& vehicle) const;
  /// No point within `radius` of `place` moves faster with it, m/s.
  [[nodiscard]] double fastestWithin(const Eigen::Vector3d& place, double radius) const;

 private:
  WorldFrame world_;
  dBodyID body_ = nullptr;
  bool moves_ = false;
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();  // of the body or geom when the walls were read
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
  BarrierMotion now_;
  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Identity();  // from the frame to the world

  void place(dGeomID geom);
  void place(const dReal* position, const dReal* rotation);
};

}  // namespace bumper
