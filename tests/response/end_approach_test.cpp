#include "encounter/end_approach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "random_impacts.h"

namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double mass = 1500.0;
constexpr double yawInertia = 2600.0;

struct Contacts {
  PlanarMotion motion;
  std::vector<TouchingPoint> points = {};
};

// Several points of each of a few walls, some of which face each other or nearly so.
Contacts randomContacts(Random& random) {
  const auto anywhere = [&] { return random.uniform(-pi, pi); };
  Contacts contacts;
  contacts.motion.velocity = rotated({random.uniform(0.0, 50.0), 0.0}, anywhere());
  contacts.motion.yawRate = random.chance(0.2) ? 0.0 : random.uniform(-8.0, 8.0);
  double direction = anywhere();
  for (int walls = 1 + random.below(5); walls > 0; --walls) {
    for (int points = 1 + random.below(7); points > 0; --points) {
      contacts.points.push_back({.normal = rotated({1.0, 0.0}, direction),
                                 .arm = {random.uniform(-2.5, 2.5), random.uniform(-1.0, 1.0)}});
    }
    direction = random.chance(0.3)
                    ? direction + pi + random.sign() * std::pow(10.0, random.uniform(-8.0, 0.0))
                    : anywhere();
  }
  return contacts;
}

SharedImpulse solved(const Contacts& contacts) {
  return endApproach({mass, yawInertia, contacts.motion}, contacts.points);
}

double difference(const PlanarImpulse& a, const PlanarImpulse& b) {
  return (a.linear - b.linear).norm() + std::abs(a.angular - b.angular);
}

// What pushes only, where nothing moves any more, and leaves no approach, leads to the nearest
// motion: these are the conditions of Karush, Kuhn and Tucker.
TEST(SimultaneousContacts, SharesPushAndLeaveNoApproach) {
  Random random(1401);
  int three = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Contacts contacts = randomContacts(random);
    SharedImpulse impulse = solved(contacts);
    const double energy = yawPlaneEnergy(contacts.motion, mass, yawInertia);
    const double fastest = 4.0 * std::sqrt(2.0 * energy / mass);
    PlanarImpulse sum;
    double strength = mass * fastest;
    for (const CarryingPoint& share : impulse.all()) {
      const TouchingPoint& point = contacts.points[share.point];
      ASSERT_GT(share.impulse, 0.0) << i;
      sum += onVehicle({.normal = share.impulse}, point.normal, point.arm);
      strength += share.impulse;
    }
    ASSERT_LE(difference(sum, impulse.sum), 1e-13 * strength) << i;
    const PlanarMotion after = afterImpulse(contacts.motion, impulse.sum, mass, yawInertia);
    for (const TouchingPoint& point : contacts.points) {
      ASSERT_GE(velocityAt(after, point.arm).dot(point.normal), -1e-11 * fastest) << i;
    }
    for (const CarryingPoint& share : impulse.all()) {
      const TouchingPoint& point = contacts.points[share.point];
      ASSERT_NEAR(velocityAt(after, point.arm).dot(point.normal), 0.0, 1e-11 * fastest) << i;
    }
    ASSERT_LE(yawPlaneEnergy(after, mass, yawInertia), energy * (1.0 + 1e-14)) << i;
    three += impulse.count == mostCarryingPoints ? 1 : 0;
  }
  EXPECT_GT(three, 1'000);
}

TEST(SimultaneousContacts, OrderDoesNotMatterToTheSum) {
  Random random(1402);
  for (int i = 0; i < 5'000; ++i) {
    Contacts contacts = randomContacts(random);
    const PlanarImpulse sum = solved(contacts).sum;
    std::shuffle(contacts.points.begin(), contacts.points.end(), random.engine());
    const double strength = mass * (1.0 + contacts.motion.velocity.norm());
    ASSERT_LE(difference(solved(contacts).sum, sum), 1e-7 * strength) << i;
  }
}

// Nose first into the middle of a corner: each wall takes the same.
TEST(SimultaneousContacts, SymmetricPointsShareAlike) {
  for (const double half : {0.01, 0.3, 0.7, 1.4}) {
    Contacts contacts{.motion = {.velocity = {20.0, 0.0}}};
    for (const double side : {1.0, -1.0}) {
      contacts.points.push_back(
          {.normal = {-std::sin(half), -side * std::cos(half)}, .arm = {2.0, side * 0.9}});
    }
    SharedImpulse impulse = solved(contacts);
    ASSERT_EQ(impulse.count, 2U);
    EXPECT_NEAR(impulse.sum.linear.x(), -mass * 20.0, 1e-9);
    for (const CarryingPoint& share : impulse.all()) {
      EXPECT_NEAR(share.impulse * 2.0 * std::sin(half), mass * 20.0, 1e-8);
    }
  }
}

TEST(SimultaneousContacts, NothingThatApproachesTakesNothing) {
  const std::vector<TouchingPoint> points{{.normal = {1.0, 0.0}, .arm = {-2.0, 0.5}},
                                          {.normal = {0.0, 1.0}, .arm = {1.0, -0.9}}};
  const SharedImpulse impulse = endApproach({mass, yawInertia, {.velocity = {3.0, 4.0}}}, points);
  EXPECT_EQ(impulse.count, 0U);
  EXPECT_EQ(impulse.sum.linear, Vector2::Zero());
  EXPECT_EQ(impulse.sum.angular, 0.0);
}

}  // namespace
}  // namespace bumper::tests
