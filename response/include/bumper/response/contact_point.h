#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "bumper/response/planar_motion.h"
#include "bumper/response/vehicle_parameters.h"

namespace bumper {

struct ResponseSettings;

/// A rectangle along the axes of a vehicle's own frame, m.
struct PlanRectangle {
  Vector2 middle = Vector2::Zero();
  Vector2 half = Vector2::Zero();

  /// From the frame's origin to the farthest corner, m.
  [[nodiscard]] double farthest() const { return (middle.cwiseAbs() + half).norm(); }

  /// Whether it holds no point of the segment between two points.
  [[nodiscard]] bool misses(const Vector2& from, const Vector2& to) const {
    const Vector2 centre = 0.5 * (from + to) - middle;
    const Vector2 arm = 0.5 * (to - from);
    if ((centre.cwiseAbs() - arm.cwiseAbs() - half).maxCoeff() > 0.0) return true;
    // Across the segment.
    return std::abs(cross(arm, centre)) >
           half.x() * std::abs(arm.y()) + half.y() * std::abs(arm.x());
  }
};

/// The smallest that holds both.
inline PlanRectangle hull(const PlanRectangle& a, const PlanRectangle& b) {
  const Vector2 low = (a.middle - a.half).cwiseMin(b.middle - b.half);
  const Vector2 high = (a.middle + a.half).cwiseMax(b.middle + b.half);
  return {.middle = 0.5 * (low + high), .half = 0.5 * (high - low)};
}

/// The vehicle's bounding rectangle in its yaw plane (the paper's Figure 1), m from the mass
/// centre.
struct Outline {
  double front = 0.0;
  double rear = 0.0;
  double halfWidth = 0.0;

  explicit Outline(const VehicleParameters& vehicle)
      : front(vehicle.massCentreToFront),
        rear(vehicle.massCentreToRear),
        halfWidth(0.5 * vehicle.width) {}

  /// Enlarged on every side, m.
  [[nodiscard]] PlanRectangle enlarged(double by) const {
    return {.middle = {0.5 * (front - rear), 0.0},
            .half = {0.5 * (front + rear) + by, halfWidth + by}};
  }
  /// From the mass centre to the farthest corner, m.
  [[nodiscard]] double radius() const;
  /// Front left, rear left, rear right, front right in the vehicle's frame: counter-clockwise.
  [[nodiscard]] std::array<Vector2, 4> corners() const;
};

/// A piece of a wall as a vehicle's yaw plane cuts it: a segment, or the round of a post.
struct WallSegment {
  Vector2 start = Vector2::Zero();  ///< m; of a post the centre
  Vector2 end = Vector2::Zero();    ///< m; of a post the centre too
  /// Unit, at right angles to the segment, to either side unless `solid`: which side the vehicle
  /// comes from is decided when they meet. Of no meaning for a post.
  Vector2 normal = Vector2::Zero();
  /// Of a post, m; 0 for a segment.
  double radius = 0.0;
  /// What lies behind the normal is solid: only the front can be hit.
  bool solid = false;
  /// The caller's own number for the wall; comes back in the impact.
  int id = -1;
  /// The caller's number for what breaks as one.
  int group = 0;
  /// A long force pulse of this wall runs: it is not answered, and the outline may be as deep in it
  /// as `depth`, m.
  bool entered = false;
  double depth = 0.0;
  /// How this wall answers; not owned, never null when it reaches a collision step.
  const ResponseSettings* settings = nullptr;

  [[nodiscard]] bool isPost() const { return radius > 0.0; }
};

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

/// A wall's normal towards `position`, unless the wall is solid.
Vector2 normalTowards(const WallSegment& wall, const Vector2& position);

/// A wall's line as seen from `position`: normal, offset, start and end of an overlap, no more. The
/// normal points to the side of `position`, unless the wall is solid.
Overlap lineOf(const WallSegment& wall, const Vector2& position);

/// The overlap of the outline, placed somewhere, with a wall; nothing if the wall
/// does not pass through it. The normal is the wall's own, towards the mass centre: the paper's
/// view.
std::optional<Overlap> findOverlap(const Outline& outline, const Placement& at,
                                   const WallSegment& wall);

/// The same within touchTolerance, and along the direction in which outline and wall overlap least:
/// a face of the wall that a corner or side meets, or a side of the outline that an end of the wall
/// meets.
std::optional<Overlap> findTouch(const Outline& outline, const Placement& at,
                                 const WallSegment& wall);

/// Where the response acts.
struct ContactPoint {
  Vector2 point = Vector2::Zero();  ///< on the wall, m
  Vector2 arm =
      Vector2::Zero();  ///< mass centre to the body's contact point, m, in the plane's frame
};

/// The outline's deepest point over the wall, or the middle of a flush side: what touched first.
ContactPoint firstPoint(const Vector2& position, const Overlap& overlap);

/// The midpoint of the line of interference (Figure 2) at a given depth of penetration: the outline
/// is moved along the normal until its deepest point is `penetration` inside the wall, and the
/// contact point is the middle of the part of the wall inside it. With the overlap's own depth this
/// is the paper's a–b midpoint; with 0 it is the point of first touch. A penetration beyond the
/// mass centre is taken as one at the mass centre.
ContactPoint contactPoint(const Outline& outline, const Placement& at, const WallSegment& wall,
                          const Overlap& overlap, double penetration);

/// How far the outline is to be moved along the normal, m, so that its deepest point is
/// `penetration` inside the wall: within bounds as contactPoint() says.
double moveTo(const Overlap& overlap, const Vector2& position, double penetration);

/// The part of a segment inside the outline.
struct Interference {
  bool empty = true;
  Vector2 from = Vector2::Zero();
  Vector2 to = Vector2::Zero();

  [[nodiscard]] double length() const { return (to - from).norm(); }
  [[nodiscard]] Vector2 middle() const { return 0.5 * (from + to); }
};
Interference interference(const Outline& outline, const Placement& at, const WallSegment& wall);

/// Up to seven contact points.
struct ContactPoints {
  std::array<ContactPoint, 7> points;
  std::size_t count = 0;

  void add(const ContactPoint& point) { points[count++] = point; }
  [[nodiscard]] std::span<const ContactPoint> all() const { return {points.data(), count}; }
};

/// The first point, and after it all that touches or overlaps along the overlap's normal: the
/// outline's corners behind the wall, over its length, and the wall's ends behind the outline's
/// sides.
ContactPoints touchingPoints(const Outline& outline, const Placement& at, const WallSegment& wall,
                             const Overlap& overlap);

}  // namespace bumper
