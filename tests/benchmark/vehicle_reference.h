#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bumper/response/pair.h"
#include "bumper/response/response_settings.h"
#include "reference_flight.h"

namespace bumper::benchmark {

/// Vehicles in free flight that hit each other, and walls. All are left of every wall, none of
/// which they pass the ends of.
struct VehicleCase {
  std::vector<PairState> vehicles;
  std::vector<StraightWall> walls;
  ResponseSettings settings;  ///< the restitution law by Newton, friction by Coulomb
};

/// Why the reference ends before its time: from there on it is not the laws that decide but which
/// contact is asked first, or when one that goes on is asked again.
enum class Doubt {
  none,
  passing,   ///< they touch, and nothing approaches in the engaged pose
  sliver,    ///< the impulse fades: what still approaches is asked again
  again,     ///< after the impulse the same two still approach
  lasting,   ///< after the impulse the outlines do not part, or by less than 20 µm
  together,  ///< two contacts within a microsecond
  lowered    ///< the restitution asked for would add energy
};
inline constexpr int doubts = 7;
const char* nameOf(Doubt doubt);

/// A case computed event by event in extended precision.
struct VehicleFlight {
  double duration = 0.0;  ///< of what is known for certain, s: a multiple of 20 ms; 0: nothing is
  std::vector<PlanarMotion> end;  ///< then
  int vehicleImpacts = 0;         ///< until then
  int wallImpacts = 0;
  Doubt doubt = Doubt::none;
};

/// As long as contacts come one at a time, and no longer than `longest` seconds; ended where no
/// impact lies in the last 20 ms. Shares with the library the curves of restitution and friction,
/// and nothing of its geometry, its search for touches or its laws.
VehicleFlight flyVehicles(const VehicleCase& vehicleCase, double longest);

}  // namespace bumper::benchmark
