#include "impact_situation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bumper/response/contact_point.h"
#include "bumper/response/error.h"
#include "bumper/response/response_settings.h"
#include "bumper/scenes/walls.h"
#include "text.h"

namespace bumper::drawing {

namespace {

using Eigen::Vector2d;

/// A vehicle as it sees the impact; its outline stands where the arm puts it, or where it was
/// recorded if the arm is not known. Nothing if it was not recorded then.
std::optional<Party> partyOf(const ImpactEvent& event, const Recording& recording) {
  const auto vehicles = recording.vehicles();
  const auto found = std::ranges::find(vehicles, event.vehicle, &RecordedVehicle::name);
  if (found == vehicles.end()) return {};
  const auto pose = poseAt(*found, event.time);
  if (!pose) return {};
  Party party;
  party.event = event;
  party.index = static_cast<std::size_t>(found - vehicles.begin());
  party.vehicle = found->parameters;
  party.yaw = heading(pose->orientation);
  party.forward = {std::cos(party.yaw), std::sin(party.yaw)};
  party.left = {-party.forward.y(), party.forward.x()};
  party.centre = pose->position.head<2>();
  if (event.arm.allFinite()) {
    party.centre =
        event.contact.head<2>() - event.arm.x() * party.forward - event.arm.y() * party.left;
  }
  for (const Vector2d& corner : Outline(party.vehicle).corners())
    party.corners.emplace_back(party.centre + corner.x() * party.forward + corner.y() * party.left);
  party.after = event.velocityAfter.head<2>();
  party.before = event.velocityBefore.head<2>();
  return party;
}

/// The part of a shape on the left of a line.
std::vector<Vector2d> leftOf(const Vector2d& from, const Vector2d& to,
                             const std::vector<Vector2d>& shape) {
  const Vector2d inwards = Vector2d(from.y() - to.y(), to.x() - from.x());
  std::vector<Vector2d> kept;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const Vector2d& here = shape[k];
    const Vector2d& next = shape[(k + 1) % shape.size()];
    const double inside = inwards.dot(here - from);
    const double then = inwards.dot(next - from);
    if (inside >= 0.0) kept.push_back(here);
    if ((inside > 0.0 && then < 0.0) || (inside < 0.0 && then > 0.0))
      kept.emplace_back(here + inside / (inside - then) * (next - here));
  }
  return kept;
}

/// Corners after some time of free flight.
std::vector<Vector2d> carriedOn(const Party& party, double time) {
  const Eigen::Rotation2Dd turn(time * party.event.yawRateBefore);
  std::vector<Vector2d> corners;
  for (const Vector2d& corner : party.corners)
    corners.emplace_back(party.centre + time * party.before + turn * (corner - party.centre));
  return corners;
}

std::vector<Vector2d> overlapOf(const Party& one, const Party& other) {
  const Vector2d closing = one.before - other.before;
  if (!closing.allFinite()) return {};
  // As the response has it: no deeper than half of the narrower one.
  const double deepest = 0.5 * std::min(one.vehicle.width, other.vehicle.width);
  const double time =
      std::min(ResponseSettings{}.penetrationTime, deepest / std::max(closing.norm(), 1e-9));
  std::vector<Vector2d> shape = carriedOn(one, time);
  const std::vector<Vector2d> around = carriedOn(other, time);
  for (std::size_t k = 0; k < around.size(); ++k)
    shape = leftOf(around[k], around[(k + 1) % around.size()], shape);
  for (Vector2d& corner : shape) corner -= 0.5 * time * (one.before + other.before);
  return shape;
}

/// Where the wall's line through the contact point enters and leaves the outline, as far as the
/// outline can reach.
void findInterference(Situation& s) {
  const Outline outline(s.vehicle.vehicle);
  Segment line;
  const double reach = 2.0 * (outline.front + outline.rear + outline.halfWidth);
  line.start = s.contact - reach * s.tangent;
  line.end = s.contact + reach * s.tangent;
  line.normal = s.normal;
  const Interference inside = interference(outline, {s.vehicle.centre, s.vehicle.yaw}, line);
  if (inside.empty || inside.length() <= touching) return;
  s.a = inside.from;
  s.b = inside.to;
}

}  // namespace

Situation situationOf(const Scene& scene, const Recording& recording, std::size_t impact) {
  if (impact >= recording.impacts().size())
    throw Error("a close-up of impact " + std::to_string(impact) + ": the recording has " +
                std::to_string(recording.impacts().size()));
  const ImpactEvent event = recording.impacts()[impact].event();
  std::optional<Party> vehicle = partyOf(event, recording);
  if (!vehicle)
    throw Error("a close-up of impact " + std::to_string(impact) + ": vehicle '" +
                std::string(event.vehicle) + "' was not recorded at " + fixed(event.time, 3) +
                " s");
  Situation s;
  s.vehicle = *vehicle;
  s.contact = event.contact.head<2>();
  s.normal = Vector2d(event.normal.head<2>()).stableNormalized();
  s.tangent = {-s.normal.y(), s.normal.x()};
  s.impulse = event.impulseNormal * s.normal + event.impulseTangent * s.tangent;
  // Not known, or not set by whoever made the event.
  if (!s.vehicle.before.allFinite() || (s.vehicle.before.isZero() && event.deltaV > 0.0))
    s.vehicle.before = s.vehicle.after - s.impulse / s.vehicle.vehicle.mass;
  s.a = s.b = s.contact;
  if (event.otherVehicle.empty()) {
    findInterference(s);
  } else if (const auto other = asSeenBy(event.otherVehicle, event)) {
    s.other = partyOf(*other, recording);
    if (s.other) s.overlap = overlapOf(s.vehicle, *s.other);
  }
  for (const Wall& wall : selectWalls(scene).walls) {
    for (std::size_t k = 0; k < 3; ++k)
      s.walls.emplace_back(wall.corners[k].head<2>(), wall.corners[(k + 1) % 3].head<2>());
  }
  return s;
}

}  // namespace bumper::drawing
