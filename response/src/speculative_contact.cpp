#include "bumper/response/speculative_contact.h"

#include <algorithm>
#include <cmath>

namespace bumper {

namespace {

// By which a point may pass its wall, m: more than what rounds in a free motion.
constexpr double allowance = 1e-6;

// What slides along a wall or its end in a free motion may be so deep in it when the step is over,
// m: a corner, and an end in a side.
constexpr double slidingCorner = 1e-4;
constexpr double slidingEnd = 0.05;

constexpr std::size_t thirds = 3;

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

// Where two walls meet each has an end there.
bool isOne(const SpeculativeContact& a, const SpeculativeContact& b) {
  constexpr double closer = 1e-3;   // m
  constexpr double cosine = 0.999;  // of the angle between their normals
  return (a.arm - b.arm).cwiseAbs().maxCoeff() < closer && a.normal.dot(b.normal) > cosine;
}

std::size_t thirdOf(const Facing& facing) {
  const double share = 0.5 * (facing.fromMiddle / facing.halfLength + 1.0);
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

void SpeculativeContacts::addEnd(const WallSegment& wall, const Vector2& wallEnd, double depth) {
  const std::array<Facing, 4> sides = facings(outline_, to_.local(wallEnd));
  double nearest = sides.front().gap;
  for (const Facing& facing : sides) nearest = std::max(nearest, facing.gap);
  for (std::size_t side = 0; side < sides.size(); ++side) {
    const Facing& facing = sides[side];
    const double gap = facing.gap - wall.radius;
    // What is in the outline came in over the nearest side.
    const double deepest = facing.gap == nearest ? depth + slidingEnd : 0.0;
    if (gap < -deepest || gap > distance_) continue;
    if (std::abs(facing.fromMiddle) > facing.halfLength + touchTolerance) continue;
    const Vector2 normal = -to_.turned(facing.out);
    add(4 + thirds * side + thirdOf(facing),
        {.wall = wall.id,
         .settings = wall.settings,
         .normal = normal,
         .arm = wallEnd - to_.position + facing.gap * normal,
         .gap = gap},
        depth);
  }
}

void SpeculativeContacts::addWall(const WallSegment& wall, const Overlap* touch, double depth) {
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
          {.wall = wall.id,
           .settings = wall.settings,
           .normal = line.normal,
           .arm = arm,
           .gap = gap},
          depth);
    }
  }
  if (touch != nullptr && touch->byEnd) {
    // Wherever on the outline it is when the step is over.
    add(4 + 4 * thirds,
        {.wall = wall.id,
         .settings = wall.settings,
         .normal = touch->normal,
         .arm = to_.turned(from_.turnedBack(firstPoint(from_.position, *touch).arm)),
         .gap = std::min(-touch->depth, 0.0)},
        depth);
  }
  addEnd(wall, wall.start, depth);
  if (!wall.isPost()) addEnd(wall, wall.end, depth);
}

}  // namespace bumper
