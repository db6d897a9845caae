#pragma once

#include <Eigen/Geometry>

#include "../engine_adapter/box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/planar_motion.h"

namespace bumper::tests {

/// Places a car's body upright with its mass centre at its height, or at `height`.
inline void place(BoxCar& car, const PlanarMotion& motion) {
  car.place({motion.position.x(), motion.position.y(), car.parameters.massCentreHeight},
            Eigen::AngleAxisd(motion.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  car.move({motion.velocity.x(), motion.velocity.y(), 0.0}, {0.0, 0.0, motion.yawRate});
}

/// The body's motion seen from above.
inline PlanarMotion motionOf(dBodyID body) {
  const dReal* position = dBodyGetPosition(body);
  const dReal* rotation = dBodyGetRotation(body);
  const dReal* velocity = dBodyGetLinearVel(body);
  return {.position = {position[0], position[1]},
          .yaw = std::atan2(rotation[4], rotation[0]),
          .velocity = {velocity[0], velocity[1]},
          .yawRate = dBodyGetAngularVel(body)[2]};
}

/// The law's motion of a responder's only vehicle: the body's with what is still to be delivered.
inline PlanarMotion lawMotionOf(const BoxCar& car, const Responder& responder) {
  PlanarMotion motion = motionOf(car.body);
  const SavedState state = responder.save();
  const VehicleMemory& memory = state.vehicles.front();
  const PlanarImpulse pending = memory.pulse.pending();
  const Eigen::Vector3d linear =
      memory.delivery.axes * Eigen::Vector3d(pending.linear.x(), pending.linear.y(), 0.0);
  motion.velocity += linear.head<2>() / car.parameters.mass;
  motion.yawRate += pending.angular / car.parameters.yawInertia;
  return motion;
}

/// … and its energy in the yaw plane, J.
inline double lawEnergyOf(const BoxCar& car, const Responder& responder) {
  return yawPlaneEnergy(lawMotionOf(car, responder), car.parameters.mass,
                        car.parameters.yawInertia);
}

/// Kinetic energy in all six directions, J.
inline double energyOf(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  const Eigen::Map<const Eigen::Vector3d> velocity(dBodyGetLinearVel(body));
  dVector3 angular;
  const dReal* w = dBodyGetAngularVel(body);
  dBodyVectorFromWorld(body, w[0], w[1], w[2], angular);
  return 0.5 * (mass.mass * velocity.squaredNorm() + mass.I[0] * angular[0] * angular[0] +
                mass.I[5] * angular[1] * angular[1] + mass.I[10] * angular[2] * angular[2]);
}

}  // namespace bumper::tests
