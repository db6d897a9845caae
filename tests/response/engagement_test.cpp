#include "engagement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "outline_oracle.h"
#include "random_impacts.h"

/// The push of a wall's part inside the outline against its definition: half the integral of the
/// squared distance to the nearest side, differentiated numerically in extended precision.
namespace bumper::tests {
namespace {

constexpr Real differenceStep = 1e-5L;  // m

struct Scene {
  Outline outline{VehicleParameters{}};
  Vector2 position = Vector2::Zero();
  double yaw = 0.0;
  Segment wall{};
};

Segment segmentBetween(const Vector2& start, const Vector2& end) {
  return {.start = start, .end = end, .normal = turnedLeft((end - start).normalized())};
}

Scene randomScene(Random& random) {
  Scene scene{.outline = Outline(randomVehicle(random))};
  scene.position = {random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0)};
  scene.yaw = random.uniform(-std::numbers::pi, std::numbers::pi);
  const auto nearby = [&](double reach) -> Vector2 {
    return scene.position + Vector2(random.uniform(-reach, reach), random.uniform(-reach, reach));
  };
  const Vector2 start = nearby(3.0);
  const double length = std::pow(10.0, random.uniform(-2.0, 1.5));
  // At random, or along a side.
  const double angle = random.chance(0.7) ? random.uniform(-std::numbers::pi, std::numbers::pi)
                                          : scene.yaw + 0.5 * std::numbers::pi * random.below(4);
  scene.wall = segmentBetween(start, start + length * direction(angle));
  return scene;
}

/// Of a point to the nearest side of a convex polygon, negative outside.
Real distanceInside(const Polygon& polygon, const Plane& point) {
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Plane edge = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
    const Plane arm = point - polygon[i];
    least = std::min(least, edge.x() * arm.y() - edge.y() * arm.x());
  }
  return least;
}

Polygon outlineOf(const Scene& scene, const Plane& moved = Plane::Zero()) {
  return placed(scene.outline, scene.position.cast<Real>() + moved, static_cast<Real>(scene.yaw));
}

std::optional<Piece> pieceInside(const Scene& scene, const Polygon& polygon) {
  return inside(polygon, scene.wall.start.cast<Real>(), scene.wall.end.cast<Real>());
}

/// Simpson's rule, halved until that changes nothing: exact between the places where another side
/// becomes the nearest.
class HalfSquaredDistance {
 public:
  HalfSquaredDistance(const Polygon& polygon, const Piece& piece)
      : polygon_(polygon), piece_(piece) {}

  [[nodiscard]] Real integral() const { return over(0.0L, 1.0L, 0) * piece_.length(); }

 private:
  [[nodiscard]] Real at(Real share) const {
    const Real d = distanceInside(polygon_, piece_.begin + share * (piece_.end - piece_.begin));
    return 0.5L * d * d;
  }
  [[nodiscard]] Real simpson(Real low, Real high) const {
    return (high - low) / 6.0L * (at(low) + 4.0L * at(0.5L * (low + high)) + at(high));
  }
  [[nodiscard]] Real over(Real low, Real high, int halved) const {
    const Real middle = 0.5L * (low + high);
    const Real whole = simpson(low, high);
    const Real halves = simpson(low, middle) + simpson(middle, high);
    if (halved >= 30 || (halved >= 4 && std::abs(whole - halves) < 1e-17L)) return halves;
    return over(low, middle, halved + 1) + over(middle, high, halved + 1);
  }

  const Polygon& polygon_;
  Piece piece_;
};

Real energyOf(const Scene& scene, const Plane& moved) {
  const Polygon polygon = outlineOf(scene, moved);
  const std::optional<Piece> piece = pieceInside(scene, polygon);
  return piece ? HalfSquaredDistance(polygon, *piece).integral() : 0.0L;
}

Plane pushOf(const Scene& scene) {
  Plane push;
  for (int axis = 0; axis < 2; ++axis) {
    const Plane ahead = differenceStep * Plane::Unit(axis);
    push[axis] = (energyOf(scene, -ahead) - energyOf(scene, ahead)) / (2.0L * differenceStep);
  }
  return push;
}

/// The distance is concave along the wall.
Real largestDistance(const Polygon& polygon, const Piece& piece) {
  Real low = 0.0L, high = 1.0L;
  const auto at = [&](Real share) {
    return distanceInside(polygon, piece.begin + share * (piece.end - piece.begin));
  };
  for (int i = 0; i < 120; ++i) {
    const Real first = (2.0L * low + high) / 3.0L, second = (low + 2.0L * high) / 3.0L;
    (at(first) < at(second) ? low : high) = at(first) < at(second) ? first : second;
  }
  return at(0.5L * (low + high));
}

TEST(Engagement, IsTheGradientOfTheSquaredDistance) {
  Random random(4101);
  int engaged = 0, endsInside = 0;
  double worst = 0.0;
  for (int i = 0; i < 1'200; ++i) {
    const Scene scene = randomScene(random);
    const Placement at(scene.position, scene.yaw);
    const Engagement found = engagement(scene.outline, at, scene.wall);
    const Polygon polygon = outlineOf(scene);
    const std::optional<Piece> piece = pieceInside(scene, polygon);
    if (!piece || piece->length() < 1e-9L) {
      ASSERT_LT(found.length, 2e-9) << i;
      ASSERT_LT(found.push.norm(), 1e-17) << i;
      continue;
    }
    ++engaged;
    const Vector2 start = scene.wall.start, end = scene.wall.end;
    if (distanceInside(polygon, start.cast<Real>()) > 0.0L ||
        distanceInside(polygon, end.cast<Real>()) > 0.0L) {
      ++endsInside;
    }
    ASSERT_NEAR(found.length, static_cast<double>(piece->length()), 1e-12) << i;
    ASSERT_LT(apart(found.moment, piece->length() * piece->middle()), 1e-11) << i;
    ASSERT_NEAR(found.depth, static_cast<double>(largestDistance(polygon, *piece)), 1e-12) << i;
    const double off = apart(found.push, pushOf(scene));
    worst = std::max(worst, off);
    ASSERT_LT(off, 1e-7) << i;
  }
  RecordProperty("farthest_from_the_gradient", testing::PrintToString(worst));
  EXPECT_GT(engaged, 300);
  EXPECT_GT(endsInside, 150);
}

TEST(Engagement, OfAWallThatPassesThroughIsAlongItsNormal) {
  Random random(4102);
  int passed = 0;
  double worst = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    const Scene scene = randomScene(random);
    const Vector2 along = (scene.wall.end - scene.wall.start).normalized();
    const Placement at(scene.position, scene.yaw);
    // From far outside to far outside, through a point near the mass centre's.
    const Segment wall =
        segmentBetween(scene.wall.start - 12.0 * along, scene.wall.start + 12.0 * along);
    const Engagement found = engagement(scene.outline, at, wall);
    if (found.length < 0.01) continue;  // rounding: a corner
    ++passed;
    // Pushes towards opposite sides may cancel: relative to what they are.
    const double skew = std::abs(found.push.dot(along)) / (found.length * found.depth);
    worst = std::max(worst, skew);
    ASSERT_LT(skew, 1e-12) << i << ": " << found.length << " m";
  }
  RecordProperty("farthest_from_the_normal", testing::PrintToString(worst));
  EXPECT_GT(passed, 5'000);
}

TEST(Engagement, DepthInsideIsTheDistanceToTheNearestSide) {
  Random random(4103);
  for (int i = 0; i < 5'000; ++i) {
    const Scene scene = randomScene(random);
    const Real expected = distanceInside(outlineOf(scene), scene.wall.start.cast<Real>());
    ASSERT_NEAR(depthInside(scene.outline, Placement(scene.position, scene.yaw), scene.wall.start),
                static_cast<double>(expected), 1e-12)
        << i;
  }
}

}  // namespace
}  // namespace bumper::tests
