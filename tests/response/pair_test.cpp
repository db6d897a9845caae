// Two vehicles that hit each other, from outside: against an oracle in extended precision, and by
// what must hold whatever the rule.

#include "bumper/response/pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "pair_oracle.h"
#include "random_pairs.h"

namespace bumper::tests {
namespace {

constexpr double horizon = 1.0;  // s

std::optional<PairHit> respondTo(const Pair& pair, const ResponseSettings& settings = {}) {
  return respondPair(pair.first, pair.second, settings, horizon);
}

// Two of one make that meet head on and have the same numbers but for their signs.
Pair twins(Random& random) {
  Pair pair = randomPair(random);
  pair.second = pair.first;
  pair.first.motion.position = {-8.0, random.uniform(-0.5, 0.5)};
  pair.first.motion.velocity = {random.uniform(20.0, 30.0), 0.0};
  pair.first.motion.yaw = random.chance(0.5) ? 0.0 : random.uniform(-1.0, 1.0);
  pair.second.motion.position = -pair.first.motion.position;
  pair.second.motion.velocity = -pair.first.motion.velocity;
  pair.second.motion.yaw = pair.first.motion.yaw + std::numbers::pi;
  pair.second.motion.yawRate = pair.first.motion.yawRate;
  return pair;
}

// Of any e ≤ 1 and μ ≤ 1.5.
ResponseSettings anyRestitution(Random& random) {
  ResponseSettings settings;
  settings.restitution = AngleCurve::cosine(randomRestitution(random), randomRestitution(random));
  settings.friction = AngleCurve::constant(random.uniform(0.0, 1.5));
  return settings;
}

double energyOf(const Pair& pair, const PlanarMotion& first, const PlanarMotion& second) {
  return yawPlaneEnergy(first, pair.first.vehicle.mass, pair.first.vehicle.yawInertia) +
         yawPlaneEnergy(second, pair.second.vehicle.mass, pair.second.vehicle.yawInertia);
}

double energyGained(const Pair& pair, const ImpactResponse& r) {
  return energyOf(pair, r.after, r.otherAfter) / energyOf(pair, r.before, r.otherBefore) - 1.0;
}

// Whether the impulse is surely the law's, neither that of a sliver nor one whose depth is capped.
bool isWhole(const Pair& pair, const OracleHit& hit, const ResponseSettings& settings) {
  // Whichever point of the outlines the speed is taken at.
  const double speed = (pair.first.motion.velocity - pair.second.motion.velocity).norm() +
                       std::abs(pair.first.motion.yawRate) * Outline(pair.first.vehicle).radius() +
                       std::abs(pair.second.motion.yawRate) * Outline(pair.second.vehicle).radius();
  const double way = speed * settings.penetrationTime;
  return hit.extent > 0.6 * hit.approach * settings.penetrationTime &&
         way < 0.5 * std::min(pair.first.vehicle.width, pair.second.vehicle.width);
}

TEST(Pair, ExchangedIsNegatedToTheLastBit) {
  Random random(50001);
  int hits = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Pair pair = i % 10 == 0 ? twins(random) : randomPair(random);
    const ResponseSettings settings = anyRestitution(random);
    const std::optional<PairHit> one = respondPair(pair.first, pair.second, settings, horizon);
    const std::optional<PairHit> two = respondPair(pair.second, pair.first, settings, horizon);
    ASSERT_EQ(one.has_value(), two.has_value()) << pair;
    if (!one) continue;
    ++hits;
    const ImpactResponse& a = one->response;
    const ImpactResponse& b = two->response;
    ASSERT_EQ(one->time, two->time) << pair;
    ASSERT_EQ(one->impact.point, two->impact.point) << pair;
    ASSERT_EQ(one->impact.normal, -two->impact.normal) << pair;
    ASSERT_EQ(one->impact.arm, two->impact.otherArm) << pair;
    ASSERT_EQ(one->impact.otherArm, two->impact.arm) << pair;
    ASSERT_EQ(one->impact.depth, two->impact.depth) << pair;
    ASSERT_EQ(a.impulse.linear, -b.impulse.linear) << pair;
    ASSERT_EQ(a.contact.impulse.normal, b.contact.impulse.normal) << pair;
    ASSERT_EQ(a.contact.impulse.tangent, b.contact.impulse.tangent) << pair;
    ASSERT_EQ(a.approachSpeed, b.approachSpeed) << pair;
    ASSERT_EQ(a.energyRatio, b.energyRatio) << pair;
    const auto equal = [](const PlanarMotion& x, const PlanarMotion& y) {
      return x.position == y.position && x.yaw == y.yaw && x.velocity == y.velocity &&
             x.yawRate == y.yawRate;
    };
    ASSERT_TRUE(equal(a.before, b.otherBefore) && equal(a.otherBefore, b.before)) << pair;
    ASSERT_TRUE(equal(a.after, b.otherAfter) && equal(a.otherAfter, b.after)) << pair;
  }
  EXPECT_GT(hits, 6'000);
}

void expectAsOracle(RestitutionKind kind, std::uint64_t seed) {
  Random random(seed);
  int compared = 0;
  int hits = 0;
  double worstTime = 0.0;
  double worstPoint = 0.0;
  double worstNormal = 0.0;
  double worstImpulse = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    const Pair pair = randomPair(random);
    ResponseSettings settings;
    settings.restitutionKind = kind;
    settings.restitution = AngleCurve::cosine(random.uniform(0.0, 0.5), random.uniform(0.0, 0.5));
    settings.friction = AngleCurve::constant(random.uniform(0.0, 1.0));
    settings.penetrationTime = random.chance(0.5) ? 0.0025 : random.uniform(0.001, 0.01);
    const std::optional<OracleHit> oracle = oracleHit(pair, settings, horizon);
    const std::optional<PairHit> hit = respondTo(pair, settings);
    if (hit) ++hits;
    if (!oracle) {
      EXPECT_FALSE(hit) << pair;
      continue;
    }
    // Passing by is followed by later hits, which are not compared.
    if (oracle->approach < 1e-3 || !isWhole(pair, *oracle, settings)) continue;
    ASSERT_TRUE(hit) << pair;
    ++compared;
    const double time = std::abs(hit->time - oracle->time);
    const double point = (hit->impact.point - oracle->point).norm();
    const double normal = (hit->impact.normal - oracle->normal).norm();
    const double impulse =
        (hit->response.impulse.linear - oracle->impulse).norm() / oracle->impulse.norm();
    worstTime = std::max(worstTime, time);
    worstPoint = std::max(worstPoint, point);
    worstNormal = std::max(worstNormal, normal);
    if (!hit->response.contact.restitutionLowered) worstImpulse = std::max(worstImpulse, impulse);
    // The approach differs by as much as the yaw rates make of another point.
    const double spin = std::abs(pair.first.motion.yawRate) + std::abs(pair.second.motion.yawRate);
    const bool fine = time <= 1e-9 && point <= 1e-9 && normal <= 1e-9 &&
                      (impulse <= 1e-9 * (1.0 + spin / oracle->approach) ||
                       hit->response.contact.restitutionLowered);
    EXPECT_TRUE(fine) << pair << "t_p " << settings.penetrationTime << ", time " << hit->time
                      << " by " << time << ", point by " << point << ", normal by " << normal
                      << ", impulse by " << impulse << ", approach " << oracle->approach
                      << ", extent " << oracle->extent;
  }
  std::printf(
      "[ figures  ] %d hits, %d compared; off by %.2g s, %.2g m, normal %.2g, impulse %.2g\n", hits,
      compared, worstTime, worstPoint, worstNormal, worstImpulse);
  EXPECT_GT(compared, 7'000);
}

TEST(Pair, AsWorkedOutInExtendedPrecision) { expectAsOracle(RestitutionKind::newton, 50002); }

TEST(Pair, AsWorkedOutByKudlichSlibar) { expectAsOracle(RestitutionKind::kudlich_slibar, 50003); }

TEST(Pair, KeepsMomentumAndNeverGainsEnergy) {
  Random random(50004);
  double worstLinear = 0.0;
  double worstAngular = 0.0;
  double worstEnergy = 0.0;
  double worstSeparation = 0.0;
  double worstDirection = 0.0;
  int separations = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Pair pair = randomPair(random);
    const ResponseSettings settings = anyRestitution(random);
    const std::optional<PairHit> hit = respondTo(pair, settings);
    if (!hit) continue;
    const ImpactResponse& r = hit->response;
    const double mass[] = {pair.first.vehicle.mass, pair.second.vehicle.mass};
    const double inertia[] = {pair.first.vehicle.yawInertia, pair.second.vehicle.yawInertia};
    const PlanarMotion* before[] = {&r.before, &r.otherBefore};
    const PlanarMotion* after[] = {&r.after, &r.otherAfter};
    Vector2 linear = Vector2::Zero();
    double angular = 0.0;
    double linearScale = 0.0;
    double angularScale = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector2 change = after[k]->velocity - before[k]->velocity;
      const double spin = after[k]->yawRate - before[k]->yawRate;
      linear += mass[k] * change;
      angular += mass[k] * cross(before[k]->position, change) + inertia[k] * spin;
      linearScale += mass[k] * before[k]->velocity.norm();
      angularScale += mass[k] * before[k]->position.norm() * before[k]->velocity.norm() +
                      inertia[k] * std::abs(before[k]->yawRate);
      // A change of velocity is known to the rounding of the velocity.
      const Vector2 impulse = r.impulse.linear;
      const double across = std::abs(cross(change, impulse)) / impulse.norm();
      worstDirection =
          std::max(worstDirection, across / (change.norm() + before[k]->velocity.norm()));
    }
    worstLinear = std::max(worstLinear, linear.norm() / linearScale);
    worstAngular = std::max(worstAngular, std::abs(angular) / angularScale);
    worstEnergy = std::max(worstEnergy, energyGained(pair, r));
    const std::optional<OracleHit> oracle = oracleHit(pair, settings, horizon);
    if (!oracle || oracle->approach < settings.restSpeed || !isWhole(pair, *oracle, settings) ||
        r.contact.restitutionLowered) {
      continue;
    }
    ++separations;
    const auto normalSpeed = [&](const PlanarMotion& a, const PlanarMotion& b) {
      return hit->impact.normal.dot(velocityAt(a, hit->impact.arm) -
                                    velocityAt(b, hit->impact.otherArm));
    };
    const double asked =
        settings.restitution(AttackDirection{oracle->approach, std::abs(oracle->slip)});
    const double left = normalSpeed(r.after, r.otherAfter);
    const double came = normalSpeed(r.before, r.otherBefore);
    EXPECT_NEAR(r.restitution, asked, 1e-9) << pair;
    worstSeparation =
        std::max(worstSeparation, std::abs(left + r.restitution * came) / oracle->speed);
  }
  std::printf(
      "[ figures  ] momentum %.2g, angular %.2g, energy %.2g, direction %.2g, separation %.2g of "
      "%d\n",
      worstLinear, worstAngular, worstEnergy, worstDirection, worstSeparation, separations);
  EXPECT_LE(worstLinear, 1e-12);
  EXPECT_LE(worstAngular, 1e-12);
  EXPECT_LE(worstEnergy, 1e-12);
  EXPECT_LE(worstDirection, 1e-12);
  EXPECT_LE(worstSeparation, 1e-12);
  EXPECT_GT(separations, 4'000);
}

TEST(Pair, KudlichSlibarIsTheSameImpulseMore) {
  Random random(50005);
  double worstEnergy = 0.0;
  double worstImpulse = 0.0;
  int hits = 0;
  while (hits < 32'000) {
    const Pair pair = randomPair(random, {.leastMass = 5.0, .mostMass = 20'000.0});
    ResponseSettings settings;
    settings.restitutionKind = RestitutionKind::kudlich_slibar;
    settings.friction = AngleCurve::constant(random.uniform(0.0, 1.5));
    const double e = randomRestitution(random);
    settings.restitution = AngleCurve::constant(e);
    const std::optional<PairHit> hit = respondTo(pair, settings);
    if (!hit) continue;
    ++hits;
    worstEnergy = std::max(worstEnergy, energyGained(pair, hit->response));
    if (hit->response.approachSpeed < settings.restSpeed) continue;
    settings.restitution = AngleCurve::constant(0.0);
    const std::optional<PairHit> plastic = respondTo(pair, settings);
    ASSERT_TRUE(plastic) << pair;
    const Vector2 expected = (1.0 + e) * plastic->response.impulse.linear;
    worstImpulse =
        std::max(worstImpulse, (hit->response.impulse.linear - expected).norm() / expected.norm());
  }
  std::printf("[ figures  ] energy %.2g, impulse off by %.2g\n", worstEnergy, worstImpulse);
  EXPECT_LE(worstEnergy, 1e-12);
  EXPECT_LE(worstImpulse, 1e-12);
}

TEST(Pair, SeenInAMirrorAndTurned) {
  Random random(50006);
  double worstMirror = 0.0;
  double worstTurn = 0.0;
  for (int i = 0; i < 5'000; ++i) {
    const Pair pair = randomPair(random);
    const ResponseSettings settings = anyRestitution(random);
    const std::optional<PairHit> hit = respondTo(pair, settings);
    const std::optional<OracleHit> oracle = oracleHit(pair, settings, horizon);
    // Where it hits or passes by within rounding nothing can be said.
    if (!hit || !oracle || oracle->approach < 1e-3 || !isWhole(pair, *oracle, settings)) continue;
    const Vector2 impulse = hit->response.impulse.linear;
    const std::optional<PairHit> mirror = respondTo(mirrored(pair), settings);
    ASSERT_TRUE(mirror) << pair;
    const Vector2 inMirror = mirror->response.impulse.linear;
    worstMirror = std::max(
        worstMirror, (Vector2(inMirror.x(), -inMirror.y()) - impulse).norm() / impulse.norm());
    const double angle = random.uniform(-3.0, 3.0);
    const std::optional<PairHit> other = respondTo(turned(pair, angle), settings);
    ASSERT_TRUE(other) << pair;
    worstTurn =
        std::max(worstTurn, (rotated(other->response.impulse.linear, -angle) - impulse).norm() /
                                impulse.norm());
  }
  std::printf("[ figures  ] mirror %.2g, turned %.2g\n", worstMirror, worstTurn);
  EXPECT_LE(worstMirror, 1e-9);
  EXPECT_LE(worstTurn, 1e-9);
}

// As a network carries the state of the other one.
TEST(Pair, OtherInSinglePrecision) {
  Random random(50007);
  double worst = 0.0;
  Pair worstPair;
  int compared = 0;
  int off = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Pair pair = randomPair(random);
    const std::optional<PairHit> hit = respondTo(pair);
    const std::optional<OracleHit> oracle = oracleHit(pair, {}, horizon);
    if (!hit || !oracle || oracle->approach < 1e-3 || !isWhole(pair, *oracle, {})) continue;
    const std::optional<PairHit> single = respondTo({pair.first, rounded(pair.second)});
    ASSERT_TRUE(single) << pair;
    const double error = (single->response.impulse.linear - hit->response.impulse.linear).norm() /
                         hit->response.impulse.linear.norm();
    ++compared;
    if (error > 1e-4) ++off;
    if (error > worst) {
      worst = error;
      worstPair = pair;
    }
  }
  std::printf("[ figures  ] off by %.2g, %d of %d by more than 1e-4\n", worst, off, compared);
  // A few hits are steep: slow ones of fast turning corners.
  EXPECT_LE(off, compared / 500);
  EXPECT_LE(worst, 2e-3) << worstPair;
}

}  // namespace
}  // namespace bumper::tests
