#pragma once

#include "bumper/engine_adapter/saved_state.h"
#include "vehicle_bodies.h"

namespace bumper {

/// What the coming step should lead to by the known forces and the impulse that is delivered, where
/// joints act as well.
Expectation expectationOf(const VehicleState& state, const PlanarImpulse& impulse, double h);

/// Takes out of what is pending what joints have done of it already.
void reconcile(const Expectation& expected, const VehicleState& state, ForcePulse& pulse);

}  // namespace bumper
