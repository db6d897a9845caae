#include "surface_grower.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "corners.h"

namespace bumper {

namespace {

/// Cosine of the angle, 10°, by which a surface may bend away from the triangle that it is
/// grown from.
constexpr double minSmoothness = 0.985;

}  // namespace

Eigen::Vector2d facing(const Wall& wall) {
  const Eigen::Vector2d horizontal = wall.normal.head<2>();
  const double length = horizontal.norm();
  return length > 1e-9 ? Eigen::Vector2d(horizontal / length) : Eigen::Vector2d::UnitX();
}

WallsAtCorners::WallsAtCorners(const std::vector<Corners>& corners) {
  std::size_t highest = 0;
  for (const Corners& wall : corners)
    highest = std::max<std::size_t>({highest, wall[0], wall[1], wall[2]});
  begins_.assign(highest + 2, 0);
  for (const Corners& wall : corners) {
    for (const std::uint32_t corner : wall) ++begins_[corner + 1];
  }
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  walls_.resize(corners.size() * 3);
  std::vector<std::uint32_t> filled(begins_.begin(), begins_.end() - 1);
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    for (const std::uint32_t corner : corners[i]) walls_[filled[corner]++] = i;
  }
}

SurfaceGrower::SurfaceGrower(const std::vector<Wall>& walls, const std::vector<Corners>& corners)
    : walls_(walls),
      corners_(corners),
      table_(corners),
      taken_(walls.size(), false),
      visitedFrom_(table_.corners(), noIndex) {}

std::vector<std::uint32_t> SurfaceGrower::take(std::uint32_t seed) {
  const Eigen::Vector2d direction = facing(walls_[seed]);
  std::vector<std::uint32_t> surface{seed};
  taken_[seed] = true;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    for (const std::uint32_t corner : corners_[surface[i]]) {
      // Once is enough: the corner of a large fan would cost the square of its triangles.
      if (std::exchange(visitedFrom_[corner], seed) == seed) continue;
      for (const std::uint32_t other : table_.wallsAt(corner)) {
        if (taken_[other] || std::abs(facing(walls_[other]).dot(direction)) < minSmoothness) {
          continue;
        }
        taken_[other] = true;
        surface.push_back(other);
      }
    }
  }
  return surface;
}

}  // namespace bumper
