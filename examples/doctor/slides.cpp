#include "slides.h"

#include <cmath>
#include <numbers>

namespace bumper::doctor {

namespace {

constexpr double slideAttack = 3.0 * degree;
constexpr double pressing = 0.3 * 9.81;  // m/s²

}  // namespace

Slides::Slides(const Subject& subject, std::span<const Place> places)
    : subject_(subject), places_(places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    add(i, false);
    add(i, true);
  }
}

void Slides::add(std::size_t index, bool isBackwards) {
  const Place& place = places_[index];
  const WallPath& path = place.path;
  const VehicleParameters& vehicle = subject_.vehicle;
  const double length = subject_.length();
  const double room = 1.05 * length;
  const double way = path.clear() - room - 0.1 * length;
  if (way < 0.5 * length) return;

  const double front = isBackwards ? path.end - room : path.start + room;
  const double sign = isBackwards ? -1.0 : 1.0;
  const Vector2 along = path.directionAt(front);
  const double yaw = std::atan2(sign * along.y(), sign * along.x()) - sign * slideAttack;
  // The front corner on the wall's side just off the wall.
  const Vector2 corner(vehicle.massCentreToFront, -sign * 0.5 * vehicle.width);
  const Vector2 place0 = path.pointAt(front) + 0.002 * length * turnedLeft(along);
  PlanarMotion start{.yaw = yaw};
  start.position = place0 - rotated(corner, yaw);
  start.velocity = rotated({subject_.speed, 0.0}, yaw);
  if (!place.isFree(vehicle, start)) return;
  distance_ += way;
  drives_.push_back(
      {.place = index,
       .drive = {.plane = place.plane,
                 .start = start,
                 .sideForce = -sign * pressing * vehicle.mass,
                 .attack = slideAttack,
                 .steps = static_cast<std::size_t>(way / (subject_.speed * subject_.step))},
       .loss = {}});
}

std::vector<Slide> Slides::driven(Rig& rig) const {
  std::vector<Slide> slides = drives_;
  for (Slide& slide : slides)
    slide.loss = suddenLoss(rig.run(slide.drive), slide.drive, subject_.step, caughtWithin);
  return slides;
}

}  // namespace bumper::doctor
