#pragma once

#include "bumper/engine_adapter/responder.h"
#include "bumper/engine_adapter/saved_state.h"
#include "vehicle_bodies.h"
#include "world_clock.h"

namespace bumper {

/// How the world's last step treated what was delivered before it.
enum class LastStep {
  as_told,      ///< or nothing was delivered
  not_taken,    ///< step() was called again
  other_size,   ///< it had another size than step(h), or there were several
  moved_since,  ///< the vehicle's motion is not that of these steps
};

/// What the world's steps since the delivery and the chassis' motion say. ODE moves a body by its
/// new velocity times the step.
LastStep lookBack(const LastDelivery& delivery, const VehicleBodies& bodies,
                  const WorldSteps& steps);

/// Hands the impulse of the coming step to the bodies, if there is one, and remembers it.
void deliver(const VehicleBodies& bodies, const VehicleState& state, const PlanarImpulse& impulse,
             double h, Delivery how, LastDelivery& delivery);

/// Takes back what was delivered and the world has not stepped with.
void takeBack(const VehicleBodies& bodies, Delivery how, const LastDelivery& delivery);

}  // namespace bumper
