#include "bumper/scenes/clearance_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bumper/scenes/clearance.h"

namespace bumper {

namespace {

// Of coordinates far from the origin, m.
constexpr double rounding = 1e-6;

constexpr double smallestCell = 1.25;  // m
constexpr double mostCells = 4e6;

// Cells are kept in tiles of so many rows and columns. A tile all of whose cells are this far from
// every wall, in cells, is kept as one number.
constexpr std::size_t tileSide = 16;
constexpr int farTile = 7;

// Distances are kept in parts of a cell.
constexpr int partsOfCell = 8;
constexpr int most = 255;

// So many cells around a wall, distances are exact; further away they are counted in cells.
constexpr int exactCells = 6;

using Corners = std::array<std::array<double, 2>, 3>;

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// From which to which x a triangle reaches between two values of y.
Span spanBetween(const Corners& corners, double low, double high) {
  Span span;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [ax, ay] = corners[k];
    const auto& [bx, by] = corners[(k + 1) % 3];
    if (low <= ay && ay <= high) span.include(ax);
    for (const double y : {low, high}) {
      if ((ay < y) != (by < y)) span.include(ax + (y - ay) / (by - ay) * (bx - ax));
    }
  }
  return span;
}

std::size_t cellAt(double place, std::size_t count) {
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
}

// How many columns or rows, whichever are more, each cell is away from the nearest 0.
void spread(std::vector<std::uint8_t>& cells, std::size_t columns, std::size_t rows) {
  const auto pass = [&](std::size_t row, std::size_t column, bool up) {
    std::uint8_t& cell = cells[row * columns + column];
    const auto lower = [&cell](std::uint8_t neighbour) {
      if (neighbour < most) cell = std::min(cell, static_cast<std::uint8_t>(neighbour + 1));
    };
    if (up ? column > 0 : column + 1 < columns) lower(*(&cell + (up ? -1 : 1)));
    if (up ? row == 0 : row + 1 == rows) return;
    const std::size_t other = up ? row - 1 : row + 1;
    for (std::size_t c = column - std::min<std::size_t>(column, 1);
         c <= std::min(column + 1, columns - 1); ++c) {
      lower(cells[other * columns + c]);
    }
  };
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) pass(row, column, true);
  }
  for (std::size_t row = rows; row-- > 0;) {
    for (std::size_t column = columns; column-- > 0;) pass(row, column, false);
  }
}

}  // namespace

ClearanceMap::ClearanceMap(const std::vector<Wall>& walls) {
  if (walls.empty()) return;
  Span x;
  Span y;
  for (const Wall& wall : walls) {
    for (const Eigen::Vector3d& corner : wall.corners) {
      x.include(corner.x());
      y.include(corner.y());
    }
  }
  lowX_ = x.low;
  lowY_ = y.low;
  highX_ = x.high;
  highY_ = y.high;
  const double width = x.high - x.low;
  const double depth = y.high - y.low;
  // Of a long and narrow field a row of cells may be all there is.
  cell_ =
      std::max({smallestCell, std::sqrt(width * depth / mostCells), (width + depth) / mostCells});
  columns_ = static_cast<std::size_t>(width / cell_) + 1;
  rows_ = static_cast<std::size_t>(depth / cell_) + 1;

  std::vector<std::uint8_t> distances(columns_ * rows_, most);
  std::vector<std::uint8_t> away(distances.size(), most);
  for (const Wall& wall : walls) findDistances(wall, distances, away);
  spread(away, columns_, rows_);
  for (std::size_t i = 0; i < away.size(); ++i) {
    // Within exactCells of a wall's cell all cells know their distance from it; other walls are
    // further away than that. From the middle of a cell to the edge of the next it is half a cell.
    const int unknown = away[i] == 0 ? exactCells + 1 : away[i] + exactCells;
    const int parts = partsOfCell * unknown - partsOfCell / 2;
    distances[i] = static_cast<std::uint8_t>(std::min<int>({parts, distances[i], most}));
  }
  keep(distances);
}

void ClearanceMap::keep(const std::vector<std::uint8_t>& distances) {
  const auto tilesFor = [](std::size_t cells) { return (cells + tileSide - 1) / tileSide; };
  tileColumns_ = tilesFor(columns_);
  tiles_.reserve(tileColumns_ * tilesFor(rows_));
  std::array<std::uint8_t, tileSide * tileSide> tile;
  for (std::size_t row = 0; row < rows_; row += tileSide) {
    for (std::size_t column = 0; column < columns_; column += tileSide) {
      tile.fill(most);
      for (std::size_t r = row; r < std::min(row + tileSide, rows_); ++r) {
        std::copy_n(distances.begin() + static_cast<std::ptrdiff_t>(r * columns_ + column),
                    std::min(tileSide, columns_ - column),
                    tile.begin() + static_cast<std::ptrdiff_t>((r - row) * tileSide));
      }
      const int nearest = *std::min_element(tile.begin(), tile.end());
      if (nearest >= farTile * partsOfCell) {
        tiles_.push_back(-nearest);
      } else {
        tiles_.push_back(static_cast<std::int32_t>(distances_.size()));
        distances_.insert(distances_.end(), tile.begin(), tile.end());
      }
    }
  }
  distances_.shrink_to_fit();
}

// From the middles of all cells around a wall; these are then 0 cells away from it.
void ClearanceMap::findDistances(const Wall& wall, std::vector<std::uint8_t>& distances,
                                 std::vector<std::uint8_t>& away) const {
  Corners corners;
  Span height;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = {(wall.corners[k].x() - lowX_) / cell_, (wall.corners[k].y() - lowY_) / cell_};
    height.include(corners[k][1]);
  }
  // What lies at a cell's edge belongs to the neighbour too.
  constexpr double around = exactCells + 1e-6;
  for (std::size_t row = cellAt(height.low - around, rows_);
       row <= cellAt(height.high + around, rows_); ++row) {
    const auto low = static_cast<double>(row);
    const Span span = spanBetween(corners, low - around, low + 1.0 + around);
    if (span.low > span.high) continue;
    for (std::size_t column = cellAt(span.low - around, columns_);
         column <= cellAt(span.high + around, columns_); ++column) {
      const std::size_t cell = row * columns_ + column;
      const Eigen::Vector2d middle(lowX_ + (static_cast<double>(column) + 0.5) * cell_,
                                   lowY_ + (low + 0.5) * cell_);
      const double distance = clearance(wall, middle) / cell_ * partsOfCell;
      const auto parts = static_cast<std::uint8_t>(std::min<double>(distance, most));
      distances[cell] = std::min(distances[cell], parts);
      away[cell] = 0;
    }
  }
}

double ClearanceMap::atLeast(double x, double y) const {
  if (tiles_.empty()) return std::numeric_limits<double>::infinity();
  const double outsideX = std::max({lowX_ - x, x - highX_, 0.0});
  const double outsideY = std::max({lowY_ - y, y - highY_, 0.0});
  if (outsideX > 0.0 || outsideY > 0.0) {
    return std::max(std::hypot(outsideX, outsideY) - rounding, 0.0);
  }
  if (!std::isfinite(x) || !std::isfinite(y)) return 0.0;
  const double columns = (x - lowX_) / cell_;
  const double rows = (y - lowY_) / cell_;
  // What the middles of the four cells around know: the one that lies away from the walls loses
  // least on the way to the place.
  const std::size_t left = cellAt(columns - 0.5, columns_);
  const std::size_t low = cellAt(rows - 0.5, rows_);
  double best = 0.0;
  for (const std::size_t row : {low, std::min(low + 1, rows_ - 1)}) {
    for (const std::size_t column : {left, std::min(left + 1, columns_ - 1)}) {
      const double asideX = std::abs(columns - static_cast<double>(column) - 0.5);
      const double asideY = std::abs(rows - static_cast<double>(row) - 0.5);
      // No less than the way to the cell's middle.
      const double aside = std::max(asideX, asideY) + 0.41422 * std::min(asideX, asideY);
      best = std::max(best, fromMiddle(row, column) - aside);
    }
  }
  return std::max(best - 1e-9, 0.0) * cell_;
}

double ClearanceMap::fromMiddle(std::size_t row, std::size_t column) const {
  const std::int32_t tile = tiles_[row / tileSide * tileColumns_ + column / tileSide];
  const int parts = tile < 0 ? -tile
                             : distances_[static_cast<std::size_t>(tile) +
                                          row % tileSide * tileSide + column % tileSide];
  return static_cast<double>(parts) / partsOfCell;
}

}  // namespace bumper
