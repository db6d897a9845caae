#include "bumper/response/contact_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "outline_oracle.h"

namespace bumper::tests {
namespace {

// Positions lie up to 100 m from the origin, where a double has 1.4e-14 m; sines and products of
// some of them, m.
constexpr double position = 1e-11;
// Points this near to the deepest one count as touching with it, m.
constexpr double flushness = 1e-9;
// Less of a wall than this inside the outline, or a depth less than this, may or may not be seen,
// m.
constexpr double graze = 1e-9;

struct Scene {
  Outline outline;
  Vector2 centre = Vector2::Zero();
  double yaw = 0.0;
  Segment wall = {};
};

std::ostream& operator<<(std::ostream& out, const Scene& s) {
  out.precision(17);
  return out << "front " << s.outline.front << " rear " << s.outline.rear << " half width "
             << s.outline.halfWidth << " at (" << s.centre.transpose() << ") yaw " << s.yaw
             << " wall (" << s.wall.start.transpose() << ") to (" << s.wall.end.transpose()
             << ") normal (" << s.wall.normal.transpose() << ")\n";
}

enum class Length { long_wall, short_wall };
enum class Heading { any, flush };

/// An outline that is 0.1 to 60 cm deep in the line of a wall.
Scene randomScene(Random& random, Length length, Heading heading) {
  Scene scene{.outline = Outline(randomVehicle(random))};
  scene.centre = {random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0)};
  scene.yaw = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double turn = heading == Heading::flush
                          ? random.below(4) * std::numbers::pi / 2.0
                          : random.uniform(-std::numbers::pi, std::numbers::pi);
  const double facing = scene.yaw + turn;
  const Vector2 normal(std::cos(facing), std::sin(facing));
  double lowest = 0.0;
  for (const Vector2& corner : scene.outline.corners()) {
    lowest = std::min(lowest, normal.dot(rotated(corner, scene.yaw)));
  }
  const double depth = std::pow(10.0, random.uniform(-3.0, std::log10(0.6)));
  const Vector2 middle = scene.centre + (lowest + depth) * normal;
  double from = -random.uniform(5.0, 50.0), to = random.uniform(5.0, 50.0);
  if (length == Length::short_wall) {
    from = random.uniform(-4.0, 4.0);
    to = from + std::pow(10.0, random.uniform(-2.0, 0.7));
  }
  scene.wall.start = middle + from * turnedLeft(normal);
  scene.wall.end = middle + to * turnedLeft(normal);
  if (random.chance(0.5)) std::swap(scene.wall.start, scene.wall.end);
  scene.wall.normal = random.sign() * normal;
  return scene;
}

/// How far along a wall of a given depth a side's cut moves, at most, for each m of depth.
double sideways(const Scene& s) {
  const Vector2 along = rotated((s.wall.end - s.wall.start).normalized(), -s.yaw);
  const double slope = std::min(std::abs(along.x()), std::abs(along.y()));
  return slope < 1e-6 ? 1.0 : 1.0 / slope;
}

std::optional<Overlap> overlapOf(const Scene& s) {
  return findOverlap(s.outline, {s.centre, s.yaw}, s.wall);
}
std::optional<ExactOverlap> exactOverlapOf(const Scene& s) {
  return exactOverlap(s.outline, s.centre, s.yaw, s.wall);
}

TEST(Outline, CornersAreTheRectangleOfTheVehicle) {
  VehicleParameters vehicle;
  vehicle.massCentreToFront = 2.1;
  vehicle.massCentreToRear = 2.5;
  vehicle.width = 1.8;
  const std::array<Vector2, 4> corners = Outline(vehicle).corners();
  EXPECT_EQ(corners[0], Vector2(2.1, 0.9));
  EXPECT_EQ(corners[1], Vector2(-2.5, 0.9));
  EXPECT_EQ(corners[2], Vector2(-2.5, -0.9));
  EXPECT_EQ(corners[3], Vector2(2.1, -0.9));
}

struct Kind {
  const char* name;
  Length length;
  Heading heading;
};

class ContactPointOf : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(Walls, ContactPointOf,
                         testing::Values(Kind{"long", Length::long_wall, Heading::any},
                                         Kind{"short", Length::short_wall, Heading::any},
                                         Kind{"long_flush", Length::long_wall, Heading::flush},
                                         Kind{"short_flush", Length::short_wall, Heading::flush}),
                         [](const auto& kind) { return std::string(kind.param.name); });

/// Names a parameter in the output.
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

TEST_P(ContactPointOf, OverlapIsTheClippedOutline) {
  Random random(401);
  int seen = 0, missed = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Scene s = randomScene(random, GetParam().length, GetParam().heading);
    const std::optional<ExactOverlap> exact = exactOverlapOf(s);
    const std::optional<Overlap> overlap = overlapOf(s);
    if (exact && (exact->lengthInside < graze || exact->depth < graze)) continue;
    if (!exact) {
      ASSERT_FALSE(overlap.has_value()) << i << '\n' << s;
      ++missed;
      continue;
    }
    ++seen;
    ASSERT_TRUE(overlap.has_value()) << i << '\n' << s;
    // The direction of a short wall is known only to the rounding of its ends.
    const double turn = 1e-13 / (s.wall.end - s.wall.start).norm();
    ASSERT_NEAR(apart(overlap->normal, exact->normal), 0.0, 1e-14 + turn) << i << '\n' << s;
    const double lever = position + 150.0 * turn;
    ASSERT_NEAR(overlap->offset, static_cast<double>(exact->offset), lever) << i << '\n' << s;
    ASSERT_NEAR(overlap->start, static_cast<double>(exact->start), lever) << i << '\n' << s;
    ASSERT_NEAR(overlap->end, static_cast<double>(exact->end), lever) << i << '\n' << s;
    ASSERT_NEAR(overlap->depth, static_cast<double>(exact->depth), lever) << i << '\n' << s;
    ASSERT_NEAR(overlap->deepest, static_cast<double>(exact->deepest),
                lever + 2.0 * flushness * sideways(s))
        << i << '\n'
        << s;
  }
  EXPECT_GT(seen, 2'000);
  if (GetParam().length == Length::short_wall) {
    EXPECT_GT(missed, 500);
  }
}

TEST_P(ContactPointOf, ContactIsTheMiddleOfTheWallInside) {
  Random random(402);
  int compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Scene s = randomScene(random, GetParam().length, GetParam().heading);
    const std::optional<ExactOverlap> exact = exactOverlapOf(s);
    const std::optional<Overlap> overlap = overlapOf(s);
    if (!exact || !overlap || exact->lengthInside < graze || exact->depth < graze) continue;
    for (const double penetration :
         {overlap->depth, 0.001, random.uniform(0.001, 0.1), random.uniform(0.1, 0.6)}) {
      const std::optional<Plane> arm = exactArm(s.outline, s.centre, s.yaw, *exact, penetration);
      if (!arm) continue;
      ++compared;
      const ContactPoint contact =
          contactPoint(s.outline, {s.centre, s.yaw}, s.wall, *overlap, penetration);
      // Where a side is nearly parallel to the wall, the wall's cut moves by 1/sin of the angle.
      const double tolerance = GetParam().heading == Heading::flush ? position : 1e-8;
      ASSERT_NEAR(apart(contact.arm, *arm), 0.0, tolerance)
          << i << " penetration " << penetration << '\n'
          << s;
      // The point lies on the wall, and the arm's end there once the outline is moved.
      ASSERT_NEAR(overlap->normal.dot(contact.point), overlap->offset, position) << i << '\n' << s;
      const Vector2 moved = s.centre + (overlap->depth - penetration) * overlap->normal;
      ASSERT_NEAR((moved + contact.arm - contact.point).norm(), 0.0, position) << i << '\n' << s;
      // And inside the outline.
      const Vector2 inBody = rotated(contact.arm, -s.yaw);
      ASSERT_LE(inBody.x(), s.outline.front + position);
      ASSERT_GE(inBody.x(), -s.outline.rear - position);
      ASSERT_LE(std::abs(inBody.y()), s.outline.halfWidth + position);
    }
  }
  EXPECT_GT(compared, 10'000);
}

TEST_P(ContactPointOf, FirstTouchIsTheDeepestPoint) {
  Random random(403);
  for (int i = 0; i < 10'000; ++i) {
    const Scene s = randomScene(random, GetParam().length, GetParam().heading);
    const std::optional<ExactOverlap> exact = exactOverlapOf(s);
    const std::optional<Overlap> overlap = overlapOf(s);
    if (!exact || !overlap || exact->lengthInside < graze || exact->depth < graze) continue;
    const Plane touched = (exact->offset - exact->depth) * exact->normal +
                          exact->deepest * exact->tangent - s.centre.cast<Real>();
    const ContactPoint contact = contactPoint(s.outline, {s.centre, s.yaw}, s.wall, *overlap, 0.0);
    ASSERT_NEAR(apart(contact.arm, touched), 0.0, position + 4.0 * flushness * sideways(s))
        << i << '\n'
        << s;
  }
}

TEST_P(ContactPointOf, HowDeepTheStepWentDoesNotMatter) {
  Random random(404);
  for (int i = 0; i < 10'000; ++i) {
    const Scene s = randomScene(random, GetParam().length, GetParam().heading);
    const std::optional<Overlap> overlap = overlapOf(s);
    if (!overlap || overlap->depth < graze) continue;
    Scene deeper = s;
    deeper.centre -= random.uniform(0.0, 0.3) * overlap->normal;
    if (overlap->normal.dot(deeper.centre) - overlap->offset < 0.01) continue;
    const std::optional<Overlap> deeperOverlap = overlapOf(deeper);
    // A short wall may be swallowed whole by the outline, but it does not get out of it.
    if (!deeperOverlap) continue;
    const double penetration = random.uniform(0.0, 0.2);
    const ContactPoint a =
        contactPoint(s.outline, {s.centre, s.yaw}, s.wall, *overlap, penetration);
    const ContactPoint b = contactPoint(deeper.outline, {deeper.centre, deeper.yaw}, deeper.wall,
                                        *deeperOverlap, penetration);
    ASSERT_NEAR((a.arm - b.arm).norm(), 0.0, 1e-8) << i << '\n' << s;
    ASSERT_NEAR((a.point - b.point).norm(), 0.0, 1e-8) << i << '\n' << s;
  }
}

TEST_P(ContactPointOf, TheWallsOwnSideDoesNotMatter) {
  Random random(405);
  for (int i = 0; i < 10'000; ++i) {
    const Scene s = randomScene(random, GetParam().length, GetParam().heading);
    Scene reversed = s;
    reversed.wall.normal = -s.wall.normal;
    std::swap(reversed.wall.start, reversed.wall.end);
    const std::optional<Overlap> a = overlapOf(s), b = overlapOf(reversed);
    ASSERT_EQ(a.has_value(), b.has_value()) << i << '\n' << s;
    if (!a) continue;
    ASSERT_NEAR((a->normal - b->normal).norm(), 0.0, 1e-15) << i << '\n' << s;
    ASSERT_NEAR(a->depth, b->depth, position) << i << '\n' << s;
    ASSERT_NEAR(a->deepest, b->deepest, position + 2.0 * flushness * sideways(s)) << i << '\n' << s;
  }
}

TEST(ContactPoint, PenetrationEndsAtTheMassCentre) {
  Random random(406);
  for (int i = 0; i < 5'000; ++i) {
    const Scene s = randomScene(random, Length::long_wall, Heading::any);
    const std::optional<Overlap> overlap = overlapOf(s);
    ASSERT_TRUE(overlap.has_value());
    const double toCentre = overlap->depth + overlap->normal.dot(s.centre) - overlap->offset;
    const ContactPoint most =
        contactPoint(s.outline, {s.centre, s.yaw}, s.wall, *overlap, toCentre);
    for (const double beyond : {toCentre + 0.5, 100.0}) {
      const ContactPoint contact =
          contactPoint(s.outline, {s.centre, s.yaw}, s.wall, *overlap, beyond);
      ASSERT_NEAR((contact.arm - most.arm).norm(), 0.0, 1e-9) << i << '\n' << s;
      ASSERT_NEAR(overlap->normal.dot(contact.arm), 0.0, 1e-9) << i << '\n' << s;
    }
  }
}

TEST(ContactPoint, PaperFigure2) {
  // A front-right corner in a wall: the wall is the line x = 2 in front of the car, the car turned
  // left by 45°, so that its nose corner is cut off as an isosceles triangle.
  VehicleParameters vehicle;
  vehicle.massCentreToFront = 2.0;
  vehicle.massCentreToRear = 2.5;
  vehicle.width = 2.0;
  const Outline outline(vehicle);
  const double yaw = std::numbers::pi / 4.0;
  const Vector2 corner = rotated({2.0, -1.0}, yaw);
  const Vector2 centre = Vector2(2.3, 7.0) - corner;
  const Segment wall{.start = {2.0, -50.0}, .end = {2.0, 50.0}, .normal = {1.0, 0.0}};
  const std::optional<Overlap> overlap = findOverlap(outline, {centre, yaw}, wall);
  ASSERT_TRUE(overlap.has_value());
  EXPECT_NEAR(overlap->depth, 0.3, 1e-14);
  EXPECT_NEAR((overlap->normal - Vector2(-1.0, 0.0)).norm(), 0.0, 1e-15);
  const ContactPoint contact = contactPoint(outline, {centre, yaw}, wall, *overlap, 0.3);
  EXPECT_NEAR((contact.point - Vector2(2.0, 7.0)).norm(), 0.0, 1e-13);
}

}  // namespace
}  // namespace bumper::tests
