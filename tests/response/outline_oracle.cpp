#include "outline_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bumper::tests {
namespace {

// A side counts as flush if its ends are equally deep to this, m.
constexpr Real flush = 1e-9L;

}  // namespace

Polygon placed(const Outline& outline, const Plane& position, Real yaw) {
  const Real f = outline.front, r = -Real{outline.rear}, w = outline.halfWidth;
  Polygon polygon;
  for (const Plane& corner : {Plane(f, w), Plane(r, w), Plane(r, -w), Plane(f, -w)}) {
    polygon.emplace_back(position + Plane(std::cos(yaw) * corner.x() - std::sin(yaw) * corner.y(),
                                          std::sin(yaw) * corner.x() + std::cos(yaw) * corner.y()));
  }
  return polygon;
}

Polygon clipped(const Polygon& polygon, const Plane& direction, Real limit) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Plane& a = polygon[i];
    const Plane& b = polygon[(i + 1) % polygon.size()];
    const Real beyondA = direction.dot(a) - limit, beyondB = direction.dot(b) - limit;
    if (beyondA <= 0.0L) result.push_back(a);
    if ((beyondA < 0.0L && beyondB > 0.0L) || (beyondA > 0.0L && beyondB < 0.0L)) {
      result.emplace_back(a + beyondA / (beyondA - beyondB) * (b - a));
    }
  }
  return result;
}

std::optional<Piece> inside(const Polygon& polygon, const Plane& start, const Plane& end) {
  Real low = 0.0L, high = 1.0L;
  const Plane along = end - start;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Plane& a = polygon[i];
    const Plane edge = polygon[(i + 1) % polygon.size()] - a;
    // Inside is left of each edge.
    const auto leftOf = [&](const Plane& p) { return edge.x() * p.y() - edge.y() * p.x(); };
    const Real atStart = leftOf(start - a), slope = leftOf(along);
    if (slope == 0.0L) {
      if (atStart < 0.0L) return std::nullopt;
    } else if (slope > 0.0L) {
      low = std::max(low, -atStart / slope);
    } else {
      high = std::min(high, -atStart / slope);
    }
  }
  if (low >= high) return std::nullopt;
  return Piece{start + low * along, start + high * along};
}

std::optional<ExactOverlap> exactOverlap(const Outline& outline, const Vector2& position,
                                         double yaw, const Segment& wall) {
  const Plane centre = position.cast<Real>();
  const Plane start = wall.start.cast<Real>(), end = wall.end.cast<Real>();
  const Polygon rectangle = placed(outline, centre, yaw);
  const std::optional<Piece> piece = inside(rectangle, start, end);
  if (!piece) return std::nullopt;

  ExactOverlap overlap;
  const Plane along = (end - start).normalized();
  overlap.normal = Plane(-along.y(), along.x());
  if (overlap.normal.dot(centre - start) < 0.0L) overlap.normal = -overlap.normal;
  overlap.tangent = Plane(-overlap.normal.y(), overlap.normal.x());
  overlap.offset = overlap.normal.dot(start);
  overlap.start = std::min(overlap.tangent.dot(start), overlap.tangent.dot(end));
  overlap.end = std::max(overlap.tangent.dot(start), overlap.tangent.dot(end));
  overlap.lengthInside = piece->length();

  Polygon over = clipped(rectangle, overlap.tangent, overlap.end);
  over = clipped(over, -overlap.tangent, -overlap.start);
  Real lowest = overlap.offset;
  for (const Plane& p : over) lowest = std::min(lowest, overlap.normal.dot(p));
  overlap.depth = overlap.offset - lowest;
  Real first = std::numeric_limits<Real>::infinity(), last = -first;
  for (const Plane& p : over) {
    if (overlap.normal.dot(p) > lowest + flush) continue;
    first = std::min(first, overlap.tangent.dot(p));
    last = std::max(last, overlap.tangent.dot(p));
  }
  overlap.deepest = 0.5L * (first + last);
  return overlap;
}

std::optional<Plane> exactArm(const Outline& outline, const Vector2& position, double yaw,
                              const ExactOverlap& overlap, Real penetration) {
  const Plane centre = position.cast<Real>() + (overlap.depth - penetration) * overlap.normal;
  const auto onWall = [&](Real along) -> Plane {
    return overlap.offset * overlap.normal + along * overlap.tangent;
  };
  const std::optional<Piece> piece =
      inside(placed(outline, centre, yaw), onWall(overlap.start), onWall(overlap.end));
  if (!piece) return std::nullopt;
  return Plane(piece->middle() - centre);
}

}  // namespace bumper::tests
