#include "weld.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "corners.h"

namespace bumper {

namespace {

/// Cells wider than the weld distance, so that a point seldom has to look into a second one.
constexpr double cellSize = 8.0 * weldDistance;

using Cell = std::array<double, 3>;

Cell cellOf(const Eigen::Vector3d& point) {
  // Adding zero turns -0 into +0, which hash differently.
  return {std::floor(point.x() / cellSize) + 0.0, std::floor(point.y() / cellSize) + 0.0,
          std::floor(point.z() / cellSize) + 0.0};
}

std::size_t hash(const Cell& cell) {
  std::uint64_t value = 0;
  for (const double coordinate : cell) {
    value = (value ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9E3779B97F4A7C15ULL;
    value ^= value >> 29U;
  }
  return static_cast<std::size_t>(value);
}

/// Triangles that follow one another have corners in common: where points are listed by triangle,
/// the same one is often among so many before.
constexpr std::uint32_t lookBack = 6;

/// Hash table of points by cell: chains of indices.
class PointTable {
 public:
  explicit PointTable(const std::vector<Eigen::Vector3d>& points)
      : points_(points), heads_(std::bit_ceil(points.size() + 1), noIndex), next_(points.size()) {}

  [[nodiscard]] std::uint32_t find(const Cell& cell, const Eigen::Vector3d& point) const {
    std::uint32_t found = noIndex;
    for (std::uint32_t i = heads_[slot(cell)]; i != noIndex; i = next_[i]) {
      if ((points_[i] - point).squaredNorm() <= weldDistance * weldDistance) {
        found = std::min(found, i);
      }
    }
    return found;
  }

  void insert(const Cell& cell, std::uint32_t index) {
    std::uint32_t& head = heads_[slot(cell)];
    next_[index] = head;
    head = index;
  }

 private:
  [[nodiscard]] std::size_t slot(const Cell& cell) const {
    return hash(cell) & (heads_.size() - 1);
  }

  const std::vector<Eigen::Vector3d>& points_;
  std::vector<std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;
};

/// The earliest point of the table within reach of `point`, in its own cell and in those that the
/// reach touches.
std::uint32_t findNear(const PointTable& table, const Eigen::Vector3d& point) {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(weldDistance);
  const Cell low = cellOf(point - reach);
  const Cell high = cellOf(point + reach);
  if (low == high) return table.find(low, point);
  std::uint32_t found = noIndex;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Cell cell = low;
    bool repeated = false;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1U) == 0U) continue;
      repeated = repeated || low.at(axis) == high.at(axis);
      cell.at(axis) = high.at(axis);
    }
    if (!repeated) found = std::min(found, table.find(cell, point));
  }
  return found;
}

/// The index of an equal point shortly before a point, or `noIndex`.
std::uint32_t findEqual(const std::vector<Eigen::Vector3d>& points, std::uint32_t index) {
  const std::uint32_t first = index - std::min(index, lookBack);
  for (std::uint32_t i = index; i > first; --i) {
    if (points[i - 1] == points[index]) return i - 1;
  }
  return noIndex;
}

}  // namespace

std::vector<std::uint32_t> weld(const std::vector<Eigen::Vector3d>& points) {
  PointTable table(points);
  std::vector<std::uint32_t> representative(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint32_t equal = findEqual(points, i);
    if (equal != noIndex) {
      representative[i] = representative[equal];
      continue;
    }
    const std::uint32_t found = findNear(table, points[i]);
    if (found == noIndex) table.insert(cellOf(points[i]), i);
    representative[i] = found == noIndex ? i : found;
  }
  return representative;
}

double thickness(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  if (longest == 0.0) return 0.0;
  return (b - a).cross(c - a).norm() / longest;
}

}  // namespace bumper
