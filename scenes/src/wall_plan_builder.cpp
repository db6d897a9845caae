#include "wall_plan_builder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "plan_segment.h"

namespace bumper {

namespace {

// A longer line would be in too many cells, m.
constexpr double longestLine = 32.0;

}  // namespace

/// A wall in plan: its longest side, and the corner that is left.
struct WallPlan::Builder::Footprint {
  explicit Footprint(const Wall& wall) {
    std::array<Vector2, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = wall.corners[k].head<2>();
    std::size_t third = 0;
    double longest = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = (corners[(k + 2) % 3] - corners[(k + 1) % 3]).norm();
      if (length <= longest) continue;
      longest = length;
      third = k;
    }
    from = corners[(third + 1) % 3];
    to = corners[(third + 2) % 3];
    other = corners[third];
  }

  Vector2 from;
  Vector2 to;
  Vector2 other;
};

WallPlan::Builder::Builder(std::vector<Node>& nodes, Vector2 origin, double roundingError)
    : nodes_(nodes), origin_(std::move(origin)), roundingError_(roundingError) {}

void WallPlan::Builder::add(const Wall& added) {
  Footprint wall(added);
  const double width = planDistance(wall.from, wall.to, wall.other);
  if (width > coarseness) {
    finish();
    addWide(wall);
    return;
  }
  if (!points_.empty()) {
    if (coversAll(from_, to_, wall)) {
      keep(wall);
      return;
    }
    // A line that has only begun may go on at either end.
    const bool goesOnAtStart = isFirst_ && (isAt(from_, wall.from) || isAt(from_, wall.to)) &&
                               !isAt(to_, wall.from) && !isAt(to_, wall.to);
    if (goesOnAtStart) std::swap(from_, to_);
    if (isAt(to_, wall.to)) std::swap(wall.from, wall.to);
    if (isAt(to_, wall.from)) {
      if (canReplaceEnd(wall)) {
        to_ = wall.to;
        keep(wall);
        return;
      }
      if (coversAll(to_, wall.to, wall)) {
        writeLine();
        begin(to_, wall.to, wall);
        isFirst_ = false;
        return;
      }
    }
    finish();
  }
  begin(wall.from, wall.to, wall);
  isFirst_ = true;
}

void WallPlan::Builder::finish() {
  if (points_.empty()) return;
  writeLine();
  writeNode(to_, -1.0);
  points_.clear();
}

bool WallPlan::Builder::isAt(const Vector2& a, const Vector2& b) {
  return (a - b).norm() <= coarseness;
}

bool WallPlan::Builder::coversAll(const Vector2& from, const Vector2& to, const Footprint& wall) {
  return planDistance(from, to, wall.from) <= coarseness &&
         planDistance(from, to, wall.to) <= coarseness &&
         planDistance(from, to, wall.other) <= coarseness;
}

bool WallPlan::Builder::canReplaceEnd(const Footprint& wall) const {
  return (wall.to - from_).norm() <= longestLine && coversAll(from_, wall.to, wall) &&
         std::all_of(points_.begin(), points_.end(), [&](const Vector2& point) {
           return planDistance(from_, wall.to, point) <= coarseness;
         });
}

void WallPlan::Builder::begin(const Vector2& from, const Vector2& to, const Footprint& wall) {
  points_.clear();
  from_ = from;
  to_ = to;
  keep(wall);
}

void WallPlan::Builder::keep(const Footprint& wall) {
  for (const Vector2& point : {wall.from, wall.to, wall.other}) {
    if (std::find(points_.begin(), points_.end(), point) == points_.end()) {
      points_.push_back(point);
    }
  }
}

// The line that is being put together, without its end.
void WallPlan::Builder::writeLine() {
  double thickness = 0.0;
  for (const Vector2& point : points_) {
    thickness = std::max(thickness, planDistance(from_, to_, point));
  }
  writeNode(from_, thickness + roundingError_);
}

// One that leans: the line runs along the middle of its triangle.
void WallPlan::Builder::addWide(const Footprint& wall) {
  const Vector2 along = wall.to - wall.from;
  const Vector2 foot =
      wall.from + (wall.other - wall.from).dot(along) / along.squaredNorm() * along;
  const Vector2 aside = 0.5 * (wall.other - foot);
  writeNode(wall.from + aside, aside.norm() + roundingError_);
  writeNode(wall.to + aside, -1.0);
}

void WallPlan::Builder::writeNode(const Vector2& place, double thickness) {
  const Vector2 local = place - origin_;
  nodes_.push_back({static_cast<float>(local.x()), static_cast<float>(local.y()),
                    static_cast<float>(thickness)});
}

}  // namespace bumper
