#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "box_tree.h"
#include "bumper/response/planar_motion.h"
#include "bumper/scenes/walls.h"
#include "ground_levels.h"
#include "plan_grid.h"
#include "triangle.h"

namespace bumper {

/// Proves that walls out of reach of wide ground nearby are out of reach of all ground: under such
/// a wall, and around it, wide ground lies everywhere, and no narrow pieces at its height carry a
/// vehicle together.
class GroundBelow {
 public:
  /// Looks at the flat triangles near `walls`.
  GroundBelow(const Scene& scene, const std::vector<FlatTriangle>& flat, const GroundReach& reach,
              const std::vector<Wall>& walls);

  /// False in doubt, also if the searches have taken too long. `wall` must be one of those given.
  [[nodiscard]] bool isProvenFor(const Wall& wall);

 private:
  [[nodiscard]] bool isCovered(const Vector2& place, double height);
  [[nodiscard]] bool isSurrounded(const Wall& wall);
  [[nodiscard]] bool carries(const TriangleCorners& narrow, const BoxTree& narrowTree,
                             const std::vector<TriangleCorners>& others);
  template <typename Visit>
  void search(const BoxTree& tree, const Eigen::AlignedBox3d& box, double distance,
              const Visit& visit);

  GroundReach reach_;
  std::vector<TriangleCorners> wide_;
  std::optional<BoxTree> wideTree_;
  std::optional<BoxTree> carrierTree_;  // of narrow pieces that carry a vehicle
  PlanGrid<double> lowest_{0.5};        // wide ground under the middle of a cell, m
  std::size_t visits_ = 0;
};

}  // namespace bumper
