#include "pair_response.h"

namespace bumper {

ImpactResponse respondTo(const PairContact& contact, const PlanarBody& first,
                         const PlanarBody& second, const ResponseSettings& settings,
                         Rebound rebound) {
  const Impact impact = contact.impact(0.0);
  const ImpactResponse response = respond(impact, first, second, settings, rebound);
  return contact.share < 1.0 ? reduced(response, impact, first, second, contact.share) : response;
}

PairHit asSeenByOther(const PairHit& hit, const PlanarMotion& before) {
  PairHit other = hit;
  other.impact.normal = -hit.impact.normal;
  other.impact.arm = hit.impact.otherArm;
  other.impact.otherArm = hit.impact.arm;
  const Vector2 linear = -hit.response.impulse.linear;
  other.response.impulse = {.linear = linear, .angular = cross(other.impact.arm, linear)};
  other.response.before = before;
  other.response.after = hit.response.otherAfter;
  other.response.otherAfter = hit.response.after;
  return other;
}

}  // namespace bumper
