#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bumper/response/segment.h"

namespace bumper {

/// Merges collinear segments that respond alike, so that a wall is hit as one however it is meshed.
class WallMerge {
 public:
  /// Segments as seen from `centre`: the normal points to its side unless they are solid. Neither
  /// their order nor which way round they are matters. Valid until the next call.
  std::span<const Segment> merge(std::span<const Segment> segments,
                                 std::span<const Surface> surfaces, const Vector2& centre);

  /// The id of the segment at a place of a merged one.
  [[nodiscard]] int pieceAt(const Segment& merged, const Vector2& point) const;

 private:
  // A segment, by its place along its own line.
  struct Ordered {
    std::size_t piece = 0;
    double place = 0.0;
    double length = 0.0;
    bool merged = false;
  };

  void join(Segment& wall, std::span<const Surface> surfaces);

  std::span<const Segment> given_;
  std::vector<Segment> oriented_;
  std::vector<Ordered> order_;
  std::vector<Segment> merged_;
};

}  // namespace bumper
