#include "tall_walls.h"

#include <algorithm>
#include <cmath>

#include "bumper/scenes/wall_feet.h"
#include "plan_segment.h"
#include "triangle.h"

namespace bumper {

namespace {

/// The nearest point to another in plan; of a wall that leans one of its edges' is near enough.
Vector2 nearestOf(const TriangleCorners& wall, const Vector2& point) {
  Vector2 nearest = wall[0].head<2>();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2 each = nearestPoint(wall[k].head<2>(), wall[(k + 1) % 3].head<2>(), point);
    if ((each - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = each;
  }
  return nearest;
}

std::vector<Eigen::AlignedBox3d> boxesOf(const std::vector<Wall>& walls) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(walls.size());
  for (const Wall& wall : walls) {
    Eigen::AlignedBox3d box = boxOf(wall.corners);
    box.min().z() = wall.foot;
    box.max().z() = wall.top;
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

TallWalls::TallWalls(const std::vector<Wall>& walls) : walls_(walls), tree_(boxesOf(walls)) {}

std::optional<Surroundings> TallWalls::around(const Vector2& place, double top) {
  Surroundings result;
  const auto enter = [&](double distance2, double foot, double height) {
    if (visits_ == 0) return false;
    --visits_;
    return distance2 < result.squaredDistance || foot < result.foot || height > result.top;
  };
  const Eigen::AlignedBox3d tallEnough(Eigen::Vector3d(place.x(), place.y(), top + minRise),
                                       Eigen::Vector3d(place.x(), place.y(), top + footReach));
  tree_.search(tallEnough, footReach, enter, [&](std::uint32_t i) {
    const Wall& wall = walls_[i];
    const Vector2 nearest = nearestOf(wall.corners, place);
    const double distance2 = (nearest - place).squaredNorm();
    if (distance2 > footReach * footReach) return;
    if (distance2 < result.squaredDistance) {
      result.nearestWall = i;
      result.nearest = nearest;
      result.squaredDistance = distance2;
    }
    result.foot = std::min(result.foot, wall.foot);
    result.top = std::max(result.top, wall.top);
  });
  if (visits_ == 0 || !std::isfinite(result.squaredDistance)) return std::nullopt;
  return result;
}

}  // namespace bumper
