#include "bumper/scenes/clearance.h"

#include <algorithm>
#include <limits>

namespace bumper {

namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double distance(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& point) {
  const Eigen::Vector2d edge = b - a;
  const double length = edge.squaredNorm();
  const double way = length > 0.0 ? std::clamp((point - a).dot(edge) / length, 0.0, 1.0) : 0.0;
  return (point - a - way * edge).norm();
}

}  // namespace

double clearance(const Wall& wall, const Eigen::Vector2d& point) {
  const Eigen::Vector2d a = wall.corners[0].head<2>();
  const Eigen::Vector2d b = wall.corners[1].head<2>();
  const Eigen::Vector2d c = wall.corners[2].head<2>();
  const double ab = cross(b - a, point - a);
  const double bc = cross(c - b, point - b);
  const double ca = cross(a - c, point - c);
  if ((ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0)) return 0.0;
  return std::min({distance(a, b, point), distance(b, c, point), distance(c, a, point)});
}

double clearance(const std::vector<Wall>& walls, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) nearest = std::min(nearest, clearance(wall, point));
  return nearest;
}

}  // namespace bumper
