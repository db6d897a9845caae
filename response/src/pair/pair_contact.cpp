#include "pair_contact.h"

#include <algorithm>
#include <cmath>

#include "convex_polygon.h"
#include "pair_sweep.h"

namespace bumper {

namespace {

// They are engaged by at least so much, m: slow contacts have a direction beyond rounding.
constexpr double leastEngaged = 1e-3;

// From this penetration time on, s, the impulse acts at the engaged pose: arms of the pose of first
// touch would err by more than carrying them back mends.
constexpr double deepPenetrationTime = 0.05;

// An overlap thinner along the normal than this part of the way covered along it is a sliver.
constexpr double sliver = 0.5;

// The sum over an outline's sides of the normal times the area of the overlap nearest to it, m².
Vector2 pushOf(const std::array<FaceLine, 4>& faces, const ConvexPolygon& overlap) {
  Vector2 push = Vector2::Zero();
  for (const FaceLine& face : faces) {
    ConvexPolygon nearest = overlap;
    for (const FaceLine& other : faces) {
      if (&other == &face || nearest.isEmpty()) continue;
      nearest.clip(other.normal - face.normal, other.offset - face.offset);
    }
    if (!nearest.isEmpty()) push += nearest.moments(nearest.front()).area * face.normal;
  }
  return push;
}

// A place that moves with the body, at an engaged pose, as seen from where the body is now.
Vector2 carriedBack(const PairBody& body, const Placement& engaged, const Vector2& place) {
  const Placement now = body.body.motion.placement();
  return now.position + now.turned(engaged.local(place));
}

double narrowest(const Outline& outline) {
  return std::min(2.0 * outline.halfWidth, outline.front + outline.rear);
}

}  // namespace

PairContact pairContact(const PairBody& first, const PairBody& second, double penetrationTime) {
  const PlanarMotion& motion = first.body.motion;
  const PlanarMotion& others = second.body.motion;
  const double speed = fastestClosing(first, second);
  const double deepest = std::min(narrowest(first.outline), narrowest(second.outline));
  const double time = std::min(penetrationTime, speed > 0.0 ? deepest / speed : penetrationTime);
  const double grown = 0.5 * std::max(leastEngaged - speed * time, 0.0);
  const Outline own = first.outline.grown(grown);
  const Outline other = second.outline.grown(grown);
  const Placement at = first.placementAfter(time);
  const Placement otherAt = second.placementAfter(time);

  PairContact contact;
  const std::array<FaceLine, 4> otherFaces = faceLines(other, otherAt);
  ConvexPolygon overlap(own, at);
  for (const FaceLine& face : otherFaces) {
    overlap.clip(face.normal, face.offset);
    if (overlap.isEmpty()) return contact;
  }
  const ConvexPolygon::Moments moments = overlap.moments(overlap.front());
  if (!(moments.area > 0.0)) return contact;
  const Vector2 push = pushOf(otherFaces, overlap) - pushOf(faceLines(own, at), overlap);
  const double length = push.norm();
  if (!(length > 1e-12 * moments.area)) return contact;
  contact.normal = push / length;

  const Vector2 centroid = overlap.front() + moments.first / moments.area;
  const bool isDeep = penetrationTime >= deepPenetrationTime;
  const auto placeNow = [&](const Vector2& place) -> Vector2 {
    if (isDeep) return place;
    return 0.5 * (carriedBack(first, at, place) + carriedBack(second, otherAt, place));
  };
  contact.point = placeNow(centroid);
  contact.arm = contact.point - (isDeep ? at.position : motion.position);
  contact.otherArm = contact.point - (isDeep ? otherAt.position : others.position);
  contact.ends = overlap.endsAlong(turnedLeft(contact.normal));
  for (Vector2& end : contact.ends) end = placeNow(end);
  const Vector2 closing = velocityAt(others, contact.otherArm) - velocityAt(motion, contact.arm);
  contact.speed = closing.dot(contact.normal);
  const double way = sliver * contact.speed * time;
  const auto [low, high] = overlap.endsAlong(contact.normal);
  const double extent = contact.normal.dot(high - low);
  if (extent < way) contact.share = extent / way;
  return contact;
}

}  // namespace bumper
