// What an engine's solver is told of the walls nearby: it must not disturb a vehicle that nothing
// pushes, and must hold one that something does. Seen by the outline's corners and the walls alone.

#include "bumper/response/speculative_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bumper/response/collision_step.h"
#include "car.h"
#include "random_impacts.h"

namespace bumper::tests {
namespace {

const ResponseSettings usual;
const std::array usualSurface{Surface{.settings = &usual}};

struct Case {
  VehicleParameters vehicle;
  PlanarMotion motion;
  std::vector<Segment> walls;
  double step = 0.0;
};

Segment wallFrom(const Vector2& start, const Vector2& end, int id) {
  return {.start = start, .end = end, .normal = turnedLeft((end - start).normalized()), .id = id};
}

// A vehicle at rest or fast, with walls around it, and none in it.
Case randomCase(Random& random) {
  Case result;
  result.vehicle = randomVehicle(random);
  result.step = std::pow(10.0, random.uniform(-3.3, -1.5));
  result.motion.velocity = rotated({random.uniform(0.0, 40.0), 0.0}, random.uniform(-3.2, 3.2));
  result.motion.yawRate = random.chance(0.3) ? 0.0 : random.uniform(-12.0, 12.0);
  const Outline outline(result.vehicle);
  const int count = 1 + random.below(3);
  for (int i = 0; static_cast<int>(result.walls.size()) < count && i < 40; ++i) {
    const Vector2 middle = rotated({random.uniform(0.5, 4.0), 0.0}, random.uniform(-3.2, 3.2));
    const Vector2 half = rotated({random.uniform(0.05, 6.0), 0.0}, random.uniform(-1.6, 1.6));
    const Segment wall = wallFrom(middle - half, middle + half, i);
    if (findTouch(outline, {}, wall)) continue;
    result.walls.push_back(wall);
  }
  return result;
}

double speedAt(const PlanarMotion& motion, const SpeculativeContact& contact) {
  return contact.normal.dot(velocityAt(motion, contact.arm));
}

// The velocity with which an engine carries the vehicle from one pose to the other.
PlanarMotion carrying(const PlanarMotion& from, const PlanarMotion& to, double step) {
  PlanarMotion motion = from;
  motion.velocity = (to.position - from.position) / step;
  motion.yawRate = (to.yaw - from.yaw) / step;
  return motion;
}

TEST(SpeculativeContact, IsWithoutEffectWhereNothingPushes) {
  Random random(11);
  CollisionStep collision;
  int contacts = 0;
  int impacts = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Case each = randomCase(random);
    const StepOutcome outcome =
        collision.resolve(each.vehicle, each.motion, {each.walls, usualSurface}, each.step);
    impacts += outcome.impacts.empty() ? 0 : 1;
    const PlanarMotion after = outcome.after;
    const PlanarMotion motion = carrying(each.motion, after, each.step);
    for (const SpeculativeContact& contact :
         collision.speculativeContacts(each.motion, after, 2.0, each.step)) {
      ASSERT_GT(speedAt(motion, contact), contact.leastSpeed(each.step)) << i;
      ++contacts;
    }
  }
  EXPECT_GE(contacts, 20'000);
  EXPECT_GE(impacts, 1'000);
}

// A random push, made weaker until it meets all demands: no corner is behind a wall that it was in
// front of.
TEST(SpeculativeContact, HoldsWhateverPushes) {
  Random random(12);
  CollisionStep collision;
  int held = 0;
  for (int i = 0; i < 20'000; ++i) {
    Case each = randomCase(random);
    each.walls.resize(std::min<std::size_t>(each.walls.size(), 1));
    if (each.walls.empty()) continue;
    Segment& wall = each.walls.front();
    const Vector2 along = (wall.end - wall.start).normalized();
    wall.start -= 100.0 * along;  // nothing comes round an end
    wall.end += 100.0 * along;
    const Outline outline(each.vehicle);
    if (findTouch(outline, {}, wall)) continue;
    const StepOutcome outcome =
        collision.resolve(each.vehicle, each.motion, {each.walls, usualSurface}, each.step);
    const PlanarMotion after = outcome.after;
    const auto contacts = collision.speculativeContacts(each.motion, after, 5.0, each.step);
    PlanarMotion motion = carrying(each.motion, after, each.step);
    const Vector2 normal = normalTowards(wall, Vector2::Zero());
    // Into the wall, and turning.
    const double push = random.uniform(0.0, 0.3) / each.step;
    const double turn = random.uniform(-0.1, 0.1) / each.step;
    motion.velocity -= push * normal;
    motion.yawRate += turn;
    // What a solver does at the least: out along the normal until all demands are met.
    double lift = 0.0;
    for (const SpeculativeContact& contact : contacts) {
      lift = std::max(lift, contact.leastSpeed(each.step) - speedAt(motion, contact));
    }
    motion.velocity += lift * normal;
    held += lift > 0.0 ? 1 : 0;
    const PlanarMotion pose = advanced(motion, each.step);
    for (const Vector2& corner : outline.corners()) {
      const Vector2 place = pose.position + pose.placement().turned(corner);
      // Turning by a tenth lifts by its square; the other way round it costs nothing.
      ASSERT_GE(normal.dot(place - wall.start), -2.1e-6) << i;
    }
  }
  EXPECT_GE(held, 2'000);
}

// However finely a bent wall is meshed, the whole side that faces it is held.
TEST(SpeculativeContact, LeavesNoPartOfASideOpen) {
  for (const double length : {0.02, 0.05, 0.1, 0.3, 1.0}) {
    for (const double radius : {25.0, 60.0}) {
      // A convex wall to the left of the vehicle, 5 cm off it.
      const Vector2 centre(0.0, 0.95 + radius);
      std::vector<Segment> walls;
      const double angle = length / radius;
      const int half = static_cast<int>(4.0 / length);
      const auto at = [&](int k) -> Vector2 {
        return centre + radius * Vector2(std::sin(k * angle), -std::cos(k * angle));
      };
      for (int k = -half; k < half; ++k) walls.push_back(wallFrom(at(k), at(k + 1), k + half));
      CollisionStep collision;
      const PlanarMotion motion;
      const PlanarMotion after = collision.resolve(car, motion, {walls, usualSurface}, 0.01).after;
      double front = -10.0;
      double rear = 10.0;
      for (const SpeculativeContact& contact :
           collision.speculativeContacts(motion, after, 1.0, 0.01)) {
        EXPECT_GT(-contact.normal.y(), 0.9);
        front = std::max(front, contact.arm.x());
        rear = std::min(rear, contact.arm.x());
      }
      EXPECT_GT(front, 0.5) << length << ' ' << radius;
      EXPECT_LT(rear, -0.9) << length << ' ' << radius;
    }
  }
}

// Walls that a vehicle goes through have none, and those of the paper's method, which wants an
// overlap. One with a contact time has them: deeper in.
TEST(SpeculativeContact, NotWhereAVehicleMayGoThrough) {
  ResponseSettings breaking;
  breaking.law = Law::energy;
  breaking.energyRoot = EnergyRoot::break_through;
  ResponseSettings slow;
  slow.contactTime = 0.05;
  ResponseSettings paper;
  paper.method = Method::paper;
  CollisionStep collision;
  for (const ResponseSettings* settings :
       std::vector<const ResponseSettings*>{&usual, &slow, &breaking, &paper}) {
    const Segment wall = wallFrom({2.3, 5.0}, {2.3, -5.0}, 0);
    const Surface surface{.settings = settings};
    const PlanarMotion motion;
    const StepOutcome outcome = collision.resolve(car, motion, {{&wall, 1}, {&surface, 1}}, 0.01);
    const PlanarMotion after = outcome.after;
    const std::size_t count = collision.speculativeContacts(motion, after, 0.5, 0.01).size();
    EXPECT_EQ(count, settings == &usual || settings == &slow ? 2U : 0U);
  }
}

}  // namespace
}  // namespace bumper::tests
