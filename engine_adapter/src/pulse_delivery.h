#pragma once

#include "bumper/engine_adapter/responder.h"
#include "bumper/engine_adapter/saved_state.h"
#include "vehicle_bodies.h"

namespace bumper {

/// How the world's last step treated what was delivered before it.
enum class LastStep {
  as_told,      ///< or nothing was delivered
  not_taken,    ///< the bodies are where they were: step() was called again
  other_size,   ///< it had another size than step(h)
  moved_since,  ///< the motion is not that of one step
};

/// What the motion since the last delivery says. ODE moves a body by its new velocity times the
/// step, so that position and velocity tell the step's size.
LastStep lookBack(const LastDelivery& delivery, dBodyID chassis, double& worldStep);

/// Hands the impulse of the coming step to the bodies, if there is one, and remembers it.
void deliver(const VehicleBodies& bodies, const VehicleState& state, const PlanarImpulse& impulse,
             double h, Delivery how, LastDelivery& delivery);

/// Takes back what was delivered, from bodies that have not moved since.
void takeBack(const VehicleBodies& bodies, const VehicleState& state, Delivery how,
              const LastDelivery& delivery);

}  // namespace bumper
