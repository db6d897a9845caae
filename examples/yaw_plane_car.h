#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <array>

#include "bumper/response/vehicle_parameters.h"

namespace bumper::examples {

/// The paper's vehicle in the examples: front-left to rear-right tyres at the corners of a
/// wheelbase, linear in the slip angle up to a friction limit.
struct YawPlaneCarDesign {
  VehicleParameters body{.mass = 1500.0,
                         .yawInertia = 2600.0,
                         .massCentreToFront = 2.1,
                         .massCentreToRear = 2.5,
                         .width = 1.8,
                         .massCentreHeight = 0.55};
  double massCentreToFrontAxle = 1.15;  ///< m
  double massCentreToRearAxle = 1.55;   ///< m
  double track = 1.5;                   ///< m
  double corneringStiffness = 30000.0;  ///< N/rad, each tyre
  double tyreFriction = 0.85;           ///< force limit of a tyre over what it carries
};

/// A car on one ODE box body. Tyre forces act in the yaw plane at mass-centre height, so they
/// neither roll nor pitch it: on flat ground, in a world without gravity, it stays in its plane.
class YawPlaneCar {
 public:
  /// Places the mass centre at `position`, heading along `yaw` (rad from world x), rolling at
  /// `speed` m/s. The geom is made in `space`, which may be null.
  YawPlaneCar(dWorldID world, dSpaceID space, const YawPlaneCarDesign& design,
              const Eigen::Vector3d& position, double yaw, double speed);
  ~YawPlaneCar();
  YawPlaneCar(const YawPlaneCar&) = delete;
  YawPlaneCar& operator=(const YawPlaneCar&) = delete;
  YawPlaneCar(YawPlaneCar&&) = delete;
  YawPlaneCar& operator=(YawPlaneCar&&) = delete;

  /// Angle of the front wheels, rad, positive to the left.
  void steer(double angle) { steering_ = angle; }
  /// Force of the driven rear wheels, N, negative for braking; limited by the tyres.
  void drive(double force) { driveForce_ = force; }

  /// What each tyre carries, N; the static loads unless a suspension says otherwise.
  void load(const std::array<double, 4>& loads) { loads_ = loads; }

  /// Adds this step's tyre forces to the body.
  void addTyreForces();

  [[nodiscard]] dBodyID body() const { return body_; }
  [[nodiscard]] dGeomID geom() const { return geom_; }
  [[nodiscard]] const YawPlaneCarDesign& design() const { return design_; }

  [[nodiscard]] Eigen::Vector3d position() const;
  [[nodiscard]] Eigen::Vector3d velocity() const;
  [[nodiscard]] Eigen::Matrix3d axes() const;  ///< columns: forward, left, up
  [[nodiscard]] double yawRate() const;        ///< about the body's z axis, rad/s
  [[nodiscard]] double forwardSpeed() const;   ///< m/s

  /// Wheel positions in the body's yaw plane: front left, front right, rear left, rear right.
  [[nodiscard]] std::array<Eigen::Vector2d, 4> wheels() const;

 private:
  YawPlaneCarDesign design_;
  dBodyID body_;
  dGeomID geom_;
  double steering_ = 0.0;
  double driveForce_ = 0.0;
  std::array<double, 4> loads_{};
};

}  // namespace bumper::examples
