#pragma once

#include "bumper/response/planar_motion.h"

namespace bumper {

struct ResponseSettings;

/// A piece of a wall as a vehicle's yaw plane cuts it: a line segment, or the round of a post.
struct Segment {
  Vector2 start = Vector2::Zero();  ///< m; of a post the centre
  Vector2 end = Vector2::Zero();    ///< m; of a post the centre too
  /// Unit, at right angles to the segment, to either side unless `solid`: which side the vehicle
  /// comes from is decided when they meet. Of no meaning for a post.
  Vector2 normal = Vector2::Zero();
  /// Of a post, m; 0 for a line segment.
  double radius = 0.0;
  /// What lies behind the normal is solid: only the front can be hit.
  bool solid = false;
  /// The caller's own number; comes back in the impact.
  int id = -1;
  /// Its number among the surfaces that are given with the segments.
  int surface = 0;

  [[nodiscard]] bool isPost() const { return radius > 0.0; }
};

/// What segments answer with. Segments in line whose surfaces have the same settings object are one
/// wall; those that break, or are entered, only if their surface is the same.
struct Surface {
  /// Not owned, never null.
  const ResponseSettings* settings = nullptr;
  /// A long force pulse of this surface runs: it is not answered, and the outline may be as deep in
  /// it as `depth`, m.
  bool entered = false;
  double depth = 0.0;
};

}  // namespace bumper
