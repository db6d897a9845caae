#pragma once

#include "bumper/base/api.h"
#include "bumper/response/planar_motion.h"

namespace BUMPER_API bumper {

struct ResponseSettings;

/// The section of a wall with a vehicle's yaw plane: a line segment, or the circle of a post.
struct Segment {
  Vector2 start = Vector2::Zero();  ///< m; of a post the centre
  Vector2 end = Vector2::Zero();    ///< m; of a post the centre too
  /// Unit, at right angles to the segment, to either side unless `solid`: which side the vehicle
  /// comes from is decided at contact. Meaningless for a post.
  Vector2 normal = Vector2::Zero();
  /// Of a post, m; 0 for a line segment.
  double radius = 0.0;
  /// The space behind the normal is solid: only the front can be hit.
  bool solid = false;
  /// The caller's own number; returned in Impact::wall.
  int id = -1;
  /// Its number among the surfaces that are given with the segments.
  int surface = 0;

  [[nodiscard]] bool isPost() const { return radius > 0.0; }
};

/// Whether a segment belongs to the wall that was hit at `place` along `normal`, unit: whether it
/// lies within 0.25 m of that wall's line and turns away from it by less than 30°. On a wall that
/// bends the line may be left by 0.27 m more for each metre along it. What is no further than 0.25
/// m from the place and leads away from the vehicle belongs to it, too.
bool isOneWall(const Segment& segment, const Vector2& place, const Vector2& normal);

/// How segments respond. Collinear segments whose surfaces share a settings object are one wall;
/// those that break, or are entered, only if they share the surface.
struct Surface {
  /// Not owned, never null.
  const ResponseSettings* settings = nullptr;
  /// A long force pulse of this surface runs: it causes no further impact, and `depth` is the
  /// penetration allowed, m.
  bool entered = false;
  double depth = 0.0;
  /// The walls belong to a body that moves as prescribed, whatever hits it: their segments are
  /// where they are at the step's start, and move with it. `motion` is the body's then, of a point
  /// of it that moves straight, in the same plane.
  bool moves = false;
  PlanarMotion motion{};
};

/// A segment that belongs to a body, after the body has moved.
Segment carried(const Segment& segment, const Placement& before, const Placement& after);

}  // namespace bumper
