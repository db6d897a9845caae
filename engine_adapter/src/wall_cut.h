#pragma once

#include <optional>

#include "bumper/response/segment.h"
#include "envelope.h"
#include "vehicle_bodies.h"
#include "wall_face.h"

namespace bumper {

/// The part of a face over a vehicle's band, projected into its yaw plane; nothing if there is
/// none. Of a face that leans, the line nearest to the mass centre. The segment is without id,
/// surface and `solid`.
std::optional<Segment> cutFace(const WallFace& face, const VehicleState& state,
                               const Envelope& vehicle);

}  // namespace bumper
