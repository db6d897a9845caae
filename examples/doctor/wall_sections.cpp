#include "wall_sections.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace bumper::doctor {

namespace {

constexpr double gridCell = 8.0;          // m
constexpr double mostGridCells = 1024.0;  // of one wall
constexpr double shortestLine = 1e-6;     // m

long cellOf(double coordinate) { return std::lround(std::floor(coordinate / gridCell)); }

Eigen::AlignedBox2d boxOf(const Wall& wall) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& corner : wall.corners) box.extend(corner.head<2>());
  return box;
}

}  // namespace

WallSections::WallSections(const std::vector<Wall>& walls) : walls_(walls) {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Eigen::AlignedBox2d box = boxOf(walls[i]);
    const Vector2 cells = (box.sizes() / gridCell).array() + 1.0;
    if (cells.prod() > mostGridCells) {
      large_.push_back(i);
      continue;
    }
    for (long x = cellOf(box.min().x()); x <= cellOf(box.max().x()); ++x) {
      for (long y = cellOf(box.min().y()); y <= cellOf(box.max().y()); ++y)
        cells_[{x, y}].push_back(i);
    }
  }
}

std::vector<WallLine> WallSections::around(const DrivingPlane& plane, double radius,
                                           std::span<const double> heights) const {
  std::vector<std::size_t> found = large_;
  const Vector2 centre = plane.origin.head<2>();
  for (long x = cellOf(centre.x() - radius); x <= cellOf(centre.x() + radius); ++x) {
    const auto end = cells_.upper_bound({x, cellOf(centre.y() + radius)});
    for (auto cell = cells_.lower_bound({x, cellOf(centre.y() - radius)}); cell != end; ++cell)
      found.insert(found.end(), cell->second.begin(), cell->second.end());
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());

  std::vector<WallLine> lines;
  for (const std::size_t i : found) {
    for (const double height : heights) {
      WallLine line{.wall = i};
      if (cutWall(walls_[i], plane, height, line)) lines.push_back(line);
    }
  }
  return lines;
}

bool cutWall(const Wall& wall, const DrivingPlane& plane, double height, WallLine& line) {
  std::array<Eigen::Vector3d, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = plane.local(wall.corners[k]);
    corners[k].z() -= height;
  }
  std::array<Vector2, 2> ends{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& a = corners[k];
    const Eigen::Vector3d& b = corners[(k + 1) % 3];
    if ((a.z() < 0.0) == (b.z() < 0.0)) continue;
    ends.at(count++) = (a + (b - a) * (a.z() / (a.z() - b.z()))).head<2>();
  }
  if (count < 2) return false;
  line.from = ends[0];
  line.to = ends[1];
  return line.length() > shortestLine;
}

}  // namespace bumper::doctor
