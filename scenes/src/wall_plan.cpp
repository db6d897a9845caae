#include "bumper/scenes/wall_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "single_precision.h"
#include "wall_plan_builder.h"

namespace bumper {

namespace {

constexpr double smallestCell = 8.0;  // m

// A line lies in so many cells at most, on average: in a scene of large walls that cross one
// another time and memory would else grow faster than their number.
constexpr std::size_t mostCellsOfLine = 32;

}  // namespace

WallPlan::WallPlan(const std::vector<Wall>& walls) {
  if (walls.empty()) return;
  Vector2 low = walls.front().corners[0].head<2>();
  Vector2 high = low;
  for (const Wall& wall : walls) {
    for (const Eigen::Vector3d& corner : wall.corners) {
      low = low.cwiseMin(corner.head<2>());
      high = high.cwiseMax(corner.head<2>());
    }
  }
  origin_ = low;
  const double farthest = (high - low).maxCoeff();
  Builder builder(nodes_, origin_, 2.0 * singlePrecisionRounding * farthest + 1e-9);
  for (const Wall& wall : walls) builder.add(wall);
  builder.finish();
  nodes_.shrink_to_fit();
  size_ = high - low;
  sortIntoCells();
}

// All that a line may lie in; more than those that it is put into.
WallPlan::Cells WallPlan::cellsOf(std::size_t line) const {
  const Node& node = nodes_[line];
  const Node& next = nodes_[line + 1];
  const auto around = static_cast<double>(node.thickness);
  const Vector2 from(node.x, node.y);
  const Vector2 to(next.x, next.y);
  const Vector2 low = from.cwiseMin(to).array() - around;
  const Vector2 high = from.cwiseMax(to).array() + around;
  return {columnAt(low.x()), columnAt(high.x()), rowAt(low.y()), rowAt(high.y())};
}

// About as many cells as lines, also where all of them lie in a row; fewer if the lines are long.
void WallPlan::chooseCellSize() {
  const auto count = static_cast<double>(lines_);
  cell_ = std::max(
      {smallestCell, std::sqrt(size_.x() * size_.y() / count), (size_.x() + size_.y()) / count});
  for (;; cell_ *= 2.0) {
    columns_ = static_cast<std::size_t>(size_.x() / cell_) + 1;
    rows_ = static_cast<std::size_t>(size_.y() / cell_) + 1;
    std::size_t left = mostCellsOfLine * lines_;
    const auto fits = [&](std::size_t line) {
      const std::size_t cells = cellsOf(line).count();
      left -= std::min(left, cells);
      return left > 0;
    };
    bool allFit = true;
    for (std::size_t i = 0; i + 1 < nodes_.size() && allFit; ++i) {
      allFit = nodes_[i].thickness < 0.0F || fits(i);
    }
    if (allFit || columns_ * rows_ == 1) return;
  }
}

void WallPlan::sortIntoCells() {
  lines_ = static_cast<std::size_t>(std::count_if(
      nodes_.begin(), nodes_.end(), [](const Node& node) { return node.thickness >= 0.0F; }));
  chooseCellSize();
  std::vector<std::vector<Run>> runsOf(columns_ * rows_);
  for (std::uint32_t i = 0; i + 1 < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.thickness < 0.0F) continue;
    const Vector2 from(node.x, node.y);
    const Vector2 to(nodes_[i + 1].x, nodes_[i + 1].y);
    const auto around = static_cast<double>(node.thickness);
    const Cells cells = cellsOf(i);
    for (std::size_t row = cells.near; row <= cells.far; ++row) {
      for (std::size_t column = cells.left; column <= cells.right; ++column) {
        const Vector2 middle((static_cast<double>(column) + 0.5) * cell_,
                             (static_cast<double>(row) + 0.5) * cell_);
        // Outermost cells take what rounding has put beyond them; they lie along the edge.
        const double halfDiagonal = 0.70711 * cell_ + around + 1e-6 * cell_;
        if (std::abs(cross(to - from, middle - from)) > halfDiagonal * (to - from).norm()) continue;
        std::vector<Run>& runs = runsOf[row * columns_ + column];
        if (!runs.empty() && runs.back().first + runs.back().count == i) {
          ++runs.back().count;
        } else {
          runs.push_back({i, 1});
        }
      }
    }
  }
  firstRun_.reserve(runsOf.size() + 1);
  for (const std::vector<Run>& runs : runsOf) {
    firstRun_.push_back(static_cast<std::uint32_t>(runs_.size()));
    runs_.insert(runs_.end(), runs.begin(), runs.end());
  }
  firstRun_.push_back(static_cast<std::uint32_t>(runs_.size()));
  runs_.shrink_to_fit();
}

std::size_t WallPlan::columnAt(double x) const {
  return static_cast<std::size_t>(std::clamp(x / cell_, 0.0, static_cast<double>(columns_ - 1)));
}

std::size_t WallPlan::rowAt(double y) const {
  return static_cast<std::size_t>(std::clamp(y / cell_, 0.0, static_cast<double>(rows_ - 1)));
}

// Lowers `until` to where the first of the lines begins that is in the strip.
void WallPlan::shorten(const Run& run, const PlanStrip& strip, double& until) const {
  const double offsetX = origin_.x() - strip.origin.x();
  const double offsetY = origin_.y() - strip.origin.y();
  // In the strip's own axes.
  const auto placed = [&](const Node& node) -> Vector2 {
    const double x = static_cast<double>(node.x) + offsetX;
    const double y = static_cast<double>(node.y) + offsetY;
    return {strip.direction.x() * x + strip.direction.y() * y,
            strip.direction.x() * y - strip.direction.y() * x};
  };
  const Node* node = &nodes_[run.first];
  Vector2 to = placed(*node);
  for (std::uint32_t i = 0; i < run.count; ++i, ++node) {
    const Vector2 from = to;
    to = placed(node[1]);
    const auto thickness = static_cast<double>(node->thickness);
    const double width = strip.halfWidth + thickness;
    double first = std::min(from.x(), to.x());
    double last = std::max(from.x(), to.x());
    if (first - thickness > until || last + thickness < strip.start) continue;
    const double right = std::min(from.y(), to.y());
    const double left = std::max(from.y(), to.y());
    if (right > width || left < -width) continue;
    if (right < -width || left > width) {
      // The part of it over the strip's width.
      const double slope = (to.x() - from.x()) / (to.y() - from.y());
      const double atRight = from.x() + (std::max(right, -width) - from.y()) * slope;
      const double atLeft = from.x() + (std::min(left, width) - from.y()) * slope;
      first = std::min(atRight, atLeft);
      last = std::max(atRight, atLeft);
      if (last + thickness < strip.start) continue;
    }
    until = std::min(until, first - thickness);
  }
}

double WallPlan::freeUntil(const PlanStrip& strip) const {
  double until = strip.end;
  if (runs_.empty()) return until;
  const Vector2 begin = strip.origin - origin_ + strip.start * strip.direction;
  const Vector2 end = strip.origin - origin_ + strip.end * strip.direction;
  const Vector2 across = (strip.halfWidth + coarseness) * strip.direction.cwiseAbs().reverse();
  const Vector2 low = begin.cwiseMin(end) - across;
  const Vector2 high = begin.cwiseMax(end) + across;
  if (!(low.allFinite() && high.allFinite())) return -std::numeric_limits<double>::infinity();
  if (high.x() < 0.0 || high.y() < 0.0 || low.x() > size_.x() || low.y() > size_.y()) return until;
  const std::size_t left = columnAt(low.x());
  const std::size_t right = columnAt(high.x());
  const std::size_t top = rowAt(high.y());
  for (std::size_t row = rowAt(low.y()); row <= top; ++row) {
    const std::size_t first = firstRun_[row * columns_ + left];
    const std::size_t last = firstRun_[row * columns_ + right + 1];
    for (std::size_t k = first; k < last; ++k) shorten(runs_[k], strip, until);
  }
  return until;
}

std::size_t WallPlan::memory() const {
  return nodes_.capacity() * sizeof(Node) + firstRun_.capacity() * sizeof(std::uint32_t) +
         runs_.capacity() * sizeof(Run);
}

}  // namespace bumper
