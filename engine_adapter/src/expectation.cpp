#include "expectation.h"

namespace bumper {

namespace {

// Maximum accelerations of a vehicle without impact by forces not known before a step: tyres,
// motors.
constexpr double ordinaryAcceleration = 15.0;     // m/s²
constexpr double ordinaryYawAcceleration = 15.0;  // rad/s²

}  // namespace

Expectation expectationOf(const VehicleState& state, const PlanarImpulse& impulse, double h) {
  return {
      .step = h,
      .velocity =
          state.velocity + h * state.acceleration + state.toWorld(impulse.linear) / state.mass,
      .yawRate = state.yawRate + h * state.yawAcceleration + impulse.angular / state.yawInertia};
}

void reconcile(const Expectation& expected, const VehicleState& state, ForcePulse& pulse) {
  if (expected.step <= 0.0) return;
  const Vector2 surplus = (state.axes.transpose() * (state.velocity - expected.velocity)).head<2>();
  pulse.reconcile({.linear = state.mass * surplus,
                   .angular = state.yawInertia * (state.yawRate - expected.yawRate)},
                  {.linear = expected.step * ordinaryAcceleration * state.mass,
                   .angular = expected.step * ordinaryYawAcceleration * state.yawInertia},
                  state.mass, state.yawInertia);
}

}  // namespace bumper
