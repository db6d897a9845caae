#include "small_feature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "../tolerances.h"

namespace bumper {

namespace {

// Cosines of the angle between a wall that the outline slides on and what it meets: from one to the
// other that turns from an obstacle into the same wall.
constexpr double flattest = 0.8;
constexpr double steepest = 0.95;

constexpr double reachShare = 0.25;  // of the smallest feature

// Shares that differ by less do so by rounding.
constexpr double sameShare = 1e-12;

// Of the outline along a direction, from the origin of the plane, m.
double lowest(const Outline& outline, const Placement& at, const Vector2& up) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector2& corner : outline.corners())
    least = std::min(least, up.dot(at.turned(corner)));
  return up.dot(at.position) + least;
}

// Whether a wall goes on from here towards the side that `up` points to.
bool risesFrom(const ContactSet& contacts, const Manifold& struck, const Vector2& place,
               const Vector2& up) {
  return std::any_of(contacts.all().begin(), contacts.all().end(), [&](const Manifold& wall) {
    if (&wall == &struck || wall.passed || wall.segment.isPost()) return false;
    const auto rises = [&](const Vector2& from, const Vector2& to) {
      return (from - place).squaredNorm() <= jointWidth * jointWidth &&
             up.dot(to - from) > nearlyInLine * (to - from).norm();
    };
    return rises(wall.segment.start, wall.segment.end) ||
           rises(wall.segment.end, wall.segment.start);
  });
}

}  // namespace

Yielding yieldingOf(const ContactSet& contacts, const Manifold& struck, const Vector2& touched,
                    const Vector2& normal, const Outline& outline, const Placement& at) {
  Yielding result;
  const double size = contacts.settingsOf(struck).smallestFeature * (outline.front + outline.rear);
  const Segment& wall = struck.segment;
  if (!(size > 0.0) || wall.isPost()) return result;
  const Outline near = outline.grown(2.0 * size);
  double shortest = std::numeric_limits<double>::infinity();
  const std::optional<Vector2> end = struck.overlap.byEnd ? endAt(wall, touched) : std::nullopt;
  for (const Manifold& other : contacts.all()) {
    if (&other == &struck || other.passed || other.segment.isPost()) continue;
    const std::optional<Overlap> ground = findTouch(near, at, other.segment);
    if (!ground) continue;
    const Vector2& up = ground->normal;
    const double across = std::clamp((steepest - up.dot(normal)) / (steepest - flattest), 0.0, 1.0);
    if (across == 0.0) continue;
    const Vector2 top = end ? *end : up.dot(wall.end - wall.start) > 0.0 ? wall.end : wall.start;
    const double covered = up.dot(top) - lowest(outline, at, up);
    if (covered < -touchTolerance) continue;
    // Only what lies on the vehicle's side of the feature, and that the outline is not in itself.
    const Segment& before = other.segment;
    const double ahead = std::max(normal.dot(before.start - top), normal.dot(before.end - top));
    const double exposed = up.dot(top) - ground->offset;
    const double run = std::abs(cross(up, top - touched));
    const double worst = std::max(exposed, covered - exposed) + run;
    const double share =
        across * std::clamp(ahead / size, 0.0, 1.0) * std::clamp(2.0 - worst / size, 0.0, 1.0);
    const double aside = std::max(std::min(covered, share * size), 0.0);
    // Of several that it slides on alike the nearest one.
    const bool alike = std::abs(share - result.share) <= sameShare;
    const double way = ahead + aside;
    if (share <= 0.0 || (alike ? way >= shortest : share < result.share)) continue;
    if (risesFrom(contacts, struck, top, up)) continue;
    shortest = way;
    result = {.aside = aside * up, .share = share, .reach = reachShare * size};
  }
  return result;
}

}  // namespace bumper
