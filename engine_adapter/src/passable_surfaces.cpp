// Walls that a vehicle passes through: those that broke are left out until the outline has left
// them; those whose long force pulse runs cause no further impact until it ends.

#include <algorithm>

#include "responder_implementation.h"

namespace bumper {

void Responder::Implementation::applyPassableSurfaces(Vehicle& vehicle) const {
  NearbyWalls& nearby = vehicle.nearby;
  std::erase_if(vehicle.memory.passable, [&](const PassableSurface& surface) {
    const NearbyWalls::Owner owner{.barrier = surface.barrier, .settings = surface.settings};
    if (surface.until > 0.0) {
      if (!(time < surface.until)) return true;
      nearby.enter(owner, surface.depth);
      return false;
    }
    const std::span<const Segment> walls = nearby.all().segments;
    const bool isInIt = std::any_of(walls.begin(), walls.end(), [&](const Segment& wall) {
      return nearby.ownerOf(wall) == owner &&
             findTouch(vehicle.envelope.outline(), {}, wall).has_value();
    });
    if (isInIt) nearby.remove(owner);
    return !isInIt;
  });
}

}  // namespace bumper
