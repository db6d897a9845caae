#include "bumper/response/speculative_contact.h"

#include <algorithm>
#include <cmath>

namespace bumper {

namespace {

// By which a point may pass its wall, m: more than what rounds in a free motion.
constexpr double allowance = 1e-6;

// A wall's end or a post before one side of the outline.
struct Facing {
  Vector2 out;        // the side's normal outwards, in the vehicle's frame
  double gap;         // m
  double fromMiddle;  // of the side, along it, m
  double halfLength;  // of the side, m
};

// `place` is in the vehicle's frame.
std::array<Facing, 4> facings(const Outline& outline, const Vector2& place) {
  const double half = 0.5 * (outline.front + outline.rear);
  const double ahead = place.x() - 0.5 * (outline.front - outline.rear);
  return {{{{1.0, 0.0}, place.x() - outline.front, place.y(), outline.halfWidth},
           {{-1.0, 0.0}, -place.x() - outline.rear, place.y(), outline.halfWidth},
           {{0.0, 1.0}, place.y() - outline.halfWidth, ahead, half},
           {{0.0, -1.0}, -place.y() - outline.halfWidth, ahead, half}}};
}

}  // namespace

void SpeculativeContacts::add(const SpeculativeContact& contact) {
  // The place behind all that are no further.
  std::size_t place = count_;
  while (place > 0 && contact.gap < contacts_[place - 1].gap) --place;
  if (place == most) return;
  if (count_ < most) ++count_;
  for (std::size_t k = count_ - 1; k > place; --k) contacts_[k] = contacts_[k - 1];
  contacts_[place] = contact;
}

void addSpeculativeContacts(const Outline& outline, const PlanarMotion& start,
                            const PlanarMotion& end, const WallSegment& wall, const Overlap* touch,
                            double distance, double step, SpeculativeContacts& contacts) {
  const Placement from = start.placement();
  const Placement to = end.placement();
  // What carries the vehicle from one to the other, as an engine does.
  const Vector2 velocity = (to.position - from.position) / step;
  const double yawRate = (end.yaw - start.yaw) / step;
  const auto add = [&](const Vector2& normal, const Vector2& arm, double gap) {
    const double speed = normal.dot(velocity + yawRate * turnedLeft(arm));
    contacts.add({.wall = wall.id,
                  .settings = wall.settings,
                  .normal = normal,
                  .arm = arm,
                  .gap = gap,
                  .leastSpeed = speed - (std::max(gap, 0.0) + allowance) / step});
  };

  const bool byFace = touch != nullptr && !touch->byEnd;
  if (!wall.isPost()) {
    const Overlap line = byFace ? *touch : lineOf(wall, from.position);
    const Vector2 tangent = turnedLeft(line.normal);
    for (const Vector2& corner : outline.corners()) {
      const Vector2 arm = to.turned(corner);
      const Vector2 place = to.position + arm;
      const double gap = line.normal.dot(place) - line.offset;
      // One that is behind the wall, and the wall not in the outline, has come round its end.
      if (gap > distance || (!byFace && gap < -allowance)) continue;
      const double along = tangent.dot(place);
      if (along < line.start - touchTolerance || along > line.end + touchTolerance) continue;
      add(line.normal, arm, gap);
    }
  }

  const auto addEnd = [&](const Vector2& wallEnd) {
    for (const Facing& facing : facings(outline, to.local(wallEnd))) {
      const double gap = facing.gap - wall.radius;
      if (gap < -allowance || gap > distance) continue;
      if (std::abs(facing.fromMiddle) > facing.halfLength + touchTolerance) continue;
      const Vector2 normal = -to.turned(facing.out);
      add(normal, wallEnd - to.position + facing.gap * normal, gap);
    }
  };
  if (touch != nullptr && touch->byEnd) {
    // Wherever on the outline it is when the step is over.
    const Vector2 arm = to.turned(from.turnedBack(firstPoint(from.position, *touch).arm));
    add(touch->normal, arm, std::min(-touch->depth, 0.0));
    return;
  }
  addEnd(wall.start);
  if (!wall.isPost()) addEnd(wall.end);
}

}  // namespace bumper
