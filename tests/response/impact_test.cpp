#include "bumper/response/impact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "bumper/response/outline.h"
#include "oracle.h"

namespace bumper::tests {
namespace {

struct Hit {
  VehicleParameters vehicle;
  Impact impact;
  PlanarMotion motion;
  ResponseSettings settings;
};

Hit randomHit(Random& random) {
  Hit hit;
  hit.vehicle = randomVehicle(random);
  const std::array<Vector2, 4> corners = Outline(hit.vehicle).corners();
  hit.motion.position = {random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0)};
  hit.motion.yaw = random.uniform(-3.0, 3.0);
  hit.impact.arm = rotated(corners[static_cast<std::size_t>(random.below(4))], hit.motion.yaw);
  hit.impact.normal = rotated({1.0, 0.0}, random.uniform(-3.0, 3.0));
  hit.impact.point = hit.motion.position + hit.impact.arm;
  hit.motion.velocity = random.uniform(1.0, 40.0) * rotated({1.0, 0.0}, random.uniform(-3.0, 3.0));
  hit.motion.yawRate = random.uniform(-2.0, 2.0);
  if (velocityAt(hit.motion, hit.impact.arm).dot(hit.impact.normal) > 0.0) {
    hit.motion.velocity = -hit.motion.velocity;
    hit.motion.yawRate = -hit.motion.yawRate;
  }
  return hit;
}

ImpactResponse answer(const Hit& hit) {
  return respond(hit.impact, freeBody(hit.vehicle, hit.motion), hit.settings);
}

Situation situationOf(const Hit& hit) {
  Situation s;
  s.vehicle.inverseMass = 1.0 / hit.vehicle.mass;
  s.vehicle.inverseYawInertia = 1.0 / hit.vehicle.yawInertia;
  s.vehicle.arm = hit.impact.arm;
  s.vehicle.velocity = hit.motion.velocity;
  s.vehicle.yawRate = hit.motion.yawRate;
  s.normal = hit.impact.normal;
  return s;
}

TEST(Respond, ReadsTheCurvesAndAsksTheLaw) {
  Random random(601);
  for (int i = 0; i < 20'000; ++i) {
    Hit hit = randomHit(random);
    hit.settings.angle = static_cast<AngleDefinition>(random.below(3));
    const Situation s = situationOf(hit);
    const auto normal = static_cast<double>(normalBefore(s));
    if (-normal < 2.0 * hit.settings.restSpeed) continue;  // there restitution fades
    const ImpactResponse response = answer(hit);
    EXPECT_EQ(response.law, Law::restitution);
    EXPECT_EQ(response.outcome, EnergyOutcome::not_asked);
    EXPECT_TRUE(std::isnan(response.energyAsked));
    ASSERT_NEAR(response.approachSpeed, -normal, 1e-12);

    const Vector2 wall = turnedLeft(hit.impact.normal);
    const auto toWall = [&](const Vector2& direction) {
      return std::atan2(std::abs(cross(wall, direction)), std::abs(wall.dot(direction)));
    };
    const AnglesOfAttack angles = anglesOfAttack(hit.impact, hit.motion);
    ASSERT_NEAR(angles.contactVelocity, toWall(velocityAt(hit.motion, hit.impact.arm)), 1e-12);
    ASSERT_NEAR(angles.centreVelocity, toWall(hit.motion.velocity), 1e-12);
    ASSERT_NEAR(angles.heading, toWall(rotated({1.0, 0.0}, hit.motion.yaw)), 1e-12);
    const std::array byDefinition{angles.contactVelocity, angles.centreVelocity, angles.heading};
    const double angle = byDefinition.at(static_cast<std::size_t>(hit.settings.angle));
    ASSERT_NEAR(response.restitution, 0.05 + 0.25 * std::cos(angle), 1e-12);
    ASSERT_NEAR(response.friction, 0.3 * std::cos(angle), 1e-12);

    const std::optional<Exact> exact = coulomb(s, response.restitution, response.friction);
    ASSERT_TRUE(exact.has_value());
    const auto size = static_cast<double>(exact->impulseNormal);
    ASSERT_NEAR(response.contact.impulse.normal, size, 1e-11 * size) << i << s;
    ASSERT_NEAR(apart(response.impulse.linear, exact->impulse), 0.0, 1e-11 * size);
    ASSERT_NEAR(apart(response.after.velocity, exact->vehicle.velocity), 0.0, 1e-10);
    ASSERT_NEAR(response.after.yawRate, static_cast<double>(exact->vehicle.yawRate), 1e-10);
    ASSERT_NEAR(response.energyRatio, static_cast<double>(exact->energyAfter / exact->energyBefore),
                1e-11);
    ASSERT_EQ(response.before.velocity, hit.motion.velocity);
    ASSERT_EQ(response.before.yawRate, hit.motion.yawRate);
    ASSERT_EQ(response.after.position, hit.motion.position);
    ASSERT_EQ(response.after.yaw, hit.motion.yaw);
  }
}

TEST(Respond, EnergyLawKeepsItsCurve) {
  Random random(602);
  int met = 0;
  for (int i = 0; i < 20'000; ++i) {
    Hit hit = randomHit(random);
    hit.settings.law = Law::energy;
    const ImpactResponse response = answer(hit);
    ASSERT_EQ(response.law, Law::energy);
    ASSERT_NE(response.outcome, EnergyOutcome::not_asked);
    ASSERT_NEAR(response.energyAsked,
                0.04 + 0.88 * std::cos(anglesOfAttack(hit.impact, hit.motion).contactVelocity),
                1e-12);
    const Exact exact = applied(situationOf(hit), response.contact.impulse.normal,
                                response.contact.impulse.tangent);
    ASSERT_NEAR(response.energyRatio, static_cast<double>(exact.energyAfter / exact.energyBefore),
                1e-11);
    ASSERT_LE(response.energyRatio, 1.0 + 1e-12);
    ASSERT_NEAR(response.restitution,
                static_cast<double>(-exact.normalAfter / normalBefore(situationOf(hit))), 1e-9);
    if (response.outcome == EnergyOutcome::met) {
      ++met;
      ASSERT_NEAR(response.energyRatio, response.energyAsked, 1e-11);
    }
  }
  EXPECT_GT(met, 50);
}

TEST(Respond, TurnsWithTheFrame) {
  Random random(603);
  for (int i = 0; i < 20'000; ++i) {
    Hit hit = randomHit(random);
    hit.settings.law = i % 2 == 0 ? Law::restitution : Law::energy;
    Hit seen = hit;
    const double angle = random.uniform(-4.0, 4.0);
    seen.motion.position = rotated(hit.motion.position, angle);
    seen.motion.velocity = rotated(hit.motion.velocity, angle);
    seen.motion.yaw += angle;
    seen.impact.point = rotated(hit.impact.point, angle);
    seen.impact.normal = rotated(hit.impact.normal, angle);
    seen.impact.arm = rotated(hit.impact.arm, angle);
    const ImpactResponse a = answer(hit), b = answer(seen);
    // The energy law's root has a vertical tangent where it vanishes: half the digits.
    const double tolerance = hit.settings.law == Law::restitution ? 1e-10 : 1e-5;
    ASSERT_NEAR((rotated(a.after.velocity, angle) - b.after.velocity).norm(), 0.0, tolerance) << i;
    ASSERT_NEAR(a.after.yawRate, b.after.yawRate, tolerance) << i;
    ASSERT_NEAR(a.restitution, b.restitution, tolerance) << i;
  }
}

TEST(Respond, LeftAndRightAreAlike) {
  Random random(604);
  for (int i = 0; i < 20'000; ++i) {
    Hit hit = randomHit(random);
    hit.settings.law = i % 2 == 0 ? Law::restitution : Law::energy;
    Hit mirror = hit;
    for (Vector2* v : {&mirror.motion.position, &mirror.motion.velocity, &mirror.impact.point,
                       &mirror.impact.normal, &mirror.impact.arm}) {
      v->y() = -v->y();
    }
    mirror.motion.yaw = -hit.motion.yaw;
    mirror.motion.yawRate = -hit.motion.yawRate;
    const ImpactResponse a = answer(hit), b = answer(mirror);
    ASSERT_EQ(a.after.velocity.x(), b.after.velocity.x()) << i;
    ASSERT_EQ(a.after.velocity.y(), -b.after.velocity.y()) << i;
    ASSERT_EQ(a.after.yawRate, -b.after.yawRate) << i;
    ASSERT_EQ(a.outcome, b.outcome) << i;
    ASSERT_EQ(a.contact.regime, b.contact.regime) << i;
  }
}

TEST(Respond, RestitutionFadesBelowTheRestSpeed) {
  Hit hit;
  hit.vehicle = {.mass = 1500.0, .yawInertia = 2600.0};
  hit.impact.normal = {-1.0, 0.0};
  hit.impact.arm = {2.1, 0.0};
  hit.settings.restitution = AngleCurve::constant(0.3);
  hit.settings.restSpeed = 0.1;
  double last = 0.0;
  for (int i = 1; i <= 200; ++i) {
    const double speed = 0.001 * i;
    hit.motion.velocity = {speed, 0.0};
    const double restitution = answer(hit).contact.restitution;
    ASSERT_GE(restitution, last - 1e-12) << speed;
    ASSERT_LE(restitution, 0.3 + 1e-12) << speed;
    ASSERT_LE(restitution - last, 0.01) << speed;  // no jump
    if (speed > 0.1) {
      ASSERT_NEAR(restitution, 0.3, 1e-12) << speed;
    }
    last = restitution;
  }
  hit.motion.velocity = {1e-6, 0.0};
  EXPECT_LT(answer(hit).contact.restitution, 1e-4);
  EXPECT_LE(answer(hit).after.velocity.x(), 1e-20);  // stopped all the same
  hit.settings.restSpeed = 0.0;
  EXPECT_NEAR(answer(hit).contact.restitution, 0.3, 1e-12);
}

TEST(Respond, PaperMethodIsThePaper) {
  Random random(605);
  for (int i = 0; i < 10'000; ++i) {
    Hit hit = randomHit(random);
    hit.settings.method = Method::paper;
    const Situation s = situationOf(hit);
    if (normalBefore(s) > -0.5L) continue;  // there restitution may fade
    const ImpactResponse response = answer(hit);
    // Friction as Eq. 5 has it, against the initial slip, uncapped.
    const Real ratio = tangentBefore(s) > 0.0L ? -Real{response.friction} : Real{response.friction};
    const std::optional<Exact> exact = atRatio(s, response.restitution, ratio);
    ASSERT_TRUE(exact.has_value());
    const auto size = static_cast<double>(exact->impulseNormal);
    ASSERT_NEAR(apart(response.impulse.linear, exact->impulse), 0.0, 1e-10 * size) << i << s;

    hit.settings.law = Law::energy;
    const ImpactResponse energy = answer(hit);
    const Real slope = tangentBefore(s) > 0.0L ? -Real{energy.friction} : Real{energy.friction};
    const EnergyLine line(s, slope);
    const std::optional<Real> root = line.larger(Real{energy.energyAsked} * exact->energyBefore);
    const auto expected = static_cast<double>(root ? *root : line.deepest());
    ASSERT_NEAR(energy.contact.impulse.normal, expected, 1e-5 * expected) << i << s;
  }
}

TEST(Respond, SeparatingContactsAreLeftAlone) {
  Random random(606);
  for (int i = 0; i < 2'000; ++i) {
    Hit hit = randomHit(random);
    hit.motion.velocity = -hit.motion.velocity;
    hit.motion.yawRate = -hit.motion.yawRate;
    hit.settings.law = i % 2 == 0 ? Law::restitution : Law::energy;
    hit.settings.method = i % 4 < 2 ? Method::bumper : Method::paper;
    const ImpactResponse response = answer(hit);
    ASSERT_EQ(response.impulse.linear, Vector2::Zero());
    ASSERT_EQ(response.impulse.angular, 0.0);
    ASSERT_EQ(response.after.velocity, hit.motion.velocity);
    ASSERT_EQ(response.contact.regime, Regime::separating);
    ASSERT_LE(response.approachSpeed, 0.0);
    ASSERT_EQ(response.energyRatio, 1.0);
  }
}

/// Two vehicles that close at a random contact point.
struct Pair {
  Hit hit;
  PlanarBody first;
  PlanarBody second;
};

double closingSpeed(const Pair& pair, const PlanarMotion& first, const PlanarMotion& second) {
  return -(velocityAt(first, pair.hit.impact.arm) - velocityAt(second, pair.hit.impact.otherArm))
              .dot(pair.hit.impact.normal);
}

Pair randomPair(Random& random) {
  Pair pair{.hit = randomHit(random), .first = {}, .second = {}};
  const Hit other = randomHit(random);
  pair.first = freeBody(pair.hit.vehicle, pair.hit.motion);
  pair.second = freeBody(other.vehicle, other.motion);
  pair.hit.impact.otherArm = other.impact.arm;
  pair.second.motion.position = pair.hit.impact.point - other.impact.arm;
  if (closingSpeed(pair, pair.first.motion, pair.second.motion) < 0.0) {
    pair.hit.impact.normal = -pair.hit.impact.normal;
  }
  return pair;
}

// Momentum, moment of momentum, restitution and energy, from the motions alone.
TEST(RespondOnAnotherBody, KeepsMomentumAndTheLaw) {
  Random random(607);
  for (int i = 0; i < 10'000; ++i) {
    Pair pair = randomPair(random);
    ResponseSettings& settings = pair.hit.settings;
    settings.restSpeed = 0.0;
    settings.law = i % 2 == 0 ? Law::restitution : Law::energy;
    const PlanarBody& first = pair.first;
    const PlanarBody& second = pair.second;
    const ImpactResponse response = respond(pair.hit.impact, first, second, settings);
    const PlanarMotion& before = first.motion;
    const PlanarMotion& otherBefore = second.motion;
    const auto momentum = [&](const PlanarMotion& a, const PlanarMotion& b) -> Vector2 {
      return first.mass * a.velocity + second.mass * b.velocity;
    };
    const auto moment = [&](const PlanarMotion& a, const PlanarMotion& b) {
      const Vector2& contact = pair.hit.impact.point;
      return first.yawInertia * a.yawRate + second.yawInertia * b.yawRate +
             cross(a.position - contact, first.mass * a.velocity) +
             cross(b.position - contact, second.mass * b.velocity);
    };
    const double size = momentum(before, otherBefore).norm() + response.impulse.linear.norm();
    ASSERT_LE(
        (momentum(response.after, response.otherAfter) - momentum(before, otherBefore)).norm(),
        1e-13 * size);
    ASSERT_NEAR(moment(response.after, response.otherAfter), moment(before, otherBefore),
                1e-12 * (1.0 + 10.0 * size));

    const double closing = closingSpeed(pair, before, otherBefore);
    ASSERT_NEAR(response.approachSpeed, closing, 1e-12 * (1.0 + closing));
    const double opening = -closingSpeed(pair, response.after, response.otherAfter);
    if (settings.law == Law::restitution) {
      ASSERT_NEAR(opening, response.restitution * closing, 1e-10 * (1.0 + closing)) << i;
    } else {
      ASSERT_LE(opening, settings.maxRestitution * closing * (1.0 + 1e-9) + 1e-10) << i;
    }
    const double energy = first.energy() + second.energy();
    const double energyAfter = yawPlaneEnergy(response.after, first.mass, first.yawInertia) +
                               yawPlaneEnergy(response.otherAfter, second.mass, second.yawInertia);
    ASSERT_LE(energyAfter, energy * (1.0 + 1e-12)) << i;
    ASSERT_NEAR(response.energyRatio, energyAfter / energy, 1e-12) << i;
  }
}

// Which of the two is called the vehicle does not matter, nor a common velocity.
TEST(RespondOnAnotherBody, IsTheSameFromBothSides) {
  Random random(608);
  for (int i = 0; i < 5'000; ++i) {
    const Pair pair = randomPair(random);
    const ResponseSettings& settings = pair.hit.settings;
    const ImpactResponse response = respond(pair.hit.impact, pair.first, pair.second, settings);
    Impact turned = pair.hit.impact;
    turned.normal = -turned.normal;
    std::swap(turned.arm, turned.otherArm);
    const ImpactResponse other = respond(turned, pair.second, pair.first, settings);
    const double size = response.impulse.linear.norm();
    ASSERT_LE((response.impulse.linear + other.impulse.linear).norm(), 1e-12 * size) << i;
    ASSERT_LE((response.after.velocity - other.otherAfter.velocity).norm(), 1e-11) << i;

    PlanarBody first = pair.first;
    PlanarBody second = pair.second;
    for (PlanarBody* body : {&first, &second}) body->motion.velocity += Vector2(30.0, -10.0);
    const ImpactResponse carried = respond(pair.hit.impact, first, second, settings);
    ASSERT_LE((response.impulse.linear - carried.impulse.linear).norm(), 1e-11 * (1.0 + size)) << i;
  }
}

// A body that nothing moves, at rest or driven, is a wall at rest or one that comes along.
TEST(RespondOnAnotherBody, OneThatNothingMovesIsAWall) {
  Random random(609);
  for (int i = 0; i < 5'000; ++i) {
    const Hit hit = randomHit(random);
    const PlanarBody vehicle = freeBody(hit.vehicle, hit.motion);
    const ImpactResponse wall = answer(hit);
    PlanarBody heavy;
    heavy.mass = 1e15 * vehicle.mass;
    heavy.yawInertia = 1e15 * vehicle.yawInertia;
    const ImpactResponse nearly = respond(hit.impact, vehicle, heavy, hit.settings);
    ASSERT_LE((wall.after.velocity - nearly.after.velocity).norm(), 1e-9) << i;

    PlanarBody driven;
    driven.motion.velocity = {random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0)};
    PlanarBody carried = vehicle;
    carried.motion.velocity += driven.motion.velocity;
    const ImpactResponse along = respond(hit.impact, carried, driven, hit.settings);
    ASSERT_LE((along.after.velocity - driven.motion.velocity - wall.after.velocity).norm(), 1e-10)
        << i;
    ASSERT_EQ(along.otherAfter.velocity, driven.motion.velocity);
  }
}

}  // namespace
}  // namespace bumper::tests
