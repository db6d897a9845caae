#include "vehicle_cases.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "../response/random_pairs.h"
#include "bumper/response/outline.h"

namespace bumper::benchmark {

namespace {

using tests::direction;
using tests::Random;

constexpr double pi = std::numbers::pi;
constexpr double moved = 1e-10;  // m

ResponseSettings lawOf(VehicleKind kind, Random& random) {
  ResponseSettings settings;
  if (kind == VehicleKind::plain) settings.penetrationTime = 0.0;
  if (kind != VehicleKind::plain && random.chance(0.5)) return settings;
  settings.restitution = AngleCurve::constant(random.uniform(0.05, 0.4));
  settings.friction = AngleCurve::constant(random.uniform(0.1, 0.6));
  if (kind != VehicleKind::plain) settings.penetrationTime = random.uniform(0.0, 0.01);
  return settings;
}

VehicleCase pairCase(Random& random, ResponseSettings settings) {
  const tests::Pair pair = tests::randomPair(random);
  return {.vehicles = {pair.first, pair.second}, .walls = {}, .settings = std::move(settings)};
}

/// A car drives with a corner at the side of another that stands or drives along.
VehicleCase plainCase(Random& random, ResponseSettings settings) {
  const VehicleParameters car{.mass = 1500.0,
                              .yawInertia = 2600.0,
                              .massCentreToFront = 2.1,
                              .massCentreToRear = 2.5,
                              .width = 1.8,
                              .massCentreHeight = 0.55};
  PairState hit{.vehicle = car, .motion = {}};
  hit.motion.velocity.x() = random.uniform(0.0, 15.0);
  PairState hitting{.vehicle = car, .motion = {}};
  const double heading = random.uniform(15.0, 75.0) / 180.0 * pi;
  hitting.motion.yaw = -heading;
  hitting.motion.velocity = hit.motion.velocity + random.uniform(8.0, 30.0) * direction(-heading);
  // Its front right corner meets the left side away from both ends, after up to 0.2 s.
  const Vector2 corner = rotated(Vector2(car.massCentreToFront, -0.5 * car.width), -heading);
  const Vector2 place(random.uniform(-1.5, 1.1), 0.5 * car.width);
  const double wait = random.uniform(0.02, 0.2);
  hitting.motion.position = place - corner - wait * (hitting.motion.velocity - hit.motion.velocity);
  // Seen in a frame that is askew to what all of them compute in.
  const tests::Pair turned = tests::turned({hit, hitting}, random.uniform(-pi, pi));
  return {.vehicles = {turned.first, turned.second}, .walls = {}, .settings = std::move(settings)};
}

bool areClear(const PairState& a, const PairState& b) {
  const double room = Outline(a.vehicle).radius() + Outline(b.vehicle).radius();
  return (a.motion.position - b.motion.position).norm() > room;
}

VehicleCase sceneCase(Random& random, ResponseSettings settings) {
  VehicleCase scene{.vehicles = {}, .walls = {}, .settings = std::move(settings)};
  const double askew = random.uniform(-pi, pi);
  const double half = random.uniform(5.0, 9.0);
  const auto wall = [&](double yaw) {
    const Vector2 along = direction(yaw);
    const Vector2 foot = -half * turnedLeft(along);
    scene.walls.push_back({foot - 200.0 * along, foot + 200.0 * along});
  };
  wall(askew);
  if (random.chance(0.5)) wall(askew + pi);
  const auto count = static_cast<std::size_t>(2 + random.below(4));
  for (int tries = 0; tries < 200 && scene.vehicles.size() < count; ++tries) {
    PairState one{.vehicle = tests::randomVehicle(random, {.mostMass = 4000.0}), .motion = {}};
    const double reach = Outline(one.vehicle).radius();
    const double across = random.uniform(reach - half, half - reach);
    const double along = random.uniform(-14.0, 14.0);
    one.motion.position = along * direction(askew) + across * turnedLeft(direction(askew));
    one.motion.yaw = random.uniform(-pi, pi);
    one.motion.yawRate = random.uniform(-3.0, 3.0);
    const Vector2 target(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0));
    one.motion.velocity = random.uniform(5.0, 30.0) * (target - one.motion.position).normalized();
    bool isFree = true;
    for (const PairState& other : scene.vehicles) isFree = isFree && areClear(one, other);
    if (isFree) scene.vehicles.push_back(one);
  }
  return scene;
}

VehicleCase randomCase(VehicleKind kind, Random& random) {
  ResponseSettings settings = lawOf(kind, random);
  switch (kind) {
    case VehicleKind::plain:
      return plainCase(random, std::move(settings));
    case VehicleKind::pair:
      return pairCase(random, std::move(settings));
    default:
      return sceneCase(random, std::move(settings));
  }
}

}  // namespace

const char* nameOf(VehicleKind kind) {
  constexpr std::array<const char*, 3> names = {"two_cars", "two_vehicles", "several_vehicles"};
  return names.at(static_cast<std::size_t>(kind));
}

VehicleBatch makeVehicleBatch(VehicleKind kind, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  VehicleBatch batch;
  batch.kind = kind;
  while (batch.cases.size() < count) {
    ReferencedVehicles one{.vehicleCase = randomCase(kind, random), .flight = {}};
    one.flight = flyVehicles(one.vehicleCase, longestVehicleRun);
    const VehicleFlight& flight = one.flight;
    const bool isDoubtful = flight.doubt != Doubt::none && !(flight.duration > 0.0);
    if (flight.duration > 0.0 || isDoubtful) ++batch.tried;
    if (isDoubtful) ++batch.doubtful.at(static_cast<std::size_t>(flight.doubt));
    if (!(flight.duration > 0.0)) continue;
    if (kind == VehicleKind::scene && (flight.vehicleImpacts == 0 || flight.wallImpacts == 0)) {
      --batch.tried;
      continue;
    }
    VehicleCase other = one.vehicleCase;
    other.vehicles.front().motion.position += Vector2(moved, moved);
    const VehicleFlight then = flyVehicles(other, longestVehicleRun);
    if (then.vehicleImpacts != flight.vehicleImpacts || then.wallImpacts != flight.wallImpacts ||
        then.duration != flight.duration) {
      ++batch.sensitive;
      continue;
    }
    batch.cases.push_back(std::move(one));
  }
  return batch;
}

}  // namespace bumper::benchmark
