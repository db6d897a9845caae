// Walls that a vehicle passes through: one that broke is left out until the outline has left it;
// one whose long force pulse runs causes no further impact until it ends.

#include <algorithm>

#include "responder_implementation.h"

namespace bumper {

void Responder::Implementation::applyPassableWalls(Vehicle& vehicle) const {
  NearbyWalls& nearby = vehicle.nearby;
  const VehicleState& state = vehicle.reading.state;
  std::erase_if(vehicle.memory.passable, [&](const PassableWall& passable) {
    const NearbyWalls::Owner owner{.barrier = passable.barrier, .settings = passable.settings};
    const BarrierFrame& frame = find(barriers, passable.barrier.value)->frame();
    const Eigen::Vector3d inWorld = frame.toWorld(passable.place);
    const Vector2 place = (state.axes.transpose() * (inWorld - state.massCentre)).head<2>();
    const Vector2 normal =
        (state.axes.transpose() * frame.directionToWorld(passable.normal)).head<2>().normalized();
    if (passable.until > 0.0) {
      if (!(time < passable.until)) return true;
      // Walls that go on from one another have one contact, whichever barriers they are of.
      nearby.enter([&](const Segment& wall) { return isOneWall(wall, place, normal); },
                   passable.depth);
      return false;
    }
    const auto isOfIt = [&](const Segment& wall) {
      return nearby.ownerOf(wall) == owner && isOneWall(wall, place, normal);
    };
    const std::span<const Segment> walls = nearby.all().segments;
    const bool isInIt = std::any_of(walls.begin(), walls.end(), [&](const Segment& wall) {
      return isOfIt(wall) && findTouch(vehicle.envelope.outline(), {}, wall).has_value();
    });
    if (isInIt) nearby.remove(isOfIt);
    return !isInIt;
  });
}

}  // namespace bumper
