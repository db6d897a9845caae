#include "hinge2_car.h"

#include <cmath>

namespace bumper::tests {

namespace {

constexpr double chassisMass = 1420.0;
constexpr double wheelMass = 20.0;
constexpr double chassisHeight = 0.62;  // of its centre above the ground
constexpr double axleFront = 1.3;
constexpr double axleSide = 0.75;

Eigen::Vector3d toVector(const dReal* v) { return {v[0], v[1], v[2]}; }

}  // namespace

Hinge2Car::Hinge2Car(dWorldID world, dSpaceID space, const Eigen::Vector2d& place,
                     double groundHeight, double yaw, double speed) {
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  const auto at = [&](double forward, double left, double up) {
    return Eigen::Vector3d(place.x() + c * forward - s * left, place.y() + s * forward + c * left,
                           groundHeight + up);
  };
  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, yaw);

  chassis = dBodyCreate(world);
  dMass mass;
  dMassSetBoxTotal(&mass, chassisMass, front + rear, width, height);
  dBodySetMass(chassis, &mass);
  const Eigen::Vector3d centre = at(0.0, 0.0, chassisHeight);
  dBodySetPosition(chassis, centre.x(), centre.y(), centre.z());
  dBodySetRotation(chassis, rotation);
  dBodySetLinearVel(chassis, speed * c, speed * s, 0.0);
  box = dCreateBox(space, front + rear, width, height);
  dGeomSetBody(box, chassis);

  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const double forward = i < 2 ? axleFront : -axleFront;
    const double left = i % 2 == 0 ? axleSide : -axleSide;
    const Eigen::Vector3d hub = at(forward, left, wheelRadius);
    wheels[i] = dBodyCreate(world);
    dMassSetSphereTotal(&mass, wheelMass, wheelRadius);
    dBodySetMass(wheels[i], &mass);
    dBodySetPosition(wheels[i], hub.x(), hub.y(), hub.z());
    dBodySetRotation(wheels[i], rotation);
    dBodySetLinearVel(wheels[i], speed * c, speed * s, 0.0);
    dBodySetAngularVel(wheels[i], -s * speed / wheelRadius, c * speed / wheelRadius, 0.0);
    dBodySetFiniteRotationMode(wheels[i], 1);
    tyres[i] = dCreateSphere(space, wheelRadius);
    dGeomSetBody(tyres[i], wheels[i]);

    const dVector3 up = {0.0, 0.0, 1.0};
    const dVector3 across = {-s, c, 0.0};
    axles[i] = dJointCreateHinge2(world, nullptr);
    dJointAttach(axles[i], chassis, wheels[i]);
    dJointSetHinge2Anchor(axles[i], hub.x(), hub.y(), hub.z());
    dJointSetHinge2Axes(axles[i], up, across);
    dJointSetHinge2Param(axles[i], dParamLoStop, 0.0);
    dJointSetHinge2Param(axles[i], dParamHiStop, 0.0);
    dJointSetHinge2Param(axles[i], dParamSuspensionERP, 0.4);
    dJointSetHinge2Param(axles[i], dParamSuspensionCFM, 1e-5);
  }
}

Hinge2Car::~Hinge2Car() {
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    dJointDestroy(axles[i]);
    dGeomDestroy(tyres[i]);
    dBodyDestroy(wheels[i]);
  }
  dGeomDestroy(box);
  dBodyDestroy(chassis);
}

void Hinge2Car::drive(double speed, double maxTorque) {
  for (dJointID axle : axles) {
    // ODE counts the second axis by the chassis against the wheel.
    dJointSetHinge2Param(axle, dParamVel2, -speed / wheelRadius);
    dJointSetHinge2Param(axle, dParamFMax2, maxTorque);
  }
}

double Hinge2Car::mass() { return chassisMass + 4.0 * wheelMass; }

VehicleParameters Hinge2Car::parameters() const {
  const double massCentreHeight =
      (chassisMass * chassisHeight + 4.0 * wheelMass * wheelRadius) / mass();
  return parametersFromBodies(chassis, wheels, front, rear, width, massCentreHeight);
}

Eigen::Vector3d Hinge2Car::massCentre() const {
  Eigen::Vector3d sum = chassisMass * toVector(dBodyGetPosition(chassis));
  for (dBodyID wheel : wheels) sum += wheelMass * toVector(dBodyGetPosition(wheel));
  return sum / mass();
}

Eigen::Vector3d Hinge2Car::velocity() const {
  Eigen::Vector3d sum = chassisMass * toVector(dBodyGetLinearVel(chassis));
  for (dBodyID wheel : wheels) sum += wheelMass * toVector(dBodyGetLinearVel(wheel));
  return sum / mass();
}

}  // namespace bumper::tests
