#pragma once

#include <ode/ode.h>

#include <Eigen/Core>

#include "bumper/engine_adapter/world_axes.h"
#include "ode_vectors.h"
#include "turn.h"

namespace bumper {

/// An ODE world as seen from within Bumper, where z is up and lengths are metres. Everything that
/// is read from ODE or the application goes through here, and back through the functions named
/// `…InWorld`. A usual world, z up and in metres, is left as it is to the last bit.
class WorldFrame {
 public:
  WorldFrame() = default;
  /// Throws Error as validate() does.
  explicit WorldFrame(const WorldAxes& axes);

  /// The world's own axes and unit are Bumper's.
  [[nodiscard]] bool isUsual() const { return isUsual_; }
  /// Length units of the world in a metre.
  [[nodiscard]] double metre() const { return metre_; }
  [[nodiscard]] const Turn& turn() const { return turn_; }

  /// A unit vector, or an angular velocity.
  [[nodiscard]] Eigen::Vector3d direction(const Eigen::Vector3d& v) const { return turn_(v); }
  /// A place, velocity, acceleration, force or linear impulse.
  [[nodiscard]] Eigen::Vector3d vector(const Eigen::Vector3d& v) const {
    return isUsual_ ? v : Eigen::Vector3d(turn_(v) / metre_);
  }
  [[nodiscard]] Eigen::Vector3d torque(const Eigen::Vector3d& v) const {
    return isUsual_ ? v : Eigen::Vector3d(turn_(v) / (metre_ * metre_));
  }
  [[nodiscard]] Scene scene(const Scene& world) const;

  [[nodiscard]] Eigen::Vector3d directionInWorld(const Eigen::Vector3d& v) const {
    return turn_.back(v);
  }
  [[nodiscard]] Eigen::Vector3d vectorInWorld(const Eigen::Vector3d& v) const {
    return isUsual_ ? v : Eigen::Vector3d(turn_.back(v) * metre_);
  }
  [[nodiscard]] Eigen::Vector3d torqueInWorld(const Eigen::Vector3d& v) const {
    return isUsual_ ? v : Eigen::Vector3d(turn_.back(v) * (metre_ * metre_));
  }
  [[nodiscard]] ImpactEvent event(const ImpactEvent& world) const;
  [[nodiscard]] ImpactEvent eventInWorld(const ImpactEvent& own) const;

 private:
  Turn turn_;  // from the world's axes
  double metre_ = 1.0;
  bool isUsual_ = true;
};

/// From a chassis' own axes to forward, left, up. Throws Error as validate() does.
Turn turnOf(const ChassisAxes& axes);

}  // namespace bumper
