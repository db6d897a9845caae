#include "sight_lines.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

namespace bumper::drawing {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

/// m by which boxes are larger than what they hold: a wall may stand on the side of one.
constexpr double boxMargin = 1e-6;

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

/// A line of sight on its way through the tree.
class Sight {
 public:
  Sight(const Vector3d& from, const Vector3d& to) : from_(from), to_(to), way_(to - from) {}

  /// Where the nearest triangle cuts it, as a share of the way; 1 if none does.
  [[nodiscard]] double nearest() const { return nearest_; }

  // What Eigen::BVIntersect() asks.

  /// Whether it comes through the box before it is cut.
  [[nodiscard]] bool intersectVolume(const AlignedBox3d& box) const {
    double enters = 0.0;
    double leaves = nearest_;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double low = box.min()[axis] - boxMargin - from_[axis];
      const double high = box.max()[axis] + boxMargin - from_[axis];
      if (way_[axis] == 0.0) {
        if (low > 0.0 || high < 0.0) return false;
        continue;
      }
      const double first = low / way_[axis];
      const double last = high / way_[axis];
      enters = std::max(enters, std::min(first, last));
      leaves = std::min(leaves, std::max(first, last));
    }
    return enters <= leaves;
  }

  /// Whether that is all that is asked: never.
  bool intersectObject(const std::array<Vector3d, 3>& corners) {
    nearest_ = std::min(nearest_, cut(corners, from_, to_).value_or(1.0));
    return false;
  }

 private:
  Vector3d from_;
  Vector3d to_;
  Vector3d way_;
  double nearest_ = 1.0;
};

}  // namespace

SightLines::SightLines(const Scene& scene) {
  std::vector<Corners> triangles;
  std::vector<AlignedBox3d> boxes;
  triangles.reserve(scene.triangles.size());
  boxes.reserve(scene.triangles.size());
  for (const Scene::Triangle& triangle : scene.triangles) {
    triangles.push_back(
        {scene.corner(triangle, 0), scene.corner(triangle, 1), scene.corner(triangle, 2)});
    boxes.emplace_back();
    for (const Vector3d& corner : triangles.back()) boxes.back().extend(corner);
    box_.extend(boxes.back());
  }
  tree_.init(triangles.begin(), triangles.end(), boxes.begin(), boxes.end());
}

double SightLines::visibleShare(const Vector3d& from, const Vector3d& to) const {
  Sight sight(from, to);
  Eigen::BVIntersect(tree_, sight);
  return sight.nearest();
}

int SightLines::hidden(const std::vector<Vector3d>& points, const Vector3d& eye) const {
  return static_cast<int>(std::ranges::count_if(points, [&](const Vector3d& point) {
    return visibleShare(point + 0.02 * (eye - point), eye) < 1.0;
  }));
}

}  // namespace bumper::drawing
