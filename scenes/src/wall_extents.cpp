// How tall is the wall that a triangle is a part of?
//
// Walls that are connected at corners and face nearly the same way form a surface. Seen from the
// front a surface is cut into columns at the ends of its triangles' stretches; in each column the
// triangles that overlap or touch one another in height make one piece of wall. A triangle reaches
// from the lowest to the highest point of its pieces over its own columns.

#include "wall_extents.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "surface_grower.h"

namespace bumper {

namespace {

/// What is less far apart than this, m, in height is one piece; stretches end together if they do
/// so within it.
constexpr double jointWidth = 1e-3;

/// Columns are made wider where triangles would otherwise be cut into more pieces than this, on
/// average: it bounds time and memory for meshes without rows and columns of their own.
constexpr std::size_t maxPiecesPerWall = 8;

/// A triangle seen from the front: its corners as (along, up), sorted by the way along.
using FrontView = std::array<Eigen::Vector2d, 3>;

FrontView seenFromFront(const Wall& wall, const Eigen::Vector2d& along) {
  FrontView view;
  for (std::size_t k = 0; k < 3; ++k) {
    view.at(k) = {wall.corners.at(k).head<2>().dot(along), wall.corners.at(k).z()};
  }
  std::sort(view.begin(), view.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  return view;
}

/// Where columns begin and end, ascending, each at least `width` after the one before.
std::vector<double> columnEnds(const std::vector<FrontView>& views, double width) {
  std::vector<double> ends;
  ends.reserve(views.size() * 2);
  for (const FrontView& view : views) {
    ends.push_back(view.front().x());
    ends.push_back(view.back().x());
  }
  std::sort(ends.begin(), ends.end());
  std::size_t kept = 0;
  for (const double end : ends) {
    if (kept == 0 || end - ends[kept - 1] > width) ends[kept++] = end;
  }
  ends.resize(kept);
  return ends;
}

/// First and one past the last column of a triangle; at least one.
struct Stretch {
  std::size_t first;
  std::size_t last;
};

Stretch columnsOf(const FrontView& view, const std::vector<double>& ends) {
  // The end that a coordinate was merged into is the last one not beyond it.
  const auto endAt = [&](double along) {
    return static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), along) -
                                    ends.begin()) -
           1;
  };
  const std::size_t first = endAt(view.front().x());
  return {first, std::max(first + 1, endAt(view.back().x()))};
}

struct HeightRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double height) {
    low = std::min(low, height);
    high = std::max(high, height);
  }
};

/// Heights of a triangle between two places along the wall.
HeightRange heightsBetween(const FrontView& view, double from, double to) {
  HeightRange range;
  const double begin = std::clamp(from, view.front().x(), view.back().x());
  const double end = std::clamp(to, view.front().x(), view.back().x());
  for (const Eigen::Vector2d& corner : view) {
    if (corner.x() >= begin && corner.x() <= end) range.include(corner.y());
  }
  constexpr std::array<std::pair<std::size_t, std::size_t>, 3> edges{{{0, 1}, {1, 2}, {0, 2}}};
  for (const auto& [i, k] : edges) {
    const Eigen::Vector2d& a = view.at(i);
    const Eigen::Vector2d& b = view.at(k);
    for (const double along : {begin, end}) {
      if (along < a.x() || along > b.x() || a.x() == b.x()) continue;
      range.include(a.y() + (b.y() - a.y()) * (along - a.x()) / (b.x() - a.x()));
    }
  }
  return range;
}

/// What one column holds of one triangle.
struct Piece {
  std::size_t column;
  HeightRange heights;
  std::uint32_t wall;
};

std::size_t countPieces(const std::vector<FrontView>& views, const std::vector<double>& ends) {
  std::size_t count = 0;
  for (const FrontView& view : views) {
    const Stretch stretch = columnsOf(view, ends);
    count += stretch.last - stretch.first;
  }
  return count;
}

std::vector<Piece> cutIntoColumns(const std::vector<std::uint32_t>& surface,
                                  const std::vector<FrontView>& views) {
  std::vector<double> ends = columnEnds(views, jointWidth);
  if (countPieces(views, ends) > maxPiecesPerWall * views.size()) {
    double sum = 0.0;
    for (const FrontView& view : views) sum += view.back().x() - view.front().x();
    ends = columnEnds(views, sum / static_cast<double>(maxPiecesPerWall * views.size()));
  }
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Stretch stretch = columnsOf(views[i], ends);
    for (std::size_t column = stretch.first; column < stretch.last; ++column) {
      const double to = column + 1 < ends.size() ? ends[column + 1] : ends[column];
      pieces.push_back({column, heightsBetween(views[i], ends[column], to), surface[i]});
    }
  }
  return pieces;
}

/// Joins what touches in each column and hands the extent to the walls it is made of.
void joinPieces(std::vector<Piece>& pieces, std::vector<Wall>& walls) {
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return std::pair(a.column, a.heights.low) < std::pair(b.column, b.heights.low);
  });
  for (auto first = pieces.begin(); first != pieces.end();) {
    HeightRange joined = first->heights;
    auto last = first + 1;
    while (last != pieces.end() && last->column == first->column &&
           last->heights.low <= joined.high + jointWidth) {
      joined.high = std::max(joined.high, last->heights.high);
      ++last;
    }
    for (; first != last; ++first) {
      Wall& wall = walls[first->wall];
      wall.foot = std::min(wall.foot, joined.low);
      wall.top = std::max(wall.top, joined.high);
    }
  }
}

}  // namespace

void findWallExtents(std::vector<Wall>& walls, const std::vector<Corners>& corners) {
  for (Wall& wall : walls) {
    const auto [low, high] =
        std::minmax({wall.corners[0].z(), wall.corners[1].z(), wall.corners[2].z()});
    wall.foot = low;
    wall.top = high;
  }
  if (walls.empty()) return;
  SurfaceGrower grower(walls, corners);
  for (std::uint32_t seed = 0; seed < walls.size(); ++seed) {
    if (grower.isTaken(seed)) continue;
    const std::vector<std::uint32_t> surface = grower.take(seed);
    const Eigen::Vector2d direction = facing(walls[seed]);
    const Eigen::Vector2d along(-direction.y(), direction.x());
    std::vector<FrontView> views;
    views.reserve(surface.size());
    for (const std::uint32_t wall : surface) views.push_back(seenFromFront(walls[wall], along));
    std::vector<Piece> pieces = cutIntoColumns(surface, views);
    joinPieces(pieces, walls);
  }
}

}  // namespace bumper
