#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bumper/response/collision_step.h"
#include "random_impacts.h"

/// Every impact that a step tells is one of a rigid body at one point: arm, impulse, moment and the
/// motions before and after fit each other, and all of them together are the step.
namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;

Vector2 heading(double angle) { return {std::cos(angle), std::sin(angle)}; }

ResponseSettings randomSettings(Random& random) {
  ResponseSettings settings;
  if (random.chance(0.2)) return settings;
  settings.law = random.chance(0.3) ? Law::energy : Law::restitution;
  settings.restitution = AngleCurve::constant(randomRestitution(random));
  settings.friction = AngleCurve::constant(random.chance(0.4) ? 0.0 : randomFriction(random));
  settings.penetrationTime = random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.01);
  settings.method = random.chance(0.05) ? Method::paper : Method::bumper;
  return settings;
}

/// A vehicle that moves, and the walls around it.
class Surroundings {
 public:
  explicit Surroundings(Random& random) : random_(random), settings_(randomSettings(random)) {
    vehicle = randomVehicle(random);
    h = random.uniform(0.001, 0.02);
    motion.position = {random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0)};
    motion.yaw = random.chance(0.2) ? 0.0 : random.uniform(-pi, pi);
    motion.velocity = random.uniform(0.0, 60.0) * heading(random.uniform(-pi, pi));
    motion.yawRate = random.chance(0.2) ? 0.0 : random.uniform(-8.0, 8.0);
    const double ahead = std::atan2(motion.velocity.y(), motion.velocity.x());
    switch (random.below(6)) {
      case 0:
        addWall(ahead);
        break;
      case 1: {  // into a wedge, which may be narrow
        const double half = std::pow(10.0, random.uniform(-6.0, 0.0)) * 0.5 * pi;
        addWall(ahead + 0.5 * pi - half);
        addWall(ahead - 0.5 * pi + half);
        break;
      }
      case 2:  // into a corner
        addWall(ahead + random.uniform(0.0, 1.0));
        addWall(ahead - random.uniform(0.0, 1.0));
        break;
      case 3:  // between two walls along the vehicle, or nearly so
        addWall(motion.yaw + 0.5 * pi + random.sign() * std::pow(10.0, random.uniform(-9.0, -1.0)));
        addWall(motion.yaw - 0.5 * pi);
        if (random.chance(0.5)) addWall(motion.yaw);
        break;
      case 4:  // many, all around
        for (int k = 3 + random.below(8); k > 0; --k) addWall(random.uniform(-pi, pi));
        break;
      default:  // posts and ends of walls
        for (int k = 1 + random.below(5); k > 0; --k) {
          addWall(random.uniform(-pi, pi));
          shorten(walls.back());
        }
    }
  }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
  ~Surroundings() = default;

  VehicleParameters vehicle;
  PlanarMotion motion;
  std::vector<Segment> walls;
  Surface surface{.settings = &settings_};
  double h = 0.0;
  /// Eq. 17 as printed can.
  [[nodiscard]] bool mayGainEnergy() const { return settings_.method == Method::paper; }

 private:
  // A long wall to which `direction` points: the outline may touch it, be a little in it, or reach
  // it within the step.
  void addWall(double direction) {
    const Vector2 normal = -heading(direction);
    double lowest = 0.0;
    for (const Vector2& corner : Outline(vehicle).corners()) {
      lowest = std::min(lowest, normal.dot(rotated(corner, motion.yaw)));
    }
    const double depth = random_.chance(0.3)   ? random_.uniform(0.0, 0.3)
                         : random_.chance(0.5) ? 0.0
                                               : -random_.uniform(0.0, 0.2);
    const Vector2 foot = motion.position + (lowest + depth) * normal;
    walls.push_back({.start = foot - 20.0 * turnedLeft(normal),
                     .end = foot + 20.0 * turnedLeft(normal),
                     .normal = normal,
                     .id = static_cast<int>(walls.size())});
  }

  // To a post, or to a wall that has an end nearby.
  void shorten(Segment& wall) {
    const Vector2 middle = 0.5 * (wall.start + wall.end);
    if (random_.chance(0.4)) {
      wall.radius = random_.uniform(0.05, 0.5);
      wall.start = wall.end = middle - wall.radius * wall.normal;
    } else {
      const Vector2 tangent = turnedLeft(wall.normal);
      const double from = random_.uniform(-1.0, 1.0);
      wall.start = middle + from * tangent;
      wall.end = middle + (from + random_.uniform(0.05, 2.0)) * tangent;
    }
  }

  Random& random_;
  ResponseSettings settings_;
};

/// The measure of what rounds: all impulses that are told, N s, each with its arm.
struct Strength {
  double linear = 0.0;
  double angular = 0.0;
};

void expectFits(const StepImpact& each, const VehicleParameters& vehicle, const Strength& strength,
                const std::string& where) {
  constexpr double rounding = 1e-11;
  const Impact& impact = each.impact;
  const ImpactResponse& response = each.response;
  const PlanarImpulse& impulse = response.impulse;
  ASSERT_NEAR(impact.normal.norm(), 1.0, 1e-12) << where;
  ASSERT_NEAR(impulse.angular, cross(impact.arm, impulse.linear), rounding * strength.angular)
      << where;
  const ContactImpulse& told = response.contact.impulse;
  const Vector2 linear = told.normal * impact.normal + told.tangent * turnedLeft(impact.normal);
  ASSERT_NEAR((impulse.linear - linear).norm(), 0.0, rounding * strength.linear) << where;
  ASSERT_GE(told.normal, -rounding * strength.linear) << where;

  const Vector2 change = response.after.velocity - response.before.velocity;
  const double turn = response.after.yawRate - response.before.yawRate;
  // A velocity rounds by its own size.
  const double momentum = strength.linear + vehicle.mass * response.before.velocity.norm();
  ASSERT_NEAR((vehicle.mass * change - impulse.linear).norm(), 0.0, rounding * momentum) << where;
  ASSERT_NEAR(
      vehicle.yawInertia * turn, cross(impact.arm, impulse.linear),
      rounding * (strength.angular + vehicle.yawInertia * std::abs(response.before.yawRate)))
      << where;
}

void expectFits(const Surroundings& s, const StepOutcome& outcome, const std::string& where) {
  ASSERT_LE(outcome.impacts.size(), static_cast<std::size_t>(CollisionStep::maxImpacts)) << where;
  constexpr double rounding = 1e-12;
  const double energy = yawPlaneEnergy(s.motion, s.vehicle.mass, s.vehicle.yawInertia);
  const double radius = Outline(s.vehicle).radius();
  Strength strength{.linear = std::sqrt(2.0 * energy * s.vehicle.mass)};
  for (const StepImpact& each : outcome.impacts) {
    strength.linear += each.response.impulse.linear.norm();
  }
  strength.angular = radius * strength.linear;

  PlanarMotion now = s.motion;
  PlanarImpulse sum;
  double change = 0.0;
  for (std::size_t i = 0; i < outcome.impacts.size(); ++i) {
    const StepImpact& each = outcome.impacts[i];
    const std::string which = where + ", impact " + std::to_string(i);
    expectFits(each, s.vehicle, strength, which);
    if (::testing::Test::HasFatalFailure()) return;
    ASSERT_EQ(each.response.before.velocity, now.velocity) << which;
    ASSERT_EQ(each.response.before.yawRate, now.yawRate) << which;
    now = each.response.after;
    sum += each.response.impulse;
    if (!s.mayGainEnergy()) {
      ASSERT_LE(each.response.contact.energyChange, rounding * energy) << which;
      ASSERT_LE(each.response.energyRatio, 1.0 + rounding) << which;
    }
    change += each.response.contact.energyChange;
  }
  ASSERT_NEAR((sum.linear - outcome.impulse.linear).norm(), 0.0, rounding * strength.linear)
      << where;
  ASSERT_NEAR(sum.angular, outcome.impulse.angular, rounding * strength.angular) << where;
  ASSERT_EQ(outcome.after.velocity, now.velocity) << where;
  ASSERT_EQ(outcome.after.yawRate, now.yawRate) << where;
  const double left = yawPlaneEnergy(now, s.vehicle.mass, s.vehicle.yawInertia);
  ASSERT_NEAR(change, left - energy, 1e-9 * std::max(energy, left)) << where;
  if (s.mayGainEnergy()) return;
  ASSERT_LE(left, energy * (1.0 + rounding)) << where;
}

/// The most impacts at one instant.
int mostAtOnce(const StepOutcome& outcome) {
  int most = 0;
  for (const StepImpact& each : outcome.impacts) {
    most = std::max(
        most, static_cast<int>(std::ranges::count(outcome.impacts, each.time, &StepImpact::time)));
  }
  return most;
}

TEST(ReportedImpacts, FitTheirArmsAndTheStep) {
  constexpr int enoughToBeSolvedTogether = 17;
  Random random(1301);
  CollisionStep step;
  int hit = 0, together = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Surroundings s(random);
    const StepOutcome outcome = step.resolve(s.vehicle, s.motion, {s.walls, {&s.surface, 1}}, s.h);
    expectFits(s, outcome, "case " + std::to_string(i));
    if (HasFatalFailure()) return;
    hit += outcome.impacts.empty() ? 0 : 1;
    together += mostAtOnce(outcome) >= enoughToBeSolvedTogether ? 1 : 0;
  }
  RecordProperty("together", together);
  EXPECT_GT(hit, 10'000);
  EXPECT_GT(together, 300);
}

}  // namespace
}  // namespace bumper::tests
