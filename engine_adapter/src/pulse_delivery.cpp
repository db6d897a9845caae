#include "pulse_delivery.h"

#include <cmath>

#include "ode_vectors.h"

namespace bumper {

namespace {

// A world step so many times longer than told is none: the vehicle was put further along its way.
constexpr double mostSteps = 16.0;

PlanarForce over(const PlanarImpulse& impulse, double h) {
  return {.force = impulse.linear / h, .yawMoment = impulse.angular / h};
}

}  // namespace

LastStep lookBack(const LastDelivery& delivery, dBodyID chassis, double& worldStep) {
  worldStep = delivery.step;
  if (!delivery.any) return LastStep::as_told;
  const Eigen::Vector3d position = toVector(dBodyGetPosition(chassis));
  const Eigen::Vector3d velocity = toVector(dBodyGetLinearVel(chassis));
  if (position == delivery.position && velocity == delivery.velocity &&
      toVector(dBodyGetAngularVel(chassis)) == delivery.turning &&
      toMatrix(dBodyGetRotation(chassis)) == delivery.axes) {
    // It may have stood still; but then ODE has cleared the force.
    const Eigen::Vector3d force = toVector(dBodyGetForce(chassis));
    const bool stillThere =
        (force - delivery.forceAfter).norm() <= (force - delivery.forceBefore).norm();
    return stillThere ? LastStep::not_taken : LastStep::as_told;
  }
  // Damping acts on the velocity after the body was moved with it.
  if (dBodyGetLinearDamping(chassis) > 0.0) return LastStep::as_told;
  const Eigen::Vector3d way = position - delivery.position;
  const double rounding = 1e-14 * (position.norm() + delivery.position.norm());
  const double tolerance = 1e-9 * way.norm() + rounding;
  if ((way - delivery.step * velocity).norm() <= tolerance) return LastStep::as_told;
  const double speed2 = velocity.squaredNorm();
  if (speed2 > 0.0) {
    worldStep = way.dot(velocity) / speed2;
    const bool canBeStep = worldStep > 0.0 && worldStep <= mostSteps * delivery.step;
    if (canBeStep && (way - worldStep * velocity).norm() <= tolerance) {
      return LastStep::other_size;
    }
  }
  return LastStep::moved_since;
}

void deliver(const VehicleBodies& bodies, const VehicleState& state, const PlanarImpulse& impulse,
             double h, Delivery how, LastDelivery& delivery) {
  dBodyID chassis = bodies.chassis();
  delivery.forceBefore = toVector(dBodyGetForce(chassis));
  if (!impulse.linear.isZero(0.0) || impulse.angular != 0.0) {
    if (how == Delivery::force_pulse) {
      bodies.push(state, over(impulse, h));
    } else {
      bodies.kick(state, impulse);
    }
  }
  delivery.any = true;
  delivery.forceAfter = toVector(dBodyGetForce(chassis));
  delivery.step = h;
  delivery.impulse = impulse;
  delivery.position = toVector(dBodyGetPosition(chassis));
  delivery.velocity = toVector(dBodyGetLinearVel(chassis));
  delivery.turning = toVector(dBodyGetAngularVel(chassis));
  delivery.axes = toMatrix(dBodyGetRotation(chassis));
}

void takeBack(const VehicleBodies& bodies, const VehicleState& state, Delivery how,
              const LastDelivery& delivery) {
  const PlanarImpulse back{.linear = -delivery.impulse.linear,
                           .angular = -delivery.impulse.angular};
  if (how == Delivery::force_pulse) {
    bodies.push(state, over(back, delivery.step));
  } else {
    bodies.kick(state, back);
  }
}

}  // namespace bumper
