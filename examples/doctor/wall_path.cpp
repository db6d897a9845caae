#include "wall_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace bumper::doctor {

namespace {

constexpr double shortestLeg = 1e-4;  // m

struct Leg {
  Vector2 end;
  Vector2 direction;
};

/// The wall's next piece from a point on, the one that leads farthest.
std::optional<Leg> nextLeg(std::span<const WallLine> lines, const Vector2& point,
                           const Vector2& direction, const PathLimits& limits) {
  std::optional<Leg> best;
  double farthest = shortestLeg;
  for (const WallLine& line : lines) {
    Vector2 from = line.from - point;
    Vector2 to = line.to - point;
    if (from.dot(direction) > to.dot(direction)) std::swap(from, to);
    const double begin = from.dot(direction);
    const double end = to.dot(direction);
    if (end <= farthest || begin > limits.gap) continue;
    const Vector2 along = (to - from).normalized();
    if (std::abs(cross(direction, along)) > std::sin(limits.bend)) continue;
    // How far beside the point it passes, or begins.
    const Vector2 nearest = begin > 0.0 ? from : from + along * (-from.dot(along));
    if (std::abs(cross(direction, nearest)) > limits.feature) continue;
    farthest = end;
    best = Leg{point + to, along};
  }
  return best;
}

/// Points from the origin on, the origin excluded.
std::vector<Vector2> walk(std::span<const WallLine> lines, Vector2 direction,
                          const PathLimits& limits) {
  std::vector<Vector2> points;
  Vector2 point = Vector2::Zero();
  double length = 0.0;
  while (length < limits.reach) {
    const std::optional<Leg> leg = nextLeg(lines, point, direction, limits);
    if (!leg) break;
    length += (leg->end - point).norm();
    point = leg->end;
    direction = leg->direction;
    points.push_back(point);
  }
  return points;
}

/// Cuts off where something stands in the room beside a piece of the path that begins at `length`.
void cutAtObstacles(std::span<const WallLine> lines, const Vector2& from, const Vector2& to,
                    double length, const PathLimits& limits, WallPath& path) {
  const Vector2 along = (to - from).normalized();
  const double reach = (to - from).norm();
  for (const WallLine& line : lines) {
    const Vector2 a(along.dot(line.from - from), cross(along, line.from - from));
    const Vector2 b(along.dot(line.to - from), cross(along, line.to - from));
    double low = 0.0;
    double high = 1.0;
    const auto clip = [&](double start, double change, double least, double most) {
      if (change == 0.0) {
        if (start < least || start > most) high = -1.0;
        return;
      }
      const auto [first, last] = std::minmax({(least - start) / change, (most - start) / change});
      low = std::max(low, first);
      high = std::min(high, last);
    };
    clip(a.x(), b.x() - a.x(), 0.0, reach);
    clip(a.y(), b.y() - a.y(), limits.feature, limits.width);
    if (low > high) continue;
    const auto [first, last] = std::minmax(
        {length + a.x() + low * (b.x() - a.x()), length + a.x() + high * (b.x() - a.x())});
    if (first > 0.0) path.end = std::min(path.end, first);
    if (last < 0.0) path.start = std::max(path.start, last);
    if (first <= 0.0 && last >= 0.0) path.start = path.end = 0.0;
  }
}

}  // namespace

std::size_t WallPath::legAt(double length) const {
  const auto above = std::ranges::upper_bound(lengths, length);
  const auto last = static_cast<std::ptrdiff_t>(lengths.size()) - 2;
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - lengths.begin() - 1, 0, last));
}

Vector2 WallPath::directionAt(double length) const {
  const std::size_t leg = legAt(length);
  return (points[leg + 1] - points[leg]).normalized();
}

Vector2 WallPath::pointAt(double length) const {
  const std::size_t leg = legAt(length);
  return points[leg] + directionAt(length) * (length - lengths[leg]);
}

double WallPath::distanceTo(const Vector2& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vector2 leg = points[i + 1] - points[i];
    const double share = std::clamp((point - points[i]).dot(leg) / leg.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (points[i] + share * leg - point).norm());
  }
  return least;
}

WallPath pathAlong(std::span<const WallLine> walls, std::span<const WallLine> obstacles,
                   const PathLimits& limits) {
  const std::vector<Vector2> ahead = walk(walls, Vector2::UnitX(), limits);
  const std::vector<Vector2> behind = walk(walls, -Vector2::UnitX(), limits);
  WallPath path;
  path.points.assign(behind.rbegin(), behind.rend());
  path.points.emplace_back(Vector2::Zero());
  path.points.insert(path.points.end(), ahead.begin(), ahead.end());
  if (path.points.size() < 2) return path;

  path.lengths.assign(path.points.size(), 0.0);
  for (std::size_t i = behind.size(); i + 1 < path.points.size(); ++i)
    path.lengths[i + 1] = path.lengths[i] + (path.points[i + 1] - path.points[i]).norm();
  for (std::size_t i = behind.size(); i > 0; --i)
    path.lengths[i - 1] = path.lengths[i] - (path.points[i] - path.points[i - 1]).norm();
  path.start = std::max(path.lengths.front(), -limits.reach);
  path.end = std::min(path.lengths.back(), limits.reach);
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i)
    cutAtObstacles(obstacles, path.points[i], path.points[i + 1], path.lengths[i], limits, path);
  return path;
}

}  // namespace bumper::doctor
