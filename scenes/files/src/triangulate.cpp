#include "triangulate.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

namespace bumper {

namespace {

using Outline2d = std::vector<Eigen::Vector2d>;

/// Normal whose length is twice the polygon's area (Newell's); plane or not.
Eigen::Vector3d areaNormal(const std::vector<Eigen::Vector3d>& polygon) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d a = polygon[i] - polygon[0];
    const Eigen::Vector3d b = polygon[(i + 1) % polygon.size()] - polygon[0];
    normal += a.cross(b);
  }
  return normal;
}

/// The polygon without the coordinate in which it is flattest, counter-clockwise.
Outline2d flatten(const std::vector<Eigen::Vector3d>& polygon) {
  const Eigen::Vector3d normal = areaNormal(polygon);
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Index u = (axis + 1) % 3;
  Eigen::Index v = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(u, v);
  Outline2d flat;
  flat.reserve(polygon.size());
  for (const Eigen::Vector3d& corner : polygon) {
    flat.emplace_back(corner[u] - polygon[0][u], corner[v] - polygon[0][v]);
  }
  return flat;
}

/// Twice the area of a triangle, positive if it is counter-clockwise.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Whether a fan from the first corner covers it: every triangle of the fan turns left and so does
/// every corner.
bool isConvex(const Outline2d& flat) {
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0.0) return false;
    if (i > 0 && i + 1 < n && turn(flat[0], flat[i], flat[i + 1]) < 0.0) return false;
  }
  return true;
}

class EarClipper {
 public:
  explicit EarClipper(const Outline2d& flat) : flat_(flat), left_(flat.size()) {
    std::iota(left_.begin(), left_.end(), 0);
  }

  void clip(std::vector<std::array<std::size_t, 3>>& triangles) {
    while (left_.size() > 3) {
      const std::size_t ear = findEar();
      triangles.push_back(cornersAround(ear));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({left_[0], left_[1], left_[2]});
  }

 private:
  [[nodiscard]] std::array<std::size_t, 3> cornersAround(std::size_t i) const {
    const std::size_t n = left_.size();
    return {left_[(i + n - 1) % n], left_[i], left_[(i + 1) % n]};
  }

  [[nodiscard]] bool isEar(std::size_t i) const {
    const auto [before, at, after] = cornersAround(i);
    const Eigen::Vector2d& a = flat_[before];
    const Eigen::Vector2d& b = flat_[at];
    const Eigen::Vector2d& c = flat_[after];
    if (turn(a, b, c) <= 0.0) return false;
    for (const std::size_t other : left_) {
      const Eigen::Vector2d& p = flat_[other];
      // Corners that stand on one another (a slit to a hole) do not hide an ear.
      if (other == before || other == at || other == after || p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  /// Every simple polygon has an ear; one that crosses itself may not: any corner will do then.
  [[nodiscard]] std::size_t findEar() const {
    for (std::size_t i = 0; i < left_.size(); ++i) {
      if (isEar(i)) return i;
    }
    return 0;
  }

  const Outline2d& flat_;
  std::vector<std::size_t> left_;
};

}  // namespace

bool triangulate(const std::vector<Eigen::Vector3d>& polygon,
                 std::vector<std::array<std::size_t, 3>>& triangles) {
  triangles.clear();
  if (polygon.size() == 3) {
    triangles.push_back({0, 1, 2});
    return true;
  }
  const Outline2d flat = flatten(polygon);
  if (isConvex(flat)) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) triangles.push_back({0, i, i + 1});
    return true;
  }
  if (polygon.size() > maxConcaveCorners) return false;
  EarClipper(flat).clip(triangles);
  return true;
}

}  // namespace bumper
