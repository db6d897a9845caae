// Checks that the world stepped as expected since the last step(), and corrects it if not.

#include "ode_vectors.h"
#include "pulse_delivery.h"
#include "responder_implementation.h"

namespace bumper {

namespace {

bool hasForce(dBodyID body) { return !toVector(dBodyGetForce(body)).isZero(0.0); }

}  // namespace

void Responder::Implementation::checkLastStep(std::span<Vehicle* const> some) {
  bool repeated = false;
  const bool known = clock && clock->isRunning();
  for (Vehicle* each : some) {
    if (!each->memory.delivery.any) continue;
    Vehicle& vehicle = *each;
    VehicleMemory& memory = vehicle.memory;
    const WorldSteps steps =
        known ? clock->read()
              : WorldSteps{.total = memory.delivery.step, .first = memory.delivery.step};
    switch (lookBack(memory.delivery, vehicle.bodies, steps)) {
      case LastStep::as_expected:
        break;
      case LastStep::not_taken:
        takeBack(vehicle.bodies, options.delivery, memory.delivery);
        memory = vehicle.memoryBefore;
        vehicle.issues |= step_issue::repeated_step;
        repeated = true;
        break;
      case LastStep::other_size: {
        const double missing = 1.0 - steps.first / memory.delivery.step;
        if (options.delivery == Delivery::force_pulse) {
          const PlanarImpulse owed{.linear = missing * memory.delivery.impulse.linear,
                                   .angular = missing * memory.delivery.impulse.angular};
          const VehicleState state = vehicle.bodies.read();
          memory.pulse.owe(owed);
          memory.expectation.velocity -=
              memory.delivery.axes.leftCols<2>() * owed.linear / state.mass;
          memory.expectation.yawRate -= owed.angular / state.yawInertia;
        }
        vehicle.issues |= step_issue::other_step_size;
        break;
      }
      case LastStep::moved_since:
        // A force waits for the world's step, unless it was cleared with the rest; a change of
        // velocity has been overwritten.
        if (!(steps.total > 0.0) && options.delivery == Delivery::force_pulse &&
            hasForce(vehicle.bodies.chassis())) {
          takeBack(vehicle.bodies, options.delivery, memory.delivery);
        }
        memory.pulse.drop();
        memory.expectation = {};
        vehicle.issues |= step_issue::moved;
        break;
    }
    memory.delivery.any = false;
  }
  if (clock) clock->stop();
  if (repeated) time -= lastStep;
}

}  // namespace bumper
