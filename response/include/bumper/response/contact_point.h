#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bumper/base/api.h"
#include "bumper/response/touch.h"

namespace BUMPER_API bumper {

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
ContactPoint contactPoint(const Outline& outline, const Placement& at, const Segment& wall,
                          const Overlap& overlap, double penetration);

/// How far to move the outline along the normal, m, so that its deepest point is `penetration`
/// inside the wall, bounded as in contactPoint().
double moveTo(const Overlap& overlap, const Vector2& position, double penetration);

/// Up to seven contact points.
struct ContactPoints {
  std::array<ContactPoint, 7> points;
  std::size_t count = 0;

  void add(const ContactPoint& point) { points[count++] = point; }
  [[nodiscard]] std::span<const ContactPoint> all() const { return {points.data(), count}; }
};

/// The first point, then all points that touch or overlap along the overlap's normal: the outline's
/// corners behind the wall, over its length, and the wall's ends behind the outline's sides.
ContactPoints touchingPoints(const Outline& outline, const Placement& at, const Segment& wall,
                             const Overlap& overlap);

}  // namespace bumper
