// Where is ground, and how high?
//
// Flat triangles that are connected at corners and are wide enough for a vehicle are ground. A grid
// of cells keeps the heights of the ground triangles whose bounding rectangles touch each cell;
// heights that are close together are kept as one range. All of this errs towards more ground, and
// so towards more walls.

#include "ground_levels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "corners.h"
#include "pieces.h"
#include "single_precision.h"
#include "triangle.h"
#include "weld.h"

namespace bumper {

namespace {

/// Flat pieces narrower than this on average, m, carry no vehicle.
constexpr double narrowest = 1.0;

/// Ranges of height of one cell that are no further apart than this, m, become one.
constexpr float levelGap = 0.5F;

/// A cell has so many ranges at most: storeys of a tower. What comes after joins the nearest.
constexpr int mostLevels = 64;

/// How many cells and levels are looked at before all is taken to be in reach: enough for any scene
/// of walls no longer than 100 m.
constexpr std::size_t leastVisits = std::size_t{1} << 22U;
constexpr std::size_t visitsOfTriangle = 1024;

std::vector<FlatTriangle> flatTriangles(const Scene& scene, double maxNormalUp) {
  std::vector<FlatTriangle> flat;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const Scene::Triangle& triangle = scene.triangles[i];
    const Eigen::Vector3d& a = scene.corner(triangle, 0);
    const Eigen::Vector3d normal =
        (scene.corner(triangle, 1) - a).cross(scene.corner(triangle, 2) - a);
    if (normal.z() * normal.z() > maxNormalUp * maxNormalUp * normal.squaredNorm()) {
      flat.push_back({.triangle = i, .wide = false});
    }
  }
  return flat;
}

struct Extent {
  double area = 0.0;
  Eigen::AlignedBox2d box;
};

void findWide(const Scene& scene, const std::vector<std::uint32_t>& welded,
              std::vector<FlatTriangle>& flat) {
  Pieces pieces(welded.size());
  const auto cornerOf = [&](std::uint32_t triangle, std::size_t k) {
    return welded[scene.triangles[triangle].corners.at(k)];
  };
  for (const auto& [i, wide] : flat) {
    pieces.join(cornerOf(i, 0), cornerOf(i, 1));
    pieces.join(cornerOf(i, 0), cornerOf(i, 2));
  }
  std::vector<std::uint32_t> numbers(welded.size(), noIndex);
  std::vector<std::uint32_t> pieceOf(flat.size());
  std::vector<Extent> extents;
  for (std::size_t n = 0; n < flat.size(); ++n) {
    std::uint32_t& number = numbers[pieces.find(cornerOf(flat[n].triangle, 0))];
    if (number == noIndex) {
      number = static_cast<std::uint32_t>(extents.size());
      extents.emplace_back();
    }
    pieceOf[n] = number;
    Extent& extent = extents[number];
    const Scene::Triangle& triangle = scene.triangles[flat[n].triangle];
    const Eigen::Vector2d a = scene.corner(triangle, 0).head<2>();
    const Eigen::Vector2d u = scene.corner(triangle, 1).head<2>() - a;
    const Eigen::Vector2d v = scene.corner(triangle, 2).head<2>() - a;
    extent.area += 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
    for (std::size_t k = 0; k < 3; ++k) {
      extent.box.extend(scene.corner(triangle, k).head<2>());
    }
  }
  for (std::size_t n = 0; n < flat.size(); ++n) {
    const Extent& extent = extents[pieceOf[n]];
    flat[n].wide = extent.area >= narrowest * extent.box.diagonal().norm();
  }
}

}  // namespace

GroundLevels::Cells GroundLevels::cellsOf(const Eigen::Vector2d& low,
                                          const Eigen::Vector2d& high) const {
  const auto cell = [&](double place, std::int64_t count) {
    const double number = std::floor(place / cellSize_);
    return static_cast<std::int64_t>(std::clamp(number, -1.0, static_cast<double>(count)));
  };
  return {cell(low.x() - origin_.x(), across_), cell(high.x() - origin_.x(), across_),
          cell(low.y() - origin_.y(), deep_), cell(high.y() - origin_.y(), deep_)};
}

/// As wanted, or coarser where memory or time would grow faster than the number of triangles.
/// `boxes` are the lower and upper corners of the triangles.
void GroundLevels::chooseCellSize(const std::vector<Eigen::Vector2d>& boxes, double wanted) {
  Eigen::Vector2d high = boxes.front();
  origin_ = high;
  for (const Eigen::Vector2d& corner : boxes) {
    origin_ = origin_.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const auto most = static_cast<double>(4 * boxes.size() + 65536);
  for (cellSize_ = wanted;; cellSize_ *= 2.0) {
    const Eigen::Vector2d cells = ((high - origin_) / cellSize_).array().floor() + 1.0;
    if (cells.x() * cells.y() > most) continue;
    across_ = static_cast<std::int64_t>(cells.x());
    deep_ = static_cast<std::int64_t>(cells.y());
    double visits = 0.0;
    for (std::size_t i = 0; i < boxes.size() && visits <= most; i += 2) {
      visits += static_cast<double>(cellsOf(boxes[i], boxes[i + 1]).count());
    }
    if (visits <= most) return;
  }
}

void GroundLevels::add(std::size_t cell, float low, float high) {
  int count = 0;
  float least = std::numeric_limits<float>::infinity();
  std::uint32_t nearest = noIndex;
  for (std::uint32_t i = first_[cell]; i != noIndex; i = levels_[i].next) {
    const float gap = std::max(low - levels_[i].high, levels_[i].low - high);
    ++visits_;
    ++count;
    if (nearest != noIndex && gap >= least) continue;
    least = gap;
    nearest = i;
    if (gap <= levelGap) break;
  }
  if (least <= levelGap || count == mostLevels) {
    Level& level = levels_[nearest];
    level.low = std::min(level.low, low);
    level.high = std::max(level.high, high);
    return;
  }
  levels_.push_back({low, high, first_[cell]});
  first_[cell] = static_cast<std::uint32_t>(levels_.size() - 1);
}

GroundLevels::GroundLevels(const Scene& scene, double maxNormalUp, double distance) {
  mostVisits_ = leastVisits + visitsOfTriangle * scene.triangles.size();
  flat_ = flatTriangles(scene, maxNormalUp);
  welded_ = weld(scene.vertices);
  findWide(scene, welded_, flat_);
  std::vector<std::uint32_t> ground;
  for (const auto& [triangle, wide] : flat_) {
    if (wide) ground.push_back(triangle);
  }
  if (ground.empty()) return;
  std::vector<Eigen::Vector2d> boxes;
  boxes.reserve(2 * ground.size());
  for (const std::uint32_t i : ground) {
    const Eigen::AlignedBox3d box = boxOf(cornersOf(scene, scene.triangles[i]));
    boxes.emplace_back(box.min().head<2>());
    boxes.emplace_back(box.max().head<2>());
  }
  chooseCellSize(boxes, std::max(0.5 * distance, narrowest));
  first_.assign(static_cast<std::size_t>(across_ * deep_), noIndex);
  for (std::size_t n = 0; n < ground.size(); ++n) {
    const Eigen::AlignedBox3d box = boxOf(cornersOf(scene, scene.triangles[ground[n]]));
    const auto low =
        static_cast<float>(box.min().z() - singlePrecisionRounding * std::abs(box.min().z()));
    const auto high =
        static_cast<float>(box.max().z() + singlePrecisionRounding * std::abs(box.max().z()));
    const Cells cells = cellsOf(boxes[2 * n], boxes[2 * n + 1]);
    for (std::int64_t y = cells.near; y <= cells.far; ++y) {
      for (std::int64_t x = cells.left; x <= cells.right; ++x) {
        add(static_cast<std::size_t>(y * across_ + x), low, high);
      }
    }
  }
}

GroundLevels::Place GroundLevels::placeOf(const Wall& wall, const GroundReach& reach) {
  const Eigen::AlignedBox3d box = boxOf(wall.corners);
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(reach.distance);
  Cells cells = cellsOf(box.min().head<2>() - around, box.max().head<2>() + around);
  cells = {std::max<std::int64_t>(cells.left, 0), std::min(cells.right, across_ - 1),
           std::max<std::int64_t>(cells.near, 0), std::min(cells.far, deep_ - 1)};
  bool anyBelow = false;
  bool anyAbove = false;
  for (std::int64_t y = cells.near; y <= cells.far; ++y) {
    for (std::int64_t x = cells.left; x <= cells.right; ++x) {
      if (++visits_ > mostVisits_) return Place::within_reach;
      for (std::uint32_t i = first_[static_cast<std::size_t>(y * across_ + x)]; i != noIndex;
           i = levels_[i].next) {
        const Level& level = levels_[i];
        ++visits_;
        if (static_cast<double>(level.high) + reach.above < box.min().z()) {
          anyBelow = true;
          // A wall is judged by its whole surface from above: the ground of one whose upper end is
          // in reach may be elsewhere.
        } else if (static_cast<double>(level.low) - reach.below <=
                   std::max(box.max().z(), wall.top)) {
          return Place::within_reach;
        } else {
          anyAbove = true;
        }
      }
    }
  }
  if (anyBelow) return anyAbove ? Place::between : Place::above_ground;
  return anyAbove ? Place::below_ground : Place::without_ground;
}

}  // namespace bumper
