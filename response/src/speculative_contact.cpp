#include "bumper/response/speculative_contact.h"

#include <algorithm>
#include <cmath>

#include "bumper/response/collision_step.h"
#include "penetration_recovery.h"

namespace bumper {

namespace {

constexpr double micrometre = 1e-6;

// When a gap closes at a speed, s; 0 if it does not close within the step.
double timeToClose(double gap, double speed, double step) {
  return gap > 0.0 && speed > 0.0 && gap <= speed * step ? gap / speed : 0.0;
}

// A wall's end or a post before one side of the outline: `place` in the vehicle's frame.
struct Facing {
  Vector2 out;        // the side's normal outwards, in the vehicle's frame
  double gap;         // m
  double along;       // where on the side, m from its middle
  double halfLength;  // of the side, m
};

std::array<Facing, 4> facings(const Outline& outline, const Vector2& place) {
  const double middle = 0.5 * (outline.front - outline.rear);
  const double half = 0.5 * (outline.front + outline.rear);
  const double fromMiddle = place.x() - middle;
  return {{{{1.0, 0.0}, place.x() - outline.front, place.y(), outline.halfWidth},
           {{-1.0, 0.0}, -place.x() - outline.rear, place.y(), outline.halfWidth},
           {{0.0, 1.0}, place.y() - outline.halfWidth, fromMiddle, half},
           {{0.0, -1.0}, -place.y() - outline.halfWidth, fromMiddle, half}}};
}

}  // namespace

void SpeculativeContacts::add(const SpeculativeContact& contact) {
  const auto begin = contacts_.begin();
  const auto place = std::find_if(begin, begin + count_, [&](const SpeculativeContact& each) {
    return contact.gap < each.gap;
  });
  if (place == contacts_.end()) return;
  if (count_ < most) ++count_;
  std::move_backward(place, begin + count_ - 1, begin + count_);
  *place = contact;
}

void addSpeculativeContacts(const Outline& outline, const PlanarMotion& motion,
                            const WallSegment& wall, const Overlap* touch, double distance,
                            double step, SpeculativeContacts& contacts) {
  const Placement at = motion.placement();
  SpeculativeContact contact{.wall = wall.id, .settings = wall.settings};

  if (!wall.isPost()) {
    const bool byFace = touch != nullptr && !touch->byEnd;
    const Overlap line = byFace ? *touch : lineOf(wall, at.position);
    const Vector2 tangent = turnedLeft(line.normal);
    for (const Vector2& corner : outline.corners()) {
      contact.normal = line.normal;
      contact.arm = at.turned(corner);
      const Vector2 place = at.position + contact.arm;
      contact.gap = line.normal.dot(place) - line.offset;
      if (contact.gap > distance || (!byFace && contact.gap < -touchTolerance)) continue;
      const Vector2 velocity = velocityAt(motion, contact.arm);
      const double time = timeToClose(contact.gap, -line.normal.dot(velocity), step);
      const double along = tangent.dot(place + time * velocity);
      if (along < line.start - touchTolerance || along > line.end + touchTolerance) continue;
      contacts.add(contact);
    }
  }

  const auto addEnd = [&](const Vector2& end) {
    const Vector2 place = at.local(end);
    const Vector2 approach = -at.turnedBack(velocityAt(motion, end - at.position));
    for (const Facing& facing : facings(outline, place)) {
      const double gap = facing.gap - wall.radius;
      if (gap < -touchTolerance || gap > distance) continue;
      const double time = timeToClose(gap, -facing.out.dot(approach), step);
      const Vector2 side = turnedLeft(facing.out).cwiseAbs();
      const double along = facing.along + time * side.dot(approach);
      if (std::abs(along) > facing.halfLength + touchTolerance) continue;
      contact.normal = -at.turned(facing.out);
      contact.arm = end - at.position + (facing.gap) * contact.normal;
      contact.gap = gap;
      contacts.add(contact);
    }
  };
  if (touch != nullptr && touch->byEnd) {
    contact.normal = touch->normal;
    contact.arm = firstPoint(at.position, *touch).arm;
    contact.gap = -touch->depth;
    contacts.add(contact);
    return;
  }
  addEnd(wall.start);
  if (!wall.isPost()) addEnd(wall.end);
}

double leastNormalSpeed(const SpeculativeContact& contact, double yawRate, double step) {
  const double turned = yawRate * step;
  const double room = contact.gap + 0.5 * turned * turned * contact.arm.norm() + micrometre;
  return room >= 0.0 ? -room / step : recoverySpeed(-room, step, CollisionStep::maxEaseOut);
}

}  // namespace bumper
