#include "bumper/response/speculative_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tolerances.h"

namespace bumper {

namespace {

// Allowed penetration of a point, m: more than the rounding of a free motion.
constexpr double allowance = 1e-6;

// A corner that slides along a wall in a free motion may penetrate it this deep at the step's end,
// m.
constexpr double slidingCorner = 1e-4;

constexpr std::size_t thirds = 3;

// Where two walls meet each has an end there.
bool isOne(const SpeculativeContact& a, const SpeculativeContact& b) {
  constexpr double closer = 1e-3;   // m
  constexpr double cosine = 0.999;  // of the angle between their normals
  return (a.arm - b.arm).cwiseAbs().maxCoeff() < closer && a.normal.dot(b.normal) > cosine;
}

// Which third of a side a place along it belongs to.
std::size_t thirdOf(const OutlineSide& side, double along) {
  const double share = (along - side.low) / (side.high - side.low);
  return static_cast<std::size_t>(std::clamp(share, 0.0, 0.99) * thirds);
}

}  // namespace

void SpeculativeContacts::begin(const Outline& outline, const PlanarMotion& start,
                                const PlanarMotion& end, double distance, double step) {
  outline_ = outline;
  from_ = start.placement();
  to_ = end.placement();
  carrying_ = end;
  carrying_.velocity = (end.position - start.position) / step;
  carrying_.yawRate = (end.yaw - start.yaw) / step;
  distance_ = distance;
  count_ = 0;
}

void SpeculativeContacts::add(std::size_t place, SpeculativeContact contact, double depth) {
  contact.velocity = velocityAt(carrying_, contact.arm);
  contact.room = std::max(contact.gap + depth, 0.0) + allowance;
  std::size_t same = 0;
  std::size_t farthest = count_;
  for (std::size_t i = 0; i < count_; ++i) {
    if (isOne(contacts_[i], contact)) {
      if (contact.gap < contacts_[i].gap) contacts_[i] = contact;
      return;
    }
    if (places_[i] != place) continue;
    ++same;
    if (farthest == count_ || contacts_[i].gap > contacts_[farthest].gap) farthest = i;
  }
  if (same < perPlace) {
    places_[count_] = place;
    contacts_[count_++] = contact;
  } else if (contact.gap < contacts_[farthest].gap) {
    contacts_[farthest] = contact;
  }
}

void SpeculativeContacts::addEnd(const Segment& wall, const Vector2& wallEnd, double depth) {
  const Vector2 place = to_.local(wallEnd);
  const std::array<OutlineSide, 4> sides = outline_.sides();
  const auto distanceTo = [&](const OutlineSide& side) { return side.out.dot(place) - side.reach; };
  double nearest = distanceTo(sides.front());
  for (const OutlineSide& side : sides) nearest = std::max(nearest, distanceTo(side));
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const OutlineSide& side = sides[i];
    const double distance = distanceTo(side);
    const double gap = distance - wall.radius;
    // A point inside the outline entered through the nearest side.
    const double deepest = distance == nearest ? depth + slidingDepth : 0.0;
    if (gap < -deepest || gap > distance_) continue;
    const double along = turnedLeft(side.out).dot(place);
    if (along < side.low - touchTolerance || along > side.high + touchTolerance) continue;
    const Vector2 normal = -to_.turned(side.out);
    add(4 + thirds * i + thirdOf(side, along),
        {.wall = wall.id,
         .surface = wall.surface,
         .normal = normal,
         .arm = wallEnd - to_.position + distance * normal,
         .gap = gap},
        depth);
  }
}

void SpeculativeContacts::addWall(const Segment& wall, const Overlap* touch, double depth) {
  const bool byFace = touch != nullptr && !touch->byEnd;
  if (!wall.isPost()) {
    const Overlap line = byFace ? *touch : lineOf(wall, from_.position);
    const Vector2 tangent = turnedLeft(line.normal);
    const std::array<Vector2, 4> corners = outline_.corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vector2 arm = to_.turned(corners[k]);
      const Vector2 place = to_.position + arm;
      const double gap = line.normal.dot(place) - line.offset;
      // One that is behind the wall, and the wall not in the outline, has come round its end.
      if (gap > distance_ || (!byFace && gap < -(depth + slidingCorner))) continue;
      const double along = tangent.dot(place);
      if (along < line.start - touchTolerance || along > line.end + touchTolerance) continue;
      add(k,
          {.wall = wall.id, .surface = wall.surface, .normal = line.normal, .arm = arm, .gap = gap},
          depth);
    }
  }
  if (touch != nullptr && touch->byEnd) {
    // Wherever on the outline it is at the step's end.
    add(4 + 4 * thirds,
        {.wall = wall.id,
         .surface = wall.surface,
         .normal = touch->normal,
         .arm = to_.turned(from_.turnedBack(firstPoint(from_.position, *touch).arm)),
         .gap = std::min(-touch->depth, 0.0)},
        depth);
  }
  addEnd(wall, wall.start, depth);
  if (!wall.isPost()) addEnd(wall, wall.end, depth);
}

}  // namespace bumper
