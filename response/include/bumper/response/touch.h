#pragma once

#include <optional>

#include "bumper/base/api.h"
#include "bumper/response/outline.h"
#include "bumper/response/segment.h"

namespace BUMPER_API bumper {

/// Points of an outline and a wall that are no further apart than this touch, m.
inline constexpr double touchTolerance = 1e-9;

/// The outline and a wall that it overlaps, as seen along a contact normal.
struct Overlap {
  Vector2 normal = Vector2::Zero();  ///< unit, out of the wall into the vehicle
  double offset = 0.0;               ///< normal · p of the wall's line or, `byEnd`, of its end
  double start = 0.0;  ///< tangent · p where the wall begins; the tangent is z × normal
  double end = 0.0;    ///< … and where it ends, start ≤ end
  Vector2 insideFrom =
      Vector2::Zero();  ///< the line of interference (Figure 2): the part of the wall inside
  Vector2 insideTo = Vector2::Zero();  ///< the outline, m
  double depth = 0.0;                  ///< of the outline's deepest point over the wall, m
  double deepest = 0.0;  ///< tangent · p of that point, or of the middle of a flush side
  bool byEnd = false;    ///< an end of the wall, or a post, meets a side or a corner of the
                         ///< outline: the normal is not the wall's own
};

/// The overlap with a wall that belongs to a body, after the body has moved, and with it what
/// overlaps.
Overlap carried(const Overlap& overlap, const Placement& before, const Placement& after);

/// The part of a segment inside the outline.
struct Interference {
  bool empty = true;
  Vector2 from = Vector2::Zero();
  Vector2 to = Vector2::Zero();

  [[nodiscard]] double length() const { return (to - from).norm(); }
  [[nodiscard]] Vector2 middle() const { return 0.5 * (from + to); }
};
Interference interference(const Outline& outline, const Placement& at, const Segment& wall);

/// A wall's normal towards `position`, unless the wall is solid.
Vector2 normalTowards(const Segment& wall, const Vector2& position);

/// A wall's line as seen from `position`: normal, offset, start and end of an overlap, no more. The
/// normal points to the side of `position`, unless the wall is solid.
Overlap lineOf(const Segment& wall, const Vector2& position);

/// The overlap of the outline at a pose with a wall; nothing if the wall does not intersect it. The
/// normal is the wall's own, towards the mass centre, as in the paper.
std::optional<Overlap> findOverlap(const Outline& outline, const Placement& at,
                                   const Segment& wall);

/// The same within touchTolerance: a wall of which no more than an end is met counts as well.
std::optional<Overlap> findFaceTouch(const Outline& outline, const Placement& at,
                                     const Segment& wall);

/// The same within touchTolerance, and along the direction in which outline and wall overlap least:
/// a face of the wall met by a corner or side, or a side of the outline met by an end of the wall.
std::optional<Overlap> findTouch(const Outline& outline, const Placement& at, const Segment& wall);

}  // namespace bumper
