#include "wall_merge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "../tolerances.h"
#include "bumper/response/response_settings.h"

namespace bumper {

namespace {

// Pieces of one wall lie in one line within these. A gap between them no wider than that is
// bridged: no part of a vehicle fits into it.
constexpr double crackWidth = 0.1;    // m
constexpr double mergeOffset = 1e-4;  // m

Segment oriented(const Segment& wall, const Vector2& centre) {
  Segment result = wall;
  if (wall.isPost()) {
    result.normal = Vector2::Zero();
    return result;
  }
  result.normal = normalTowards(wall, centre);
  const Vector2 tangent = turnedLeft(result.normal);
  if (tangent.dot(wall.start) > tangent.dot(wall.end)) std::swap(result.start, result.end);
  return result;
}

// Fixed, or parts of one body.
bool moveAlike(const Surface& a, const Surface& b) {
  if (!a.moves && !b.moves) return true;
  return a.moves && b.moves && a.motion.position == b.motion.position &&
         a.motion.yaw == b.motion.yaw && a.motion.velocity == b.motion.velocity &&
         a.motion.yawRate == b.motion.yawRate;
}

bool answerAlike(const Surface& a, const Surface& b) {
  if (&a == &b) return true;
  if (!moveAlike(a, b)) return false;
  return a.settings == b.settings && !a.entered && !b.entered && !breaks(*a.settings);
}

bool continues(const Segment& wall, const Segment& piece, std::span<const Surface> surfaces) {
  if (std::abs(cross(wall.normal, piece.normal)) > inLine) return false;
  if (!answerAlike(surfaces[static_cast<std::size_t>(wall.surface)],
                   surfaces[static_cast<std::size_t>(piece.surface)])) {
    return false;
  }
  if (wall.isPost() || piece.isPost() || wall.solid != piece.solid) return false;
  if (wall.normal.dot(piece.normal) < 0.0) return false;
  if (std::abs(wall.normal.dot(piece.start - wall.start)) > mergeOffset) return false;
  if (std::abs(wall.normal.dot(piece.end - wall.start)) > mergeOffset) return false;
  const Vector2 tangent = turnedLeft(wall.normal);
  return tangent.dot(piece.start - wall.end) <= crackWidth &&
         tangent.dot(wall.start - piece.end) <= crackWidth;
}

}  // namespace

std::span<const Segment> WallMerge::merge(std::span<const Segment> segments,
                                          std::span<const Surface> surfaces,
                                          const Vector2& centre) {
  given_ = segments;
  oriented_.clear();
  order_.clear();
  for (const Segment& wall : segments) {
    const Segment& piece = oriented_.emplace_back(oriented(wall, centre));
    order_.push_back({.piece = oriented_.size() - 1,
                      .place = turnedLeft(piece.normal).dot(piece.start),
                      .length = (piece.end - piece.start).norm()});
  }
  // An order that does not depend on the mesh's; along one line it is the order of the pieces.
  const auto others = [this](const Ordered& each) {
    const Segment& wall = oriented_[each.piece];
    return std::tuple(turnedLeft(wall.normal).dot(wall.end), wall.normal.x(), wall.normal.y(),
                      wall.start.x(), wall.start.y(), wall.id);
  };
  std::sort(order_.begin(), order_.end(), [&others](const Ordered& a, const Ordered& b) {
    return a.place != b.place ? a.place < b.place : others(a) < others(b);
  });
  // A wall has the line of its longest piece, from whichever end it is seen.
  merged_.clear();
  while (merged_.size() < order_.size()) {
    const auto longest =
        std::max_element(order_.begin(), order_.end(), [](const Ordered& a, const Ordered& b) {
          return a.merged != b.merged ? a.merged : !a.merged && a.length < b.length;
        });
    if (longest->merged) break;
    longest->merged = true;
    join(merged_.emplace_back(oriented_[longest->piece]), surfaces);
  }
  return merged_;
}

// Adds all pieces that continue a wall at either end, and on from there.
void WallMerge::join(Segment& wall, std::span<const Surface> surfaces) {
  const Vector2 tangent = turnedLeft(wall.normal);
  const Vector2 origin = wall.start;
  double low = 0.0;
  const double length = tangent.dot(wall.end - origin);
  double high = length;
  bool grows = false;
  const auto add = [&](Ordered& each) {
    const Segment& piece = oriented_[each.piece];
    if (each.merged || !continues(wall, piece, surfaces)) return;
    each.merged = grows = true;
    // On the line itself: a touch is looked for along the line, and found at the segment.
    low = std::min(low, tangent.dot(piece.start - origin));
    high = std::max(high, tangent.dot(piece.end - origin));
    if (low < 0.0) wall.start = origin + low * tangent;
    if (high > length) wall.end = origin + high * tangent;
  };
  // In order, so that once there and back is enough for a row.
  do {
    grows = false;
    std::for_each(order_.begin(), order_.end(), add);
    std::for_each(order_.rbegin(), order_.rend(), add);
  } while (grows);
}

int WallMerge::pieceAt(const Segment& merged, const Vector2& point) const {
  int nearest = -1;
  double best = std::numeric_limits<double>::infinity();
  for (const Segment& piece : given_) {
    if (piece.isPost() != merged.isPost()) continue;
    if (std::abs(cross(piece.normal, merged.normal)) > inLine) continue;
    const Vector2 along = piece.end - piece.start;
    const double length2 = along.squaredNorm();
    const double share =
        length2 > 0.0 ? std::clamp((point - piece.start).dot(along) / length2, 0.0, 1.0) : 0.0;
    const double distance = std::abs((point - piece.start - share * along).norm() - piece.radius);
    if (distance < best || (distance == best && piece.id < nearest)) {
      best = distance;
      nearest = piece.id;
    }
  }
  return nearest;
}

}  // namespace bumper
