#pragma once

#include <optional>

#include "places.h"
#include "rig.h"

namespace bumper::doctor {

/// How a vehicle goes at a wall.
enum class Approach { front, side };

/// The speeds of the search, m/s: from a tenth of the subject's to that at which a step takes the
/// vehicle two of its lengths further.
struct SpeedRange {
  double lowest = 0.0;
  double highest = 0.0;
};
SpeedRange searchedSpeeds(const Subject& subject);

/// A speed at which a vehicle goes through a wall, and a drive that shows it.
struct TunnellingDrive {
  double speed = 0.0;  ///< m/s
  TestDrive drive{};
};

/// The speed from which a vehicle goes through a wall at right angles to it, to 3 %, by bisection;
/// it does so if it does from any of four distances, which differ by a quarter of a step's way.
/// Empty: not even at the highest speed, or there is no room before the wall.
std::optional<TunnellingDrive> tunnellingSpeed(const Subject& subject, const Place& place,
                                               Approach approach, Rig& rig);

}  // namespace bumper::doctor
