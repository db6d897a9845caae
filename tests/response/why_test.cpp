#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bumper/response/collision_step.h"
#include "bumper/response/restitution_law.h"

/// First that the plain way fails, then that this one does not.
namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double sixtyMilesPerHour = 26.8224;  // m/s

// A front-right corner that meets a wall at 80° and 60 mph with e = 0.05 and μ = 0.3: full friction
// turns the slip round and goes on pulling.
TEST(Why, UncappedFrictionDragsTheContactBackwards) {
  ContactBody car{.inverseMass = 1.0 / 1500.0, .inverseYawInertia = 1.0 / 2600.0};
  car.arm = {2.1, -0.9};
  car.velocity = {sixtyMilesPerHour, 0.0};
  // The wall stands to the right, so that the heading makes 80° with it.
  const Vector2 normal(-std::sin(80.0 * degree), std::cos(80.0 * degree));
  const ContactMobility mobility = contactMobility(car, ContactBody{}, normal);
  const ContactVelocity before = contactVelocity(car, ContactBody{}, normal);
  const auto yawRate = [&](const ContactSolution& solution) {
    return onVehicle(solution.impulse, normal, car.arm).angular * car.inverseYawInertia / degree;
  };

  const ContactSolution printed = solveRestitutionAsPrinted(mobility, before, 0.05, 0.3);
  EXPECT_NEAR(yawRate(printed), -803.0, 0.5);
  EXPECT_LT(printed.velocityAfter.tangent * before.tangent, 0.0);           // turned round …
  EXPECT_GT(printed.velocityAfter.tangent * printed.impulse.tangent, 0.0);  // … by friction

  const ContactSolution capped = solveRestitution(mobility, before, 0.05, {.value = 0.3});
  EXPECT_NEAR(yawRate(capped), -205.0, 0.5);
  EXPECT_EQ(capped.regime, Regime::sticking);
  EXPECT_NEAR(capped.velocityAfter.tangent, 0.0, 1e-12);
  EXPECT_NEAR(capped.velocityAfter.normal, printed.velocityAfter.normal, 1e-12);
}

// A car in an inside corner, both walls at once. Answering each wall from the motion before, and
// adding both impulses, creates energy; one after the other loses it.
TEST(Why, IndependentImpulsesInACornerCreateEnergy) {
  const VehicleParameters car{.mass = 1500.0,
                              .yawInertia = 2600.0,
                              .massCentreToFront = 2.1,
                              .massCentreToRear = 2.5,
                              .width = 1.8,
                              .massCentreHeight = 0.55};
  ResponseSettings settings;
  settings.restitution = AngleCurve::constant(0.3);
  // Two walls that the nose meets symmetrically, so steep that each stops it nearly alone.
  const double slope = 75.0 * degree;
  Segment walls[2];
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const Vector2 normal(-std::sin(slope), -sign * std::cos(slope));
    const Vector2 touched(2.1 - 0.05, sign * 0.9);
    walls[side] = {.start = touched - 5.0 * turnedLeft(normal),
                   .end = touched + 5.0 * turnedLeft(normal),
                   .normal = normal,
                   .id = side};
  }
  const PlanarMotion motion{.velocity = {5.0, 0.0}};
  const Outline outline(car);

  PlanarMotion independent = motion;
  for (const Segment& wall : walls) {
    const std::optional<Overlap> overlap = findOverlap(outline, motion.placement(), wall);
    ASSERT_TRUE(overlap.has_value());
    const ContactPoint contact =
        contactPoint(outline, motion.placement(), wall, *overlap, overlap->depth);
    const Impact impact{
        .wall = wall.id, .point = contact.point, .normal = overlap->normal, .arm = contact.arm};
    const ImpactResponse response = respond(impact, freeBody(car, motion), settings);
    independent = afterImpulse(independent, response.impulse, car.mass, car.yawInertia);
  }
  const double before = yawPlaneEnergy(motion, car.mass, car.yawInertia);
  EXPECT_GT(yawPlaneEnergy(independent, car.mass, car.yawInertia), before);

  CollisionStep step;
  const Surface surface{.settings = &settings};
  const StepOutcome outcome = step.resolve(car, motion, {walls, {&surface, 1}}, 0.0);
  EXPECT_TRUE(outcome.settled);
  EXPECT_LT(yawPlaneEnergy(outcome.after, car.mass, car.yawInertia), 0.5 * before);
}

}  // namespace
}  // namespace bumper::tests
