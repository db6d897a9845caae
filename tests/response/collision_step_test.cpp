#include "bumper/response/collision_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "car.h"
#include "random_impacts.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

const ResponseSettings paperSettings;
const std::array paperSurface{Surface{.settings = &paperSettings}};

Segment wallBetween(const Vector2& start, const Vector2& end, int id = 0) {
  return {.start = start, .end = end, .normal = turnedLeft((end - start).normalized()), .id = id};
}

/// A wall with the given unit normal into which the outline reaches `depth` deep, reaching `left`
/// and `right` along the tangent from the middle of the outline.
Segment wallAt(const PlanarMotion& motion, const Vector2& normal, double depth, int id = 0,
               double left = 50.0, double right = 50.0) {
  double lowest = 0.0;
  for (const Vector2& corner : Outline(car).corners()) {
    lowest = std::min(lowest, normal.dot(rotated(corner, motion.yaw)));
  }
  const Vector2 middle = motion.position + (lowest + depth) * normal;
  return wallBetween(middle - right * turnedLeft(normal), middle + left * turnedLeft(normal), id);
}

/// Two walls that meet, both facing the vehicle; it may overlap either or both.
/// Opening is the angle between them where the vehicle is, rad.
std::array<Segment, 2> insideCorner(Random& random, const PlanarMotion& motion,
                                    const Vector2& normal, double opening) {
  const double turn = random.sign() * (std::numbers::pi - opening);
  const Vector2 second = rotated(normal, turn);
  const Segment a = wallAt(motion, normal, random.uniform(0.001, 0.2), 0);
  const Segment b = wallAt(motion, second, random.uniform(0.001, 0.2), 1);
  // Each ends where it meets the other, and goes on where it is in front of that.
  const Vector2 along = (a.end - a.start).normalized();
  const Vector2 meeting = a.start + second.dot(b.start - a.start) / second.dot(along) * along;
  const auto inFrontOf = [&](const Segment& wall, const Vector2& other, int id) {
    Vector2 away = (wall.end - wall.start).normalized();
    if (away.dot(other) < 0.0) away = -away;
    return wallBetween(meeting, meeting + 50.0 * away, id);
  };
  return {inFrontOf(a, second, 0), inFrontOf(b, normal, 1)};
}

/// How far the outline's second corner is behind its first along a wall's normal, m.
double secondCorner(const PlanarMotion& motion, const Vector2& normal) {
  std::array<double, 4> heights{};
  std::ranges::transform(Outline(car).corners(), heights.begin(), [&](const Vector2& corner) {
    return normal.dot(rotated(corner, motion.yaw));
  });
  std::ranges::sort(heights);
  return heights[1] - heights[0];
}

double energyOf(const PlanarMotion& motion) {
  return yawPlaneEnergy(motion, car.mass, car.yawInertia);
}

/// How fast the first-touched point of an overlap closes on the wall, m/s.
double approachSpeed(const PlanarMotion& motion, const Segment& wall, const Overlap& overlap) {
  const ContactPoint first = contactPoint(Outline(car), motion.placement(), wall, overlap, 0.0);
  return -velocityAt(motion, first.arm).dot(overlap.normal);
}

void expectSameMotion(const PlanarMotion& a, const PlanarMotion& b, double tolerance,
                      const std::string& where) {
  ASSERT_NEAR((a.velocity - b.velocity).norm(), 0.0, tolerance) << where;
  ASSERT_NEAR(a.yawRate, b.yawRate, tolerance) << where;
}

/// A car somewhere, and a unit normal that it drives against.
std::pair<PlanarMotion, Vector2> randomApproach(Random& random) {
  PlanarMotion motion;
  motion.position = {random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0)};
  motion.yaw = random.uniform(-3.0, 3.0);
  motion.velocity =
      random.uniform(2.0, 40.0) * rotated({1.0, 0.0}, motion.yaw + random.uniform(-0.2, 0.2));
  motion.yawRate = random.uniform(-1.0, 1.0);
  const double attack = random.uniform(5.0, 175.0) * degree;
  const Vector2 direction = motion.velocity.normalized();
  return {motion, -rotated(direction, attack - 0.5 * std::numbers::pi)};
}

TEST(CollisionStep, HeadOnReboundsWithTheCurvesRestitution) {
  const PlanarMotion motion{.velocity = {20.0, 0.0}};
  const Segment wall = wallAt(motion, {-1.0, 0.0}, 0.07, 42);
  CollisionStep step;
  const StepOutcome outcome = step.resolve(car, motion, {{&wall, 1}, paperSurface}, 0.0);
  ASSERT_EQ(outcome.impacts.size(), 1U);
  EXPECT_EQ(outcome.impacts[0].impact.wall, 42);
  EXPECT_NEAR(outcome.impacts[0].impact.depth, 0.07, 1e-12);
  EXPECT_NEAR((outcome.impacts[0].impact.normal - Vector2(-1.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(outcome.after.velocity.x(), -0.05 * 20.0, 1e-12);
  EXPECT_NEAR(outcome.after.velocity.y(), 0.0, 1e-12);
  EXPECT_NEAR(outcome.after.yawRate, 0.0, 1e-12);
  EXPECT_NEAR(outcome.impulse.linear.x(), -1500.0 * 21.0, 1e-8);
  EXPECT_TRUE(outcome.settled);
}

TEST(CollisionStep, OneWallIsOverlapContactPointAndResponse) {
  Random random(701);
  CollisionStep step;
  int exact = 0;
  for (int i = 0; i < 10'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const Segment wall = wallAt(motion, normal, random.uniform(0.001, 0.2), i);
    const StepOutcome outcome = step.resolve(car, motion, {{&wall, 1}, paperSurface}, 0.0);

    const std::optional<Overlap> overlap = findOverlap(Outline(car), motion.placement(), wall);
    ASSERT_TRUE(overlap.has_value());
    const double approach = approachSpeed(motion, wall, *overlap);
    if (approach < 2.0 * paperSettings.restSpeed) continue;  // may be no event
    const ContactPoint contact = contactPoint(Outline(car), motion.placement(), wall, *overlap,
                                              approach * paperSettings.penetrationTime);
    const Impact impact{.wall = i,
                        .point = contact.point,
                        .normal = overlap->normal,
                        .arm = contact.arm,
                        .depth = overlap->depth};
    if (-velocityAt(motion, contact.arm).dot(overlap->normal) < 2.0 * paperSettings.restSpeed) {
      continue;
    }
    const ImpactResponse expected = respond(impact, freeBody(car, motion), paperSettings);
    ASSERT_GE(outcome.impacts.size(), 1U) << i;
    const StepImpact& first = outcome.impacts[0];
    EXPECT_EQ(first.impact.wall, i);
    if (secondCorner(motion, normal) > overlap->depth) {
      ++exact;
      // First touch is known to a nanometre, its speed and the response accordingly.
      ASSERT_NEAR((first.impact.point - impact.point).norm(), 0.0, 1e-6) << i;
      ASSERT_NEAR((first.impact.arm - impact.arm).norm(), 0.0, 1e-6) << i;
      expectSameMotion(first.response.after, expected.after, 1e-6, std::to_string(i));
    } else {
      // With two corners inside, either may be the one that touched first; the yaw rate makes
      // their speeds, and so the depths of penetration, a little different.
      const double difference = std::abs(motion.yawRate) *
                                (car.massCentreToFront + car.massCentreToRear) *
                                paperSettings.penetrationTime;
      ASSERT_NEAR(first.impact.point.dot(normal), impact.point.dot(normal), 1e-9) << i;
      ASSERT_NEAR((first.impact.arm - impact.arm).dot(normal), 0.0, difference + 1e-9) << i;
    }
  }
  EXPECT_GT(exact, 5'000);
}

/// What must hold after any step.
void expectSound(const StepOutcome& outcome, const PlanarMotion& motion,
                 std::span<const Segment> walls, int i) {
  ASSERT_LE(outcome.impacts.size(), static_cast<std::size_t>(CollisionStep::maxImpacts));
  ASSERT_TRUE(isFinite(outcome.after)) << i;
  ASSERT_LE(energyOf(outcome.after), energyOf(motion) * (1.0 + 1e-12)) << i;
  ASSERT_EQ(outcome.after.position, motion.position) << i;
  ASSERT_EQ(outcome.after.yaw, motion.yaw) << i;
  // The impulse, the impacts and the motion after tell the same.
  PlanarImpulse sum;
  for (const StepImpact& impact : outcome.impacts) {
    sum.linear += impact.response.impulse.linear;
    sum.angular += impact.response.impulse.angular;
    // Each impact pushes.
    ASSERT_GE(impact.response.impulse.linear.dot(impact.impact.normal), -1e-9) << i;
    ASSERT_LE(impact.response.contact.energyChange, 1e-9) << i;
  }
  const double strength = 1e-9 * (1.0 + car.mass * motion.velocity.norm());
  ASSERT_NEAR((sum.linear - outcome.impulse.linear).norm(), 0.0, strength) << i;
  ASSERT_NEAR(sum.angular, outcome.impulse.angular, strength) << i;
  expectSameMotion(outcome.after, afterImpulse(motion, outcome.impulse, car.mass, car.yawInertia),
                   1e-9, std::to_string(i));
  if (!outcome.settled) return;
  for (const Segment& wall : walls) {
    const std::optional<Overlap> overlap = findOverlap(Outline(car), motion.placement(), wall);
    if (!overlap) continue;
    ASSERT_LE(approachSpeed(outcome.after, wall, *overlap), 1e-6) << i << " wall " << wall.id;
  }
}

TEST(CollisionStep, OneWallIsAlwaysLeft) {
  Random random(702);
  CollisionStep step;
  for (int i = 0; i < 30'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const Segment wall = wallAt(motion, normal, random.uniform(0.001, 0.3));
    const StepOutcome outcome = step.resolve(car, motion, {{&wall, 1}, paperSurface}, 0.0);
    ASSERT_TRUE(outcome.settled) << i;
    expectSound(outcome, motion, {&wall, 1}, i);
    if (HasFatalFailure()) return;
  }
}

TEST(CollisionStep, InsideCornersLoseEnergyAndAreLeft) {
  Random random(703);
  CollisionStep step;
  int both = 0;
  for (int i = 0; i < 30'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const double opening = random.uniform(90.0, 170.0) * degree;
    const std::array<Segment, 2> walls = insideCorner(random, motion, normal, opening);
    const StepOutcome outcome = step.resolve(car, motion, {walls, paperSurface}, 0.0);
    ASSERT_TRUE(outcome.settled) << i << " opening " << opening / degree;
    expectSound(outcome, motion, walls, i);
    if (HasFatalFailure()) return;
    bool seen[2] = {};
    for (const StepImpact& impact : outcome.impacts) seen[impact.impact.wall] = true;
    both += seen[0] && seen[1] ? 1 : 0;
  }
  EXPECT_GT(both, 1'000);
}

// In a wedge the impulses would go to and fro for ever; after a bounded number of them both walls
// are solved together.
TEST(CollisionStep, WedgesLoseEnergyAndAreLeft) {
  Random random(712);
  CollisionStep step;
  for (int i = 0; i < 30'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const double opening = random.uniform(5.0, 90.0) * degree;
    const std::array<Segment, 2> walls = insideCorner(random, motion, normal, opening);
    const StepOutcome outcome = step.resolve(car, motion, {walls, paperSurface}, 0.0);
    ASSERT_TRUE(outcome.settled) << i << " opening " << opening / degree;
    expectSound(outcome, motion, walls, i);
    if (HasFatalFailure()) return;
  }
}

TEST(CollisionStep, LeavingAWallTakesNoImpulse) {
  Random random(704);
  CollisionStep step;
  for (int i = 0; i < 5'000; ++i) {
    auto [motion, normal] = randomApproach(random);
    motion.yawRate = 0.0;
    motion.velocity = -motion.velocity;
    const Segment wall = wallAt(motion, normal, random.uniform(0.001, 0.5));
    const StepOutcome outcome = step.resolve(car, motion, {{&wall, 1}, paperSurface}, 0.0);
    ASSERT_TRUE(outcome.impacts.empty()) << i;
    ASSERT_TRUE(outcome.settled) << i;
    ASSERT_EQ(outcome.impulse.linear, Vector2::Zero());
    ASSERT_EQ(outcome.impulse.angular, 0.0);
    ASSERT_EQ(outcome.after.velocity, motion.velocity);
    ASSERT_EQ(outcome.after.yawRate, motion.yawRate);
  }
}

TEST(CollisionStep, WallsOutOfReachDoNotCount) {
  Random random(705);
  CollisionStep step;
  for (int i = 0; i < 5'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const Segment near = wallAt(motion, normal, -random.uniform(0.001, 1.0));
    // In line with the outline's front, but beside it.
    const Segment beside = wallAt(motion, normal, 0.1, 1, 20.0, -6.0);
    const Segment walls[] = {near, beside};
    const StepOutcome outcome = step.resolve(car, motion, {walls, paperSurface}, 0.0);
    ASSERT_TRUE(outcome.impacts.empty()) << i;
    ASSERT_EQ(outcome.after.velocity, motion.velocity);
  }
  const StepOutcome none = step.resolve(car, {.velocity = {1.0, 2.0}}, {{}, paperSurface}, 0.0);
  EXPECT_TRUE(none.impacts.empty());
  EXPECT_TRUE(none.settled);
  EXPECT_EQ(none.after.velocity, Vector2(1.0, 2.0));
}

TEST(CollisionStep, TheBackOfAThickWallStaysHidden) {
  Random random(706);
  CollisionStep step;
  for (int i = 0; i < 5'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const double depth = random.uniform(0.25, 0.6), thickness = random.uniform(0.05, 0.2);
    const Segment front = wallAt(motion, normal, depth, 1);
    Segment back = front;
    back.start -= thickness * normal;
    back.end -= thickness * normal;
    back.normal = -front.normal;
    back.id = 2;
    const Segment cap = wallBetween(front.end, back.end, 3);
    const Segment otherCap = wallBetween(back.start, front.start, 4);
    const Segment walls[] = {back, cap, front, otherCap};
    const PlanarMotion expected = step.resolve(car, motion, {{&front, 1}, paperSurface}, 0.0).after;
    const StepOutcome outcome = step.resolve(car, motion, {walls, paperSurface}, 0.0);
    for (const StepImpact& impact : outcome.impacts) ASSERT_EQ(impact.impact.wall, 1) << i;
    expectSameMotion(outcome.after, expected, 1e-9, std::to_string(i));
  }
}

// The end of a thick wall inside the outline: a car that hits the face straight on meets the face,
// not the end cap behind it.
TEST(CollisionStep, TheEndCapBehindAFaceStaysHidden) {
  Random random(707);
  CollisionStep step;
  for (int i = 0; i < 5'000; ++i) {
    const PlanarMotion motion{.velocity = {random.uniform(5.0, 40.0), 0.0}};
    const double depth = random.uniform(0.05, 0.5), thickness = random.uniform(0.05, 0.5);
    const double end = random.uniform(-0.8, 0.8);  // of the wall, across the car
    const double side = random.sign();
    const double face = car.massCentreToFront - depth;
    const Segment front = wallBetween({face, end}, {face, end + 20.0 * side}, 1);
    const Segment back =
        wallBetween({face + thickness, end + 20.0 * side}, {face + thickness, end}, 2);
    const Segment cap = wallBetween({face + thickness, end}, {face, end}, 3);
    const Segment walls[] = {cap, back, front};
    const PlanarMotion expected = step.resolve(car, motion, {{&front, 1}, paperSurface}, 0.0).after;
    const StepOutcome outcome = step.resolve(car, motion, {walls, paperSurface}, 0.0);
    const std::string where = std::to_string(i) + ": speed " + std::to_string(motion.velocity.x()) +
                              " end " + std::to_string(end) + " side " + std::to_string(side) +
                              " depth " + std::to_string(depth) + " thickness " +
                              std::to_string(thickness);
    ASSERT_FALSE(outcome.impacts.empty()) << where;
    ASSERT_EQ(outcome.impacts[0].impact.wall, 1) << where;
    expectSameMotion(outcome.after, expected, 1e-9, where);
    if (HasFatalFailure()) return;
  }
}

// The same place, but the car comes from beside the wall: now the cap is what it meets.
TEST(CollisionStep, TheEndCapAnswersACarFromTheSide) {
  Random random(713);
  CollisionStep step;
  for (int i = 0; i < 5'000; ++i) {
    const double side = random.sign();
    const PlanarMotion motion{.velocity = {0.0, side * random.uniform(2.0, 20.0)}};
    const double overlap = random.uniform(0.01, 0.3);
    const double end = side * (0.5 * car.width - overlap);
    const double face = random.uniform(-1.0, 1.5), thickness = random.uniform(0.05, 0.5);
    const Segment front = wallBetween({face, end}, {face, end + 20.0 * side}, 1);
    const Segment back =
        wallBetween({face + thickness, end + 20.0 * side}, {face + thickness, end}, 2);
    const Segment cap = wallBetween({face + thickness, end}, {face, end}, 3);
    const Segment walls[] = {front, back, cap};
    const PlanarMotion expected = step.resolve(car, motion, {{&cap, 1}, paperSurface}, 0.0).after;
    const StepOutcome outcome = step.resolve(car, motion, {walls, paperSurface}, 0.0);
    ASSERT_FALSE(outcome.impacts.empty())
        << i << " overlap " << overlap << " thickness " << thickness << " face " << face;
    ASSERT_EQ(outcome.impacts[0].impact.wall, 3) << i;
    ASSERT_LE(expected.velocity.y() * side, motion.velocity.y() * side);
    ASSERT_LE(energyOf(outcome.after), energyOf(motion) * (1.0 + 1e-12)) << i;
  }
}

TEST(CollisionStep, TheWallTouchedFirstAnswersFirst) {
  Random random(714);
  CollisionStep step;
  int compared = 0;
  for (int i = 0; i < 10'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const std::array<Segment, 2> walls =
        insideCorner(random, motion, normal, random.uniform(60.0, 170.0) * degree);
    std::array<double, 2> ago{};  // since first touch, s
    bool both = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::optional<Overlap> overlap =
          findOverlap(Outline(car), motion.placement(), walls[k]);
      if (!overlap || approachSpeed(motion, walls[k], *overlap) < 1.0) {
        both = false;
        break;
      }
      ago[k] = overlap->depth / approachSpeed(motion, walls[k], *overlap);
    }
    // Far enough apart that the turning of the car meanwhile does not matter.
    if (!both || std::max(ago[0], ago[1]) < 1.3 * std::min(ago[0], ago[1])) continue;
    const StepOutcome outcome = step.resolve(car, motion, {walls, paperSurface}, 0.0);
    ASSERT_FALSE(outcome.impacts.empty()) << i;
    ASSERT_EQ(outcome.impacts[0].impact.wall, ago[0] > ago[1] ? 0 : 1) << i;
    ++compared;
  }
  EXPECT_GT(compared, 1'000);
}

TEST(CollisionStep, NeighboursInLineKeepTheirOwnSettings) {
  ResponseSettings soft = paperSettings, hard = paperSettings;
  soft.restitution = AngleCurve::constant(0.0);
  hard.restitution = AngleCurve::constant(0.25);
  const PlanarMotion motion{.velocity = {20.0, 0.0}};
  Segment left = wallBetween({2.05, 1.0}, {2.05, 30.0}, 1);
  Segment right = wallBetween({2.05, -30.0}, {2.05, 1.0}, 2);
  right.surface = 1;
  CollisionStep step;
  for (const bool softRight : {true, false}) {
    const std::array surfaces{Surface{.settings = softRight ? &hard : &soft},
                              Surface{.settings = softRight ? &soft : &hard}};
    const Segment walls[] = {left, right};
    const StepOutcome outcome = step.resolve(car, motion, {walls, surfaces}, 0.0);
    ASSERT_EQ(outcome.impacts.size(), 1U);
    EXPECT_EQ(outcome.impacts[0].impact.wall, 2);
    EXPECT_NEAR(outcome.after.velocity.x(), softRight ? 0.0 : -5.0, 1e-9);
  }
}

/// The wall cut into pieces of random length, in random order and direction.
std::vector<Segment> segmented(Random& random, const Segment& wall) {
  std::vector<Segment> pieces;
  const Vector2 along = (wall.end - wall.start).normalized();
  const double length = (wall.end - wall.start).norm();
  double from = 0.0;
  while (from < length) {
    const double to = std::min(length, from + random.uniform(0.2, 5.0));
    Segment piece = wall;
    piece.start = wall.start + from * along;
    piece.end = wall.start + to * along;
    if (random.chance(0.5)) std::swap(piece.start, piece.end);
    piece.normal = random.sign() * wall.normal;
    pieces.push_back(piece);
    if (random.chance(0.1)) pieces.push_back(piece);  // a doubled face
    from = to;
  }
  std::shuffle(pieces.begin(), pieces.end(), random.engine());
  return pieces;
}

TEST(CollisionStep, AWallInPiecesIsOneWall) {
  Random random(708);
  CollisionStep step;
  for (int i = 0; i < 10'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const Segment wall = wallAt(motion, normal, random.uniform(0.001, 0.3));
    const StepOutcome whole = step.resolve(car, motion, {{&wall, 1}, paperSurface}, 0.0);
    const PlanarMotion expected = whole.after;
    const std::size_t count = whole.impacts.size();
    const StepOutcome outcome =
        step.resolve(car, motion, {segmented(random, wall), paperSurface}, 0.0);
    ASSERT_EQ(outcome.impacts.size(), count) << i;
    expectSameMotion(outcome.after, expected, 1e-8, std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

TEST(CollisionStep, TheOrderOfTheWallsDoesNotMatter) {
  Random random(709);
  CollisionStep step;
  for (int i = 0; i < 10'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const Vector2 second = rotated(normal, random.sign() * random.uniform(20.0, 120.0) * degree);
    std::vector<Segment> walls =
        segmented(random, wallAt(motion, normal, random.uniform(0.01, 0.2), 0));
    const std::vector<Segment> more =
        segmented(random, wallAt(motion, second, random.uniform(0.01, 0.2), 1));
    walls.insert(walls.end(), more.begin(), more.end());
    const PlanarMotion expected = step.resolve(car, motion, {walls, paperSurface}, 0.0).after;
    for (int k = 0; k < 3; ++k) {
      std::shuffle(walls.begin(), walls.end(), random.engine());
      expectSameMotion(step.resolve(car, motion, {walls, paperSurface}, 0.0).after, expected, 1e-8,
                       std::to_string(i));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(CollisionStep, TurnsWithTheFrame) {
  Random random(710);
  CollisionStep step;
  for (int i = 0; i < 5'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const double angle = random.uniform(-3.0, 3.0);
    Segment walls[] = {
        wallAt(motion, normal, random.uniform(0.01, 0.2), 0),
        wallAt(motion, rotated(normal, random.uniform(-2.0, 2.0)), random.uniform(0.01, 0.2), 1)};
    const PlanarMotion expected = step.resolve(car, motion, {walls, paperSurface}, 0.0).after;
    PlanarMotion seen = motion;
    seen.position = rotated(motion.position, angle);
    seen.velocity = rotated(motion.velocity, angle);
    seen.yaw += angle;
    for (Segment& wall : walls) {
      wall.start = rotated(wall.start, angle);
      wall.end = rotated(wall.end, angle);
      wall.normal = rotated(wall.normal, angle);
    }
    const PlanarMotion after = step.resolve(car, seen, {walls, paperSurface}, 0.0).after;
    ASSERT_NEAR((rotated(expected.velocity, angle) - after.velocity).norm(), 0.0, 1e-6) << i;
    ASSERT_NEAR(expected.yawRate, after.yawRate, 1e-6) << i;
  }
}

TEST(CollisionStep, AFlushHitDoesNotSpinTheCar) {
  CollisionStep step;
  for (const double angle : {0.0, 0.7, -2.0}) {
    PlanarMotion motion{.yaw = angle, .velocity = rotated({20.0, 0.0}, angle)};
    const Vector2 normal = rotated({-1.0, 0.0}, angle);
    const Segment wall = wallAt(motion, normal, 0.05);
    const StepOutcome outcome = step.resolve(car, motion, {{&wall, 1}, paperSurface}, 0.0);
    EXPECT_NEAR(outcome.after.yawRate, 0.0, 1e-9) << angle;
    EXPECT_NEAR(outcome.after.velocity.dot(normal), 1.0, 1e-9) << angle;
  }
}

TEST(CollisionStep, WallsOfDifferentSettingsAnswerForThemselves) {
  ResponseSettings hard = paperSettings;
  hard.restitution = AngleCurve::constant(0.2);
  const PlanarMotion motion{.velocity = {20.0, 0.0}};
  Segment wall = wallAt(motion, {-1.0, 0.0}, 0.05);
  wall.surface = 1;
  const std::array surfaces{paperSurface.front(), Surface{.settings = &hard}};
  CollisionStep step;
  EXPECT_NEAR(step.resolve(car, motion, {{&wall, 1}, surfaces}, 0.0).after.velocity.x(), -4.0,
              1e-12);
}

TEST(CollisionStep, WallsMayBringTheirSettings) {
  Random random(211);
  ResponseSettings hard = paperSettings;
  hard.restitution = AngleCurve::constant(0.2);
  ResponseSettings breaking;
  breaking.law = Law::energy;
  breaking.energyRoot = EnergyRoot::break_through;
  const std::array surfaces{Surface{.settings = &paperSettings}, Surface{.settings = &hard},
                            Surface{.settings = &breaking}, Surface{.settings = &breaking}};
  CollisionStep step;
  int hit = 0;
  for (int i = 0; i < 2'000; ++i) {
    PlanarMotion motion;
    motion.yaw = random.uniform(-3.0, 3.0);
    motion.velocity = rotated({random.uniform(0.0, 40.0), 0.0}, random.uniform(-3.0, 3.0));
    motion.yawRate = random.uniform(-3.0, 3.0);
    std::vector<Segment> segments;
    std::vector<WallSegment> walls;
    for (int k = 0; k < 4; ++k) {
      const Vector2 normal = rotated({1.0, 0.0}, random.uniform(-3.0, 3.0));
      Segment segment = wallAt(motion, normal, random.uniform(-0.2, 0.1), k);
      segment.surface = random.below(4);
      segments.push_back(segment);
      WallSegment wall{segment};
      wall.surface = 99;
      wall.settings = surfaces[static_cast<std::size_t>(segment.surface)].settings;
      wall.group = segment.surface == 3 ? 1 : 0;
      walls.push_back(wall);
    }
    const StepOutcome expected = step.resolve(car, motion, {segments, surfaces}, 0.01);
    const PlanarMotion after = expected.after;
    const std::size_t impacts = expected.impacts.size();
    const StepOutcome outcome = step.resolve(car, motion, walls, 0.01);
    ASSERT_EQ(outcome.after.position, after.position) << i;
    ASSERT_EQ(outcome.after.velocity, after.velocity) << i;
    ASSERT_EQ(outcome.impacts.size(), impacts) << i;
    hit += impacts > 0 ? 1 : 0;
  }
  EXPECT_GT(hit, 500);
}

TEST(CollisionStep, TheSameObjectAnswersTheSame) {
  Random random(711);
  CollisionStep used;
  for (int i = 0; i < 2'000; ++i) {
    const auto [motion, normal] = randomApproach(random);
    const Segment walls[] = {wallAt(motion, normal, 0.1, 0),
                             wallAt(motion, rotated(normal, 1.0), 0.05, 1)};
    CollisionStep fresh;
    const PlanarMotion a = used.resolve(car, motion, {walls, paperSurface}, 0.0).after;
    const PlanarMotion b = fresh.resolve(car, motion, {walls, paperSurface}, 0.0).after;
    ASSERT_EQ(a.velocity, b.velocity) << i;
    ASSERT_EQ(a.yawRate, b.yawRate) << i;
  }
}

}  // namespace
}  // namespace bumper::tests
