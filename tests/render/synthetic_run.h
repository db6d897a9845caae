#pragma once

#include "bumper/render/recording.h"
#include "bumper/scenes/scene.h"

namespace bumper::testing {

/// A 1990s compact saloon.
VehicleParameters saloon();

/// A made-up run along the paper's test rail in the way of its Figure 6: the right front corner
/// hits the side wall, the right rear one follows, and the left front corner hits the end wall.
/// Made of straight pieces and turns by plain arithmetic, without any response or engine.
Recording testRailRun();

/// A made-up run on the course: through a bend, into its wall and along it.
Recording courseRun();

/// Two made-up impacts on the test rail by plain geometry: the right front corner slides along the
/// side wall; the front's left half meets the end wall, by the corner of the two.
Recording cornerHits();

/// A made-up hit by plain arithmetic: "saloon" at 15 m/s along x, at the origin, with its front
/// into the left side of "crossing", which goes at 10 m/s along y.
Recording sideHit();

/// One vehicle that stands at a place with a heading, rad, and nothing else.
Recording standingVehicle(const Eigen::Vector2d& place, double heading);

/// `run` with another heading at every pose, turned by an angle, rad.
Recording turned(const Recording& run, double angle);

/// `run` without the impact of that index.
Recording withoutImpact(const Recording& run, std::size_t index);

}  // namespace bumper::testing
