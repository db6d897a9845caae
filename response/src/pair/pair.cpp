// Two vehicles on their own, as a function of their states.

#include "bumper/response/pair.h"

#include <algorithm>
#include <array>

#include "bumper/response/sweep.h"
#include "pair_contact.h"
#include "pair_response.h"
#include "pair_sweep.h"

namespace bumper {

namespace {

// The order in which the two are taken, whoever asks: by where they are and how they move, then by
// what they are. Bodies alike in all have none.
bool comesBefore(const PlanarBody& a, const PlanarBody& b) {
  const auto key = [](const PlanarBody& body) {
    const PlanarMotion& motion = body.motion;
    return std::array<double, 8>{motion.position.x(), motion.position.y(), motion.yaw,
                                 motion.velocity.x(), motion.velocity.y(), motion.yawRate,
                                 body.mass,           body.yawInertia};
  };
  return key(a) < key(b);
}

std::optional<PairHit> respondInOrder(PairBody first, PairBody second,
                                      const ResponseSettings& settings, double h) {
  double time = 0.0;
  const double now = separation(first, second).distance;
  if (now > touchTolerance) {
    time = timeOfTouch(first, second, h);
    if (!(time <= h)) return std::nullopt;
    first.body.motion = advanced(first.body.motion, time);
    second.body.motion = advanced(second.body.motion, time);
  }
  const PairContact contact = pairContact(first, second, settings.penetrationTime);
  if (!(contact.speed > restTolerance)) return std::nullopt;
  return PairHit{.time = time,
                 .impact = contact.impact(std::max(-now, 0.0)),
                 .response = respondTo(contact, first.body, second.body, settings)};
}

}  // namespace

std::optional<PairHit> respondPair(const PairState& first, const PairState& second,
                                   const ResponseSettings& settings, double h) {
  const auto bodyOf = [](const PairState& state) {
    return PairBody{freeBody(state.vehicle, state.motion), Outline(state.vehicle)};
  };
  const PairBody own = bodyOf(first);
  const PairBody other = bodyOf(second);
  if (!comesBefore(other.body, own.body)) return respondInOrder(own, other, settings, h);
  std::optional<PairHit> hit = respondInOrder(other, own, settings, h);
  if (hit) *hit = asSeenByOther(*hit);
  return hit;
}

PairHit asSeenByOther(const PairHit& hit) {
  PairHit other = hit;
  other.impact.normal = -hit.impact.normal;
  other.impact.arm = hit.impact.otherArm;
  other.impact.otherArm = hit.impact.arm;
  const Vector2 linear = -hit.response.impulse.linear;
  other.response.impulse = {.linear = linear, .angular = cross(other.impact.arm, linear)};
  other.response.before = hit.response.otherBefore;
  other.response.after = hit.response.otherAfter;
  other.response.otherBefore = hit.response.before;
  other.response.otherAfter = hit.response.after;
  return other;
}

}  // namespace bumper
