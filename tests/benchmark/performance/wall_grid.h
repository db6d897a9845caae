#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bumper/response/contact_point.h"
#include "bumper/scenes/scene.h"

namespace bumper::benchmark {

/// A wall seen from above, m.
struct PlanSegment {
  Vector2 start = Vector2::Zero();
  Vector2 end = Vector2::Zero();
};

/// Where an outline is in the horizontal plane.
struct PlanPlace {
  Vector2 position = Vector2::Zero();
  double cosine = 1.0;  ///< of the yaw
  double sine = 0.0;

  /// A point of the world in the vehicle's frame.
  [[nodiscard]] Vector2 toVehicle(const Vector2& point) const {
    const Vector2 from = point - position;
    return {cosine * from.x() + sine * from.y(), cosine * from.y() - sine * from.x()};
  }
};

/// The distance between an outline and a wall, m; 0 if they touch or overlap.
double gapBetween(const Outline& outline, const PlanPlace& place, const PlanSegment& wall);

/// Whether they touch or overlap: the same without the distance, by separating axes.
bool overlap(const Outline& outline, const PlanPlace& place, const PlanSegment& wall);

/// What one would write by hand for walls that stand upright on flat ground: a uniform grid whose
/// cells know every wall that a vehicle with its mass centre in the cell can touch, so that one
/// look-up answers. The two triangles of a quad are one segment.
class WallGrid {
 public:
  /// `distance`: how far a wall may be from the mass centre, m.
  WallGrid(const Scene& scene, double distance);

  /// The walls that may lie within the distance of a mass centre there.
  [[nodiscard]] std::span<const PlanSegment> near(const Vector2& position) const {
    const double column = (position.x() - low_.x()) * perCell_;
    const double row = (position.y() - low_.y()) * perCell_;
    if (!(column >= 0.0 && row >= 0.0 && column < columns_ && row < rows_)) return {};
    const std::size_t cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                             static_cast<std::size_t>(column);
    return {walls_.data() + first_[cell], walls_.data() + first_[cell + 1]};
  }

  [[nodiscard]] std::size_t wallCount() const { return wallCount_; }

 private:
  static constexpr double cellSize_ = 4.0;  // m
  static constexpr double perCell_ = 1.0 / cellSize_;

  Vector2 low_ = Vector2::Zero();
  double columns_ = 0.0;
  double rows_ = 0.0;
  std::size_t wallCount_ = 0;
  std::vector<std::uint32_t> first_;  // of each cell's walls, and one past the last
  std::vector<PlanSegment> walls_;
};

}  // namespace bumper::benchmark
