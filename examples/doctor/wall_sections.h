#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "bumper/scenes/walls.h"
#include "driving_plane.h"

namespace bumper::doctor {

/// Where a plane cuts a wall, in the plane's axes, m.
struct WallLine {
  Vector2 from = Vector2::Zero();
  Vector2 to = Vector2::Zero();
  std::size_t wall = 0;  ///< index

  [[nodiscard]] double length() const { return (to - from).norm(); }
};

/// Cuts the walls around a place. Finds them in a grid as seen from above.
class WallSections {
 public:
  /// `walls` is referred to.
  explicit WallSections(const std::vector<Wall>& walls);

  /// The lines of the walls within `radius`, m, of a plane's origin, at several heights above the
  /// plane, m.
  [[nodiscard]] std::vector<WallLine> around(const DrivingPlane& plane, double radius,
                                             std::span<const double> heights) const;

  [[nodiscard]] const std::vector<Wall>& walls() const { return walls_; }

 private:
  using Cell = std::pair<long, long>;

  const std::vector<Wall>& walls_;
  std::map<Cell, std::vector<std::size_t>> cells_;
  std::vector<std::size_t> large_;  ///< in too many cells: looked at every time
};

/// Where a plane at a height above another one cuts a wall; false if it does not.
bool cutWall(const Wall& wall, const DrivingPlane& plane, double height, WallLine& line);

}  // namespace bumper::doctor
