#pragma once

#include <optional>

#include "../response/random_impacts.h"
#include "bumper/response/response_settings.h"
#include "plan.h"

namespace bumper::tests {

enum class Layout {
  wall,
  bare_end,        ///< a short wall, of which an end is near
  post,            ///< a box of 10 cm
  thin_slab,       ///< both faces of a wall of 1 mm
  inside_corner,   ///< two walls that meet, seen from inside
  outside_corner,  ///< the same, seen from outside
  wedge,           ///< two walls that close to nothing
  corridor,        ///< two walls wider apart than the car, each with its face doubled
  slivers,         ///< a wall in pieces from 1e-9 m to 3 m, some twice, some the other way round
  soup             ///< a few walls anywhere
};
inline constexpr int layouts = 10;

Plan randomPlan(Random& random, Layout layout);

/// 0–120 m/s, mostly evenly spread, sometimes next to nothing.
double randomSpeed(Random& random);

/// 0.1–50 ms, s.
double randomStep(Random& random);

/// Both laws, constants and curves, e and μ over their whole ranges; no break-through.
ResponseSettings randomSettings(Random& random);

/// A motion outside all walls that reaches one of them within about a step of `step` seconds unless
/// yaw takes it past; nothing if this draw found none.
std::optional<PlanarMotion> randomApproach(Random& random, const VehicleParameters& vehicle,
                                           const Plan& plan, double step);

}  // namespace bumper::tests
