#pragma once

#include "bumper/engine_adapter/responder.h"
#include "bumper/engine_adapter/saved_state.h"
#include "vehicle_bodies.h"
#include "world_clock.h"

namespace bumper {

/// What the world's last step did with the impulse delivered before it.
enum class LastStep {
  as_expected,  ///< or nothing was delivered
  not_taken,    ///< step() was called again
  other_size,   ///< it had another size than step(h), or there were several
  moved_since,  ///< the vehicle's motion is not that of these steps
};

/// Compares the delivery with the world's steps since and the chassis' motion. ODE moves a body by
/// its new velocity times the step.
LastStep lookBack(const LastDelivery& delivery, const VehicleBodies& bodies,
                  const WorldSteps& steps);

/// Applies the impulse of the coming step to the bodies, if there is one, and records it.
void deliver(const VehicleBodies& bodies, const VehicleState& state, const PlanarImpulse& impulse,
             double h, Delivery how, LastDelivery& delivery);

/// Reverses a delivery with which the world has not stepped.
void takeBack(const VehicleBodies& bodies, Delivery how, const LastDelivery& delivery);

}  // namespace bumper
