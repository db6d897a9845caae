#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <array>

#include "bumper/engine_adapter/vehicle.h"

namespace bumper::tests {

/// A car as ODE games build one: a box chassis and four spherical wheels on hinge2 joints.
class Hinge2Car {
 public:
  static constexpr double wheelRadius = 0.32;
  static constexpr double front = 2.1;  // chassis centre to bumper
  static constexpr double rear = 2.1;
  static constexpr double width = 1.8;
  static constexpr double height = 0.6;

  /// The wheels touch the ground z = groundHeight at the given place.
  Hinge2Car(dWorldID world, dSpaceID space, const Eigen::Vector2d& place, double groundHeight,
            double yaw, double speed);
  ~Hinge2Car();
  Hinge2Car(const Hinge2Car&) = delete;
  Hinge2Car& operator=(const Hinge2Car&) = delete;
  Hinge2Car(Hinge2Car&&) = delete;
  Hinge2Car& operator=(Hinge2Car&&) = delete;

  /// Drives all wheels towards a rolling speed, m/s.
  void drive(double speed, double maxTorque);

  [[nodiscard]] VehicleParameters parameters() const;
  [[nodiscard]] static double mass();
  [[nodiscard]] Eigen::Vector3d massCentre() const;
  [[nodiscard]] Eigen::Vector3d velocity() const;  ///< of the common mass centre

  dBodyID chassis = nullptr;
  dGeomID box = nullptr;
  std::array<dBodyID, 4> wheels{};
  std::array<dGeomID, 4> tyres{};
  std::array<dJointID, 4> axles{};
};

}  // namespace bumper::tests
