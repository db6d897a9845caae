#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bumper/scenes/scene.h"

namespace bumper::drawing {

/// What a scene hides from where. Its triangles are sorted into squares of the ground plan, so that
/// a line of sight is tested against those near it only.
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
  /// Squares from the first to the last, both included.
  struct Span {
    int first;
    int last;
  };

  [[nodiscard]] Span columnsOf(double low, double high) const;
  [[nodiscard]] Span rowsOf(double low, double high) const;
  template <typename Visit>
  void visitSquares(const Eigen::AlignedBox2d& area, const Visit& visit) const;

  std::vector<Corners> triangles_;
  Eigen::AlignedBox3d box_;
  double side_ = 1.0;  ///< of a square, m
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> starts_;   ///< by square, row by row: into members_
  std::vector<std::uint32_t> members_;  ///< triangles
};

}  // namespace bumper::drawing
