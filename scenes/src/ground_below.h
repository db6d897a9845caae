#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "box_tree.h"
#include "bumper/response/planar_motion.h"
#include "bumper/scenes/walls.h"
#include "ground_levels.h"
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
  struct Surface {
    TriangleCorners corners;
    bool wide;
    std::optional<bool> carries;  ///< narrow, but together with its neighbours; empty: unknown
  };

  [[nodiscard]] bool isCovered(const Vector2& place, double height);
  [[nodiscard]] bool isSurrounded(const Wall& wall);
  [[nodiscard]] bool hasNarrowGround(const Wall& wall);
  [[nodiscard]] bool carries(Surface& surface);
  template <typename Visit>
  void forSurfaces(const Eigen::AlignedBox3d& box, double distance, const Visit& visit);

  GroundReach reach_;
  std::vector<Surface> surfaces_;
  std::optional<BoxTree> tree_;
  std::map<std::pair<std::int64_t, std::int64_t>, double> lowest_;  // by cell: wide ground, m
  std::size_t visits_ = 0;
};

}  // namespace bumper
