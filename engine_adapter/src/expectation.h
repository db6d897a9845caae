#pragma once

#include "bumper/engine_adapter/saved_state.h"
#include "vehicle_bodies.h"

namespace bumper {

/// The motion predicted for the coming step from the known forces and the impulse delivered, where
/// joints act as well.
Expectation expectationOf(const VehicleState& state, const PlanarImpulse& impulse, double h);

/// Subtracts from the pending impulse what joints have applied of it already.
void reconcile(const Expectation& expected, const VehicleState& state, ForcePulse& pulse);

}  // namespace bumper
