#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "bumper/response/planar_motion.h"
#include "bumper/response/vehicle_parameters.h"

namespace bumper {

struct ResponseSettings;

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

  /// Front left, rear left, rear right, front right in the vehicle's frame: counter-clockwise.
  [[nodiscard]] std::array<Vector2, 4> corners() const;
};

/// A piece of a wall as a vehicle's yaw plane cuts it.
struct WallSegment {
  Vector2 start = Vector2::Zero();  ///< m
  Vector2 end = Vector2::Zero();    ///< m
  /// Unit, at right angles to the segment, to either side: which side the vehicle comes from is
  /// decided when they meet.
  Vector2 normal = Vector2::Zero();
  /// The caller's own number for the wall; comes back in the impact.
  int id = -1;
  /// How this wall answers; not owned, never null when it reaches a collision step.
  const ResponseSettings* settings = nullptr;
};

/// The outline and a wall that it overlaps.
struct Overlap {
  Vector2 normal;        ///< unit, out of the wall towards the mass centre
  double offset = 0.0;   ///< normal · p of the wall's line
  double start = 0.0;    ///< tangent · p where the wall begins; the tangent is z × normal
  double end = 0.0;      ///< … and where it ends, start ≤ end
  double a = 0.0;        ///< the line of interference, a ≤ b (Figure 2): the part of the wall
  double b = 0.0;        ///< inside the outline
  double depth = 0.0;    ///< of the outline's deepest point over the wall, m, ≥ 0
  double deepest = 0.0;  ///< tangent · p of that point, or of the middle of a flush side
};

/// A wall's line as seen from `position`: normal, offset, start and end of an overlap, no more.
Overlap lineOf(const WallSegment& wall, const Vector2& position);

/// The overlap of the outline, placed at `position` and `yaw`, with a wall; nothing if the wall
/// does not pass through it.
std::optional<Overlap> findOverlap(const Outline& outline, const Vector2& position, double yaw,
                                   const WallSegment& wall);

/// Where the response acts.
struct ContactPoint {
  Vector2 point;  ///< on the wall, m
  Vector2 arm;    ///< mass centre to the body's contact point, m, in the plane's frame
};

/// The midpoint of the line of interference (Figure 2) at a given depth of penetration: the outline
/// is moved along the normal until its deepest point is `penetration` inside the wall, and the
/// contact point is the middle of the part of the wall inside it. With the overlap's own depth this
/// is the paper's a–b midpoint; with 0 it is the point of first touch. A penetration beyond the
/// mass centre is taken as one at the mass centre.
ContactPoint contactPoint(const Outline& outline, const Vector2& position, double yaw,
                          const Overlap& overlap, double penetration);

/// How far the outline is to be moved along the normal, m, so that its deepest point is
/// `penetration` inside the wall: within bounds as contactPoint() says.
double moveTo(const Overlap& overlap, const Vector2& position, double penetration);

/// The part of a wall's line inside the outline.
struct Interference {
  bool empty = true;
  double length = 0.0;  ///< m
  ContactPoint middle;
};
Interference interference(const Outline& outline, const Vector2& position, double yaw,
                          const Overlap& overlap);

/// Up to four contact points.
struct ContactPoints {
  std::array<ContactPoint, 4> points;
  std::size_t count = 0;
};

/// The outline's corners that lie behind the wall, over its length.
ContactPoints cornersBehind(const Outline& outline, const Vector2& position, double yaw,
                            const Overlap& overlap);

}  // namespace bumper
