#pragma once

#include <ode/ode.h>

#include <limits>
#include <optional>
#include <span>

#include "vehicle_bodies.h"

namespace bumper {

/// How far geoms reach from a vehicle's mass centre along the chassis' axes, m. A side that ends
/// beyond the mass centre is negative.
struct VehicleExtents {
  double front = -std::numeric_limits<double>::infinity();
  double rear = -std::numeric_limits<double>::infinity();
  double left = -std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
  double lowest = std::numeric_limits<double>::infinity();  ///< height over the mass centre
  double highest = -std::numeric_limits<double>::infinity();
};

/// Heights over the mass centre along the chassis' z axis, m.
struct Heights {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// The extents of the geoms on these bodies within `heights`; nothing if none is there. `pose` is
/// the vehicle's, of which the bodies may be a part, in the frame.
///
/// Exact for boxes, spheres, capsules, cylinders, convexes and, in ODE's single precision,
/// trimeshes, all as they lie now, and for one in a geom transform; not for a convex in a geom
/// transform. That one is left out, as are heightfields and classes of the application's own, whose
/// shape ODE does not expose, and rays and geoms without category and collide bits, which hit
/// nothing.
std::optional<VehicleExtents> extentsOf(std::span<const dBodyID> bodies, const VehiclePose& pose,
                                        const Heights& heights = {}, const WorldFrame& frame = {});

}  // namespace bumper
