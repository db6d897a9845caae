#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "bumper/response/vehicle_parameters.h"

namespace bumper::tests {

/// One body without tyres or gravity: what Bumper does to it is all that happens to it.
class BoxCar {
 public:
  explicit BoxCar(dWorldID world, dSpaceID space = nullptr) : body(dBodyCreate(world)) {
    dMass mass;
    dMassSetParameters(&mass, parameters.mass, 0.0, 0.0, 0.0, 600.0, 2400.0, parameters.yawInertia,
                       0.0, 0.0, 0.0);
    dBodySetMass(body, &mass);
    dBodySetFiniteRotationMode(body, 1);
    geom = dCreateBox(space, 4.6, parameters.width, 0.7);
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, -0.2, 0.0, 0.0);
  }
  ~BoxCar() {
    dGeomDestroy(geom);
    dBodyDestroy(body);
  }
  BoxCar(const BoxCar&) = delete;
  BoxCar& operator=(const BoxCar&) = delete;
  BoxCar(BoxCar&&) = delete;
  BoxCar& operator=(BoxCar&&) = delete;

  void place(const Eigen::Vector3d& position, const Eigen::Matrix3d& axes) {
    dBodySetPosition(body, position.x(), position.y(), position.z());
    dMatrix3 rotation = {axes(0, 0), axes(0, 1), axes(0, 2), 0.0,        axes(1, 0), axes(1, 1),
                         axes(1, 2), 0.0,        axes(2, 0), axes(2, 1), axes(2, 2), 0.0};
    dBodySetRotation(body, rotation);
  }
  void move(const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular) {
    dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(body, angular.x(), angular.y(), angular.z());
  }
  [[nodiscard]] Eigen::Vector3d velocity() const {
    return Eigen::Map<const Eigen::Vector3d>(dBodyGetLinearVel(body));
  }
  [[nodiscard]] double massCentreHeight() const { return dBodyGetPosition(body)[2]; }
  [[nodiscard]] Eigen::Vector3d angularVelocity() const {
    return Eigen::Map<const Eigen::Vector3d>(dBodyGetAngularVel(body));
  }

  VehicleParameters parameters{.mass = 1500.0,
                               .yawInertia = 2600.0,
                               .massCentreToFront = 2.1,
                               .massCentreToRear = 2.5,
                               .width = 1.8,
                               .massCentreHeight = 0.55};
  dBodyID body;
  dGeomID geom;
};

}  // namespace bumper::tests
