#include "slides.h"

#include <algorithm>
#include <cmath>

#include "bumper/response/outline.h"

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

void Slides::keepBeside(DriveTrace& trace, const Place& place) const {
  const auto corners = Outline(subject_.vehicle).corners();
  const auto leaves = [&](const DriveState& state) {
    return std::ranges::any_of(corners, [&](const Vector2& corner) {
      const Eigen::Vector3d point =
          state.position + state.orientation * Eigen::Vector3d(corner.x(), corner.y(), 0.0);
      const Vector2 local = place.plane.local(point).head<2>();
      return local.x() > place.path.points.front().x() &&
             local.x() < place.path.points.back().x() &&
             place.path.distanceTo(local) > subject_.roomBeside();
    });
  };
  const auto first = std::ranges::find_if(trace.states, leaves);
  trace.states.erase(first, trace.states.end());
}

std::vector<Slide> Slides::driven(Rig& rig) const {
  std::vector<Slide> slides = drives_;
  for (Slide& slide : slides) {
    DriveTrace trace = rig.run(slide.drive);
    keepBeside(trace, places_[slide.place]);
    slide.loss = suddenLoss(trace, slide.drive, subject_.step, caughtWithin);
  }
  return slides;
}

}  // namespace bumper::doctor
