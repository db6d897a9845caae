#include "car_world.h"

#include <cmath>
#include <memory>

namespace bumper::benchmark {

namespace {

/// The car of the examples in a world of its own, asked for its tyres' force only.
class TyreModel {
 public:
  explicit TyreModel(const ImpactCase& impactCase)
      : car_(ode_.world, ode_.space, impactCase.car, Eigen::Vector3d::Zero(), 0.0, 0.0) {
    car_.steer(impactCase.steering);
  }

  PlanarForce operator()(const PlanarMotion& motion) {
    place(car_, motion);
    car_.addTyreForces();
    const dReal* force = dBodyGetForce(car_.body());
    PlanarForce result{.force = {force[0], force[1]}, .yawMoment = dBodyGetTorque(car_.body())[2]};
    dBodySetForce(car_.body(), 0.0, 0.0, 0.0);
    dBodySetTorque(car_.body(), 0.0, 0.0, 0.0);
    return result;
  }

 private:
  CarWorld ode_;
  examples::YawPlaneCar car_;
};

}  // namespace

void place(examples::YawPlaneCar& car, const PlanarMotion& motion) {
  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, motion.yaw);
  dBodySetRotation(car.body(), rotation);
  dBodySetPosition(car.body(), motion.position.x(), motion.position.y(),
                   car.design().body.massCentreHeight);
  dBodySetLinearVel(car.body(), motion.velocity.x(), motion.velocity.y(), 0.0);
  dBodySetAngularVel(car.body(), 0.0, 0.0, motion.yawRate);
}

PlanarMotion motionOf(const examples::YawPlaneCar& car) {
  const dReal* position = dBodyGetPosition(car.body());
  const dReal* velocity = dBodyGetLinearVel(car.body());
  const dReal* rotation = dBodyGetRotation(car.body());
  return {.position = {position[0], position[1]},
          .yaw = std::atan2(rotation[4], rotation[0]),
          .velocity = {velocity[0], velocity[1]},
          .yawRate = dBodyGetAngularVel(car.body())[2]};
}

ForceField tyreForces(const ImpactCase& impactCase) {
  return [model = std::make_shared<TyreModel>(impactCase)](const PlanarMotion& motion) {
    return (*model)(motion);
  };
}

}  // namespace bumper::benchmark
