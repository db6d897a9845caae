#include "wall_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "scenes.h"

namespace bumper::benchmark {

namespace {

double distanceToSegment(const Vector2& point, const Vector2& start, const Vector2& end) {
  const Vector2 along = end - start;
  const double share = std::clamp((point - start).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (start + share * along - point).norm();
}

double distanceToBox(const Vector2& point, const Vector2& low, const Vector2& high) {
  return (point - point.cwiseMax(low).cwiseMin(high)).norm();
}

bool meets(const Vector2& low, const Vector2& high, const PlanSegment& wall) {
  if (std::max(wall.start.x(), wall.end.x()) < low.x() ||
      std::min(wall.start.x(), wall.end.x()) > high.x() ||
      std::max(wall.start.y(), wall.end.y()) < low.y() ||
      std::min(wall.start.y(), wall.end.y()) > high.y()) {
    return false;
  }
  const Vector2 across = turnedLeft(wall.end - wall.start);
  const double offset = across.dot(wall.start);
  const double middle = across.dot(0.5 * (low + high)) - offset;
  const double extent = 0.5 * (std::abs(across.x()) * (high.x() - low.x()) +
                               std::abs(across.y()) * (high.y() - low.y()));
  return std::abs(middle) <= extent;
}

double gapToBox(const Vector2& low, const Vector2& high, const PlanSegment& wall) {
  if (meets(low, high, wall)) return 0.0;
  double gap = std::min(distanceToBox(wall.start, low, high), distanceToBox(wall.end, low, high));
  for (const Vector2& corner :
       {low, high, Vector2(low.x(), high.y()), Vector2(high.x(), low.y())}) {
    gap = std::min(gap, distanceToSegment(corner, wall.start, wall.end));
  }
  return gap;
}

PlanSegment inVehicle(const PlanPlace& place, const PlanSegment& wall) {
  return {.start = place.toVehicle(wall.start), .end = place.toVehicle(wall.end)};
}

Vector2 lowOf(const Outline& outline) { return {-outline.rear, -outline.halfWidth}; }
Vector2 highOf(const Outline& outline) { return {outline.front, outline.halfWidth}; }

// The walls of a scene from above: the longest side of each upright triangle, each once.
std::vector<PlanSegment> segmentsOf(const Scene& scene) {
  const Scene walls = wallsAlone(scene);
  std::set<std::tuple<double, double, double, double>> known;
  std::vector<PlanSegment> result;
  for (const Scene::Triangle& triangle : walls.triangles) {
    std::array<Vector2, 3> corners;
    double foot = std::numeric_limits<double>::infinity();
    double top = -foot;
    for (std::size_t k = 0; k < 3; ++k) {
      corners.at(k) = walls.corner(triangle, k).head<2>();
      foot = std::min(foot, walls.corner(triangle, k).z());
      top = std::max(top, walls.corner(triangle, k).z());
    }
    if (foot > bandTop || top < bandBottom) continue;
    PlanSegment longest;
    for (std::size_t k = 0; k < 3; ++k) {
      PlanSegment side{.start = corners.at(k), .end = corners.at((k + 1) % 3)};
      if (std::pair(side.end.x(), side.end.y()) < std::pair(side.start.x(), side.start.y())) {
        std::swap(side.start, side.end);
      }
      if ((side.end - side.start).norm() > (longest.end - longest.start).norm()) longest = side;
    }
    if (known.emplace(longest.start.x(), longest.start.y(), longest.end.x(), longest.end.y())
            .second) {
      result.push_back(longest);
    }
  }
  return result;
}

}  // namespace

double gapBetween(const Outline& outline, const PlanPlace& place, const PlanSegment& wall) {
  return gapToBox(lowOf(outline), highOf(outline), inVehicle(place, wall));
}

bool overlap(const Outline& outline, const PlanPlace& place, const PlanSegment& wall) {
  return meets(lowOf(outline), highOf(outline), inVehicle(place, wall));
}

WallGrid::WallGrid(const Scene& scene, double distance) {
  const std::vector<PlanSegment> all = segmentsOf(scene);
  wallCount_ = all.size();
  Vector2 high = Vector2::Constant(-std::numeric_limits<double>::infinity());
  low_ = -high;
  for (const PlanSegment& wall : all) {
    low_ = low_.cwiseMin(wall.start).cwiseMin(wall.end);
    high = high.cwiseMax(wall.start).cwiseMax(wall.end);
  }
  low_.array() -= distance;
  high.array() += distance;
  columns_ = std::ceil((high.x() - low_.x()) * perCell_);
  rows_ = std::ceil((high.y() - low_.y()) * perCell_);
  const auto columns = static_cast<std::size_t>(columns_);
  const auto rows = static_cast<std::size_t>(rows_);

  const auto forCells = [&](const PlanSegment& wall, const auto& use) {
    const Vector2 from = (wall.start.cwiseMin(wall.end) - low_).array() - distance;
    const Vector2 to = (wall.start.cwiseMax(wall.end) - low_).array() + distance;
    const auto index = [](double value, std::size_t count) {
      return std::min(static_cast<std::size_t>(std::max(0.0, value * perCell_)), count - 1);
    };
    for (std::size_t row = index(from.y(), rows); row <= index(to.y(), rows); ++row) {
      for (std::size_t column = index(from.x(), columns); column <= index(to.x(), columns);
           ++column) {
        const Vector2 corner =
            low_ + cellSize_ * Vector2(static_cast<double>(column), static_cast<double>(row));
        const Vector2 opposite = corner + Vector2::Constant(cellSize_);
        if (gapToBox(corner, opposite, wall) <= distance) use(row * columns + column);
      }
    }
  };
  std::vector<std::uint32_t> counts(rows * columns, 0);
  for (const PlanSegment& wall : all) {
    forCells(wall, [&](std::size_t cell) { ++counts[cell]; });
  }
  first_.reserve(counts.size() + 1);
  first_.push_back(0);
  for (const std::uint32_t count : counts) first_.push_back(first_.back() + count);
  walls_.resize(first_.back());
  for (const PlanSegment& wall : all) {
    forCells(wall, [&](std::size_t cell) { walls_[first_[cell + 1] - counts[cell]--] = wall; });
  }
}

}  // namespace bumper::benchmark
