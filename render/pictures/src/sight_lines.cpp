#include "sight_lines.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace bumper::drawing {

namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double trianglesPerSquare = 4.0;
constexpr int mostSquaresAside = 1024;

/// Where a triangle cuts the segment between two points, as a share of the way; nothing if it does
/// not.
std::optional<double> cut(const std::array<Vector3d, 3>& corners, const Vector3d& from,
                          const Vector3d& to) {
  const Vector3d first = corners[1] - corners[0];
  const Vector3d second = corners[2] - corners[0];
  const Vector3d back = from - to;
  const Vector3d normal = first.cross(second);
  const double determinant = normal.dot(back);
  if (std::abs(determinant) < 1e-12) return {};
  const Vector3d start = from - corners[0];
  const double share = normal.dot(start) / determinant;
  if (!(share > 0.0 && share < 1.0)) return {};
  const Vector3d turned = start.cross(back);
  const double u = -second.dot(turned) / determinant;
  const double v = first.dot(turned) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return {};
  return share;
}

AlignedBox2d planOf(const std::array<Vector3d, 3>& corners) {
  AlignedBox2d plan;
  for (const Vector3d& corner : corners) plan.extend(Vector2d(corner.head<2>()));
  return plan;
}

}  // namespace

SightLines::SightLines(const Scene& scene) {
  triangles_.reserve(scene.triangles.size());
  for (const Scene::Triangle& triangle : scene.triangles) {
    triangles_.push_back(
        {scene.corner(triangle, 0), scene.corner(triangle, 1), scene.corner(triangle, 2)});
    for (const Vector3d& corner : triangles_.back()) box_.extend(corner);
  }
  const Vector3d size = box_.sizes();
  const double area = std::max(size.x(), 1e-3) * std::max(size.y(), 1e-3);
  side_ = std::max(std::sqrt(area * trianglesPerSquare / static_cast<double>(triangles_.size())),
                   std::max({size.x(), size.y(), 1e-3}) / mostSquaresAside);
  columns_ = static_cast<int>(size.x() / side_) + 1;
  rows_ = static_cast<int>(size.y() / side_) + 1;

  // Count, then fill.
  starts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Corners& corners : triangles_)
    visitSquares(planOf(corners), [&](std::size_t square) { ++starts_[square + 1]; });
  for (std::size_t square = 1; square < starts_.size(); ++square)
    starts_[square] += starts_[square - 1];
  members_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    visitSquares(planOf(triangles_[k]), [&](std::size_t square) {
      members_[next[square]++] = static_cast<std::uint32_t>(k);
    });
  }
}

SightLines::Span SightLines::columnsOf(double low, double high) const {
  const double left = box_.min().x();
  return {std::max(0, static_cast<int>(std::max(0.0, (low - left) / side_))),
          static_cast<int>(std::min<double>(columns_ - 1, (high - left) / side_))};
}

SightLines::Span SightLines::rowsOf(double low, double high) const {
  const double bottom = box_.min().y();
  return {std::max(0, static_cast<int>(std::max(0.0, (low - bottom) / side_))),
          static_cast<int>(std::min<double>(rows_ - 1, (high - bottom) / side_))};
}

template <typename Visit>
void SightLines::visitSquares(const AlignedBox2d& area, const Visit& visit) const {
  const Span columns = columnsOf(area.min().x(), area.max().x());
  const Span rows = rowsOf(area.min().y(), area.max().y());
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column)
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
            static_cast<std::size_t>(column));
  }
}

double SightLines::visibleShare(const Vector3d& from, const Vector3d& to) const {
  AlignedBox2d plan(from.head<2>().cwiseMin(to.head<2>()), from.head<2>().cwiseMax(to.head<2>()));
  plan = plan.intersection(AlignedBox2d(box_.min().head<2>(), box_.max().head<2>()));
  if (plan.isEmpty()) return 1.0;
  double nearest = 1.0;
  const Vector3d way = to - from;
  const Span rows = rowsOf(plan.min().y(), plan.max().y());
  for (int row = rows.first; row <= rows.last; ++row) {
    // The part of the way that lies in this row of squares.
    AlignedBox2d part = plan;
    if (std::abs(way.y()) > 1e-9) {
      const double low = (box_.min().y() + row * side_ - from.y()) / way.y();
      const double high = low + side_ / way.y();
      const double first = from.x() + std::clamp(std::min(low, high), 0.0, 1.0) * way.x();
      const double last = from.x() + std::clamp(std::max(low, high), 0.0, 1.0) * way.x();
      part.min().x() = std::min(first, last);
      part.max().x() = std::max(first, last);
    }
    // A hair more: a wall may stand on the border of two squares.
    const Span columns = columnsOf(part.min().x() - 1e-6, part.max().x() + 1e-6);
    for (int column = columns.first; column <= columns.last; ++column) {
      const std::size_t square =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
          static_cast<std::size_t>(column);
      for (std::uint32_t k = starts_[square]; k < starts_[square + 1]; ++k)
        nearest = std::min(nearest, cut(triangles_[members_[k]], from, to).value_or(1.0));
    }
  }
  return nearest;
}

int SightLines::hidden(const std::vector<Vector3d>& points, const Vector3d& eye) const {
  return static_cast<int>(std::ranges::count_if(points, [&](const Vector3d& point) {
    return visibleShare(point + 0.02 * (eye - point), eye) < 1.0;
  }));
}

}  // namespace bumper::drawing
