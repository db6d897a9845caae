// The impulse of one step becomes a force, or a change of velocity, of the bodies, and is recorded
// to be compared with what the world makes of it.

#include "pulse_delivery.h"

#include <cmath>

namespace bumper {

namespace {

// More than the rounding of a sum of steps, relative.
constexpr double sameSize = 1e-9;

// Maximum acceleration by unknown forces over several steps, m/s².
constexpr double undisturbedAcceleration = 20.0;

bool isClose(double a, double b) { return std::abs(a - b) <= sameSize * std::abs(b); }

PlanarForce over(const PlanarImpulse& impulse, double h) {
  return {.force = impulse.linear / h, .yawMoment = impulse.angular / h};
}

}  // namespace

LastStep lookBack(const LastDelivery& delivery, const VehicleBodies& bodies,
                  const WorldSteps& steps) {
  if (!delivery.any) return LastStep::as_expected;
  const Eigen::Vector3d position = bodies.position();
  const Eigen::Vector3d velocity = bodies.velocity();
  if (!(steps.total > 0.0)) {
    const bool isSame = position == delivery.position && velocity == delivery.velocity;
    return isSame ? LastStep::not_taken : LastStep::moved_since;
  }
  const bool wasOne = isClose(steps.first, steps.total);
  // Damping acts on the velocity after the body was moved with it.
  if (dBodyGetLinearDamping(bodies.chassis()) == 0.0) {
    const Eigen::Vector3d way = position - delivery.position;
    const double rounding = 1e-14 * (position.norm() + delivery.position.norm());
    double tolerance = 1e-9 * way.norm() + rounding;
    if (!wasOne) {
      const double change = (velocity - delivery.velocity).norm() +
                            delivery.impulse.linear.norm() / bodies.read().mass;
      tolerance += steps.total * (change + undisturbedAcceleration * steps.total);
    }
    if ((way - steps.total * velocity).norm() > tolerance) return LastStep::moved_since;
  }
  return wasOne && isClose(steps.total, delivery.step) ? LastStep::as_expected
                                                       : LastStep::other_size;
}

void deliver(const VehicleBodies& bodies, const VehicleState& state, const PlanarImpulse& impulse,
             double h, Delivery how, LastDelivery& delivery) {
  if (!impulse.linear.isZero(0.0) || impulse.angular != 0.0) {
    if (how == Delivery::force_pulse) {
      bodies.push(state, over(impulse, h));
    } else {
      bodies.changeVelocity(state, impulse);
    }
  }
  delivery.any = true;
  delivery.step = h;
  delivery.impulse = impulse;
  delivery.position = bodies.position();
  delivery.velocity = bodies.velocity();
  delivery.axes = bodies.axes();
}

void takeBack(const VehicleBodies& bodies, Delivery how, const LastDelivery& delivery) {
  VehicleState state = bodies.read();
  state.axes = delivery.axes;
  const PlanarImpulse back{.linear = -delivery.impulse.linear,
                           .angular = -delivery.impulse.angular};
  if (how == Delivery::force_pulse) {
    bodies.push(state, over(back, delivery.step));
  } else {
    bodies.changeVelocity(state, back);
  }
}

}  // namespace bumper
