#pragma once

#include <cstddef>
#include <ostream>
#include <span>
#include <vector>

#include "bumper/response/contact_point.h"
#include "bumper/response/planar_motion.h"
#include "bumper/response/segment.h"
#include "bumper/response/vehicle_parameters.h"
#include "bumper/scenes/scene.h"

/// Walls and outlines seen from above, measured without the library.
namespace bumper::tests {

/// A wall without thickness, seen from above, m.
struct Line {
  Vector2 start = Vector2::Zero();
  Vector2 end = Vector2::Zero();
};
using Plan = std::vector<Line>;

/// How deep a wall reaches into the outline, m: the largest distance to the nearest side, over the
/// part of the wall that is inside; 0 if none is.
double intrusion(const VehicleParameters& vehicle, const PlanarMotion& pose, const Line& wall);

/// The same for the wall that reaches in furthest.
double deepestIntrusion(const VehicleParameters& vehicle, const PlanarMotion& pose,
                        std::span<const Line> plan);

/// How deep a wall's end may come into the side of a turning car within a step of `h` seconds, m:
/// the side slides along the end, and the contact is looked at again eight times in a step.
/// Rounding for what does not turn.
double slidingDepth(const VehicleParameters& vehicle, const PlanarMotion& motion, double h);

/// Whether the way between two points leads through a wall.
bool leadsThrough(const Vector2& from, const Vector2& to, std::span<const Line> plan);

/// The walls of a box of the given thickness about a line.
Plan slab(const Line& middle, double thickness);

/// The same for the response, on surface 0, each with its number as id.
std::vector<Segment> segmentsOf(const Plan& plan);

/// A regular polygon about the origin; it goes round counter-clockwise.
Plan polygon(double radius, std::size_t sides);

/// Each wall as a quad from z = 0 to `height`, cut into `panels` × `rows` quads of two triangles.
Scene standing(std::span<const Line> plan, double height = 1.0, std::size_t panels = 1,
               std::size_t rows = 1);

/// All the digits that it takes to have the same case again.
std::ostream& printExactly(std::ostream& out, const VehicleParameters& vehicle,
                           const PlanarMotion& motion, std::span<const Line> plan);

}  // namespace bumper::tests
