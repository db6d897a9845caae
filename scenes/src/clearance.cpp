#include "bumper/scenes/clearance.h"

#include <algorithm>
#include <limits>

#include "plan_segment.h"

namespace bumper {

double clearance(const Wall& wall, const Eigen::Vector2d& point) {
  const Eigen::Vector2d a = wall.corners[0].head<2>();
  const Eigen::Vector2d b = wall.corners[1].head<2>();
  const Eigen::Vector2d c = wall.corners[2].head<2>();
  const double ab = cross(b - a, point - a);
  const double bc = cross(c - b, point - b);
  const double ca = cross(a - c, point - c);
  if ((ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0)) return 0.0;
  return std::min(
      {planDistance(a, b, point), planDistance(b, c, point), planDistance(c, a, point)});
}

double clearance(const std::vector<Wall>& walls, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) nearest = std::min(nearest, clearance(wall, point));
  return nearest;
}

}  // namespace bumper
