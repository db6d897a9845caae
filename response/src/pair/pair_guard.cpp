#include <algorithm>

#include "bumper/response/pair.h"
#include "bumper/response/speculative_contact.h"
#include "convex_polygon.h"

namespace bumper {

namespace {

// Allowed overlap, m: more than the rounding of a free motion.
constexpr double pairAllowance = 1e-6;

// Two points that are nearer to each other than this, m, are one: redundant constraints are a
// problem for dWorldStep.
constexpr double onePoint = 0.02;

// By how much the outlines are grown to overlap where they are nearest, m.
constexpr double grownBy = 1e-3;

// How an engine carries it through the step.
PlanarMotion carriedThrough(const OutlineInStep& body, double step) {
  PlanarMotion carrying = body.end;
  carrying.velocity = (body.end.position - body.start.position) / step;
  carrying.yawRate = (body.end.yaw - body.start.yaw) / step;
  return carrying;
}

}  // namespace

SpeculativePairContacts speculativePairContacts(const OutlineInStep& first,
                                                const OutlineInStep& second, double distance,
                                                double depth, double step) {
  SpeculativePairContacts result;
  const Placement at = first.end.placement();
  const Placement otherAt = second.end.placement();
  const PairSeparation apart = separation(first.outline, at, second.outline, otherAt);
  if (!(apart.distance <= distance)) return result;
  const double grown = 0.5 * std::max(apart.distance, 0.0) + grownBy;
  ConvexPolygon facing(first.outline.grown(grown), at);
  for (const FaceLine& face : faceLines(second.outline.grown(grown), otherAt)) {
    facing.clip(face.normal, face.offset);
  }
  if (facing.isEmpty()) return result;
  const auto [low, high] = facing.endsAlong(turnedLeft(apart.normal));
  const PlanarMotion own = carriedThrough(first, step);
  const PlanarMotion other = carriedThrough(second, step);
  const auto add = [&](const Vector2& place) {
    SpeculativePairContact& contact = result.contacts[result.count++];
    contact.normal = apart.normal;
    contact.arm = place - at.position;
    // An engine has one place for both, while they still are where the step begins.
    contact.otherArm = first.start.position + contact.arm - second.start.position;
    contact.velocity = velocityAt(own, contact.arm) - velocityAt(other, contact.otherArm);
    contact.gap = apart.distance;
    contact.room = std::max(apart.distance + depth, 0.0) + pairAllowance;
  };
  if ((high - low).norm() < onePoint) {
    add(0.5 * (low + high));
  } else {
    add(low);
    add(high);
  }
  return result;
}

}  // namespace bumper
