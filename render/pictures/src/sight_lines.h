#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_INTERNAL bumper {
namespace drawing {

/// What a scene hides from where. Its triangles stand in a tree of boxes, so that a line of sight
/// is tested against those near it only; memory is in proportion to their number, however they lie.
class SightLines {
 public:
  explicit SightLines(const Scene& scene);

  /// Around all triangles.
  [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_; }

  /// How far one sees from a point to another, as a share of the way: 1 if nothing lies between.
  [[nodiscard]] double visibleShare(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// How many of the points cannot be seen from an eye; not for the surfaces that they lie on.
  [[nodiscard]] int hidden(const std::vector<Eigen::Vector3d>& points,
                           const Eigen::Vector3d& eye) const;

 private:
  using Corners = std::array<Eigen::Vector3d, 3>;

  Eigen::KdBVH<double, 3, Corners> tree_;
  Eigen::AlignedBox3d box_;
};

}  // namespace drawing
}  // namespace bumper
