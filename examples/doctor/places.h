#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "ground.h"
#include "small_features.h"
#include "subject.h"
#include "wall_path.h"

namespace bumper::doctor {

/// Multiples of it, modulo 1, are spread evenly however many there are.
inline constexpr double golden = 0.6180339887498949;

/// A place on a wall that a vehicle can drive to.
struct Place {
  DrivingPlane plane{};  ///< origin on the wall; x along it, y out of it to the vehicle's side
  std::size_t wall = 0;  ///< index
  std::vector<WallLine> lines{};  ///< of the walls around, at the heights of the band
  WallPath path{};

  /// Whether the vehicle's outline, at a motion in the plane, touches no wall.
  [[nodiscard]] bool isFree(const VehicleParameters& vehicle, const PlanarMotion& motion) const;
};

/// Chooses places: near the given features first, those for half of `count` at most, the others in
/// proportion to the walls' lengths as seen from above. Only walls that stand in the vehicle's band
/// above ground that is beside them, or anywhere if there is none, and where it has room beside
/// them. Fewer than `count` if few walls are of that kind. The same input gives the same places.
std::vector<Place> choosePlaces(const Subject& subject, const WallSections& sections,
                                const Ground& ground, std::span<const SmallFeature> features,
                                std::size_t count);

}  // namespace bumper::doctor
