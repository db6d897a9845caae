#pragma once

#include "vehicle_schemes.h"

namespace bumper::benchmark {

/// Bullet's contact solver: boxes kept in the plane, its own defaults but for the threshold of
/// restitution; single precision, as Debian ships it. Only where Bullet was found.
VehicleRun runBullet(const VehicleTask& task);

/// Box2D, which knows nothing but the plane: 8 and 3 iterations as its manual recommends, bodies
/// swept against each other ("bullets"), restitution from 0.1 m/s on; single precision. Only where
/// Box2D was found.
VehicleRun runBox2d(const VehicleTask& task);

}  // namespace bumper::benchmark
