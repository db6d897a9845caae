#include "yaw_plane_car.h"

#include <algorithm>
#include <cmath>

namespace bumper::examples {

namespace {

constexpr double gravity = 9.81;  // m/s², of the static tyre loads

// Below this speed a tyre's slip angle is taken as if it rolled this fast, m/s: at standstill the
// angle means nothing, and its force must not shake the car.
constexpr double slowRolling = 2.0;

Eigen::Vector3d toVector(const dReal* v) { return {v[0], v[1], v[2]}; }

}  // namespace

YawPlaneCar::YawPlaneCar(dWorldID world, dSpaceID space, const YawPlaneCarDesign& design,
                         const Eigen::Vector3d& position, double yaw, double speed)
    : design_(design), body_(dBodyCreate(world)) {
  const VehicleParameters& car = design_.body;
  const double length = car.massCentreToFront + car.massCentreToRear;
  const double height = 2.0 * (car.massCentreHeight - 0.2);
  geom_ = dCreateBox(space, length, car.width, height);
  dGeomSetBody(geom_, body_);
  dGeomSetOffsetPosition(geom_, 0.5 * (car.massCentreToFront - car.massCentreToRear), 0.0, 0.0);

  dMass mass;
  const double rollInertia = car.mass * (car.width * car.width + height * height) / 12.0;
  dMassSetParameters(&mass, car.mass, 0.0, 0.0, 0.0, rollInertia, 0.95 * car.yawInertia,
                     car.yawInertia, 0.0, 0.0, 0.0);
  dBodySetMass(body_, &mass);

  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, yaw);
  dBodySetRotation(body_, rotation);
  dBodySetPosition(body_, position.x(), position.y(), position.z());
  dBodySetLinearVel(body_, speed * std::cos(yaw), speed * std::sin(yaw), 0.0);
  // Turns by exactly yaw rate × step; ODE's default loses a part of a fast turn.
  dBodySetFiniteRotationMode(body_, 1);

  const double axleLoad =
      0.5 * car.mass * gravity / (design_.massCentreToFrontAxle + design_.massCentreToRearAxle);
  const double front = axleLoad * design_.massCentreToRearAxle;
  const double rear = axleLoad * design_.massCentreToFrontAxle;
  loads_ = {front, front, rear, rear};
}

YawPlaneCar::~YawPlaneCar() {
  dGeomDestroy(geom_);
  dBodyDestroy(body_);
}

Eigen::Vector3d YawPlaneCar::position() const { return toVector(dBodyGetPosition(body_)); }

Eigen::Vector3d YawPlaneCar::velocity() const { return toVector(dBodyGetLinearVel(body_)); }

Eigen::Matrix3d YawPlaneCar::axes() const {
  const dReal* r = dBodyGetRotation(body_);
  Eigen::Matrix3d result;
  result << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
  return result;
}

double YawPlaneCar::yawRate() const {
  return toVector(dBodyGetAngularVel(body_)).dot(axes().col(2));
}

double YawPlaneCar::forwardSpeed() const { return velocity().dot(axes().col(0)); }

std::array<Eigen::Vector2d, 4> YawPlaneCar::wheels() const {
  const double front = design_.massCentreToFrontAxle;
  const double rear = -design_.massCentreToRearAxle;
  const double side = 0.5 * design_.track;
  return {Eigen::Vector2d(front, side), Eigen::Vector2d(front, -side), Eigen::Vector2d(rear, side),
          Eigen::Vector2d(rear, -side)};
}

void YawPlaneCar::addTyreForces() {
  const Eigen::Matrix3d toWorld = axes();
  const Eigen::Vector2d velocity = (toWorld.transpose() * this->velocity()).head<2>();
  const double yawRate = this->yawRate();
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  double moment = 0.0;
  const std::array<Eigen::Vector2d, 4> places = wheels();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d& place = places[i];
    const bool isFront = i < 2;
    const Eigen::Vector2d along = isFront
                                      ? Eigen::Vector2d(std::cos(steering_), std::sin(steering_))
                                      : Eigen::Vector2d::UnitX();
    const Eigen::Vector2d across(-along.y(), along.x());
    const Eigen::Vector2d own = velocity + yawRate * Eigen::Vector2d(-place.y(), place.x());
    const double slipAngle =
        std::atan2(own.dot(across), std::max(std::abs(own.dot(along)), slowRolling));

    Eigen::Vector2d tyre = -design_.corneringStiffness * slipAngle * across;
    if (!isFront) tyre += 0.5 * driveForce_ * along;
    const double limit = design_.tyreFriction * loads_[i];
    if (tyre.norm() > limit) tyre *= limit / tyre.norm();
    force += tyre;
    moment += place.x() * tyre.y() - place.y() * tyre.x();
  }
  const Eigen::Vector3d inWorld = toWorld.leftCols<2>() * force;
  const Eigen::Vector3d turning = moment * toWorld.col(2);
  dBodyAddForce(body_, inWorld.x(), inWorld.y(), inWorld.z());
  dBodyAddTorque(body_, turning.x(), turning.y(), turning.z());
}

}  // namespace bumper::examples
