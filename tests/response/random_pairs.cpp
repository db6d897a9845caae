#include "random_pairs.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>

namespace bumper::tests {
namespace {

// GCC 12 leaves the rounding out of two such conversions that it does at once.
double single(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

PairState flippedState(PairState state) {
  state.motion.position.y() *= -1.0;
  state.motion.velocity.y() *= -1.0;
  state.motion.yaw *= -1.0;
  state.motion.yawRate *= -1.0;
  return state;
}

PairState turnedState(PairState state, double angle) {
  state.motion.position = rotated(state.motion.position, angle);
  state.motion.velocity = rotated(state.motion.velocity, angle);
  state.motion.yaw += angle;
  return state;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const PairState& state) {
  const auto& [vehicle, motion] = state;
  return out << std::setprecision(17) << "m " << vehicle.mass << ", I " << vehicle.yawInertia
             << ", front " << vehicle.massCentreToFront << ", rear " << vehicle.massCentreToRear
             << ", width " << vehicle.width << " at (" << motion.position.transpose() << "), yaw "
             << motion.yaw << ", velocity (" << motion.velocity.transpose() << "), yaw rate "
             << motion.yawRate << '\n';
}

std::ostream& operator<<(std::ostream& out, const Pair& pair) {
  return out << pair.first << pair.second;
}

VehicleParameters vehicleOfMass(Random& random, double mass) {
  const double size = std::log(mass / 250.0) / std::log(18'000.0 / 250.0);
  const double grown = mass < 250.0 ? std::cbrt(mass / 250.0) : 1.0;
  const double length = grown * std::lerp(2.2, 10.0, std::clamp(size, 0.0, 1.2));
  VehicleParameters vehicle;
  vehicle.mass = mass;
  vehicle.width = grown * std::lerp(0.8, 2.5, std::clamp(size, 0.0, 1.0));
  vehicle.massCentreToFront = random.uniform(0.4, 0.6) * length;
  vehicle.massCentreToRear = length - vehicle.massCentreToFront;
  const double gyration = random.uniform(0.22, 0.33) * length;
  vehicle.yawInertia = mass * gyration * gyration;
  vehicle.massCentreHeight = 0.3 * vehicle.width;
  return vehicle;
}

VehicleParameters randomVehicle(Random& random, const PairLimits& limits) {
  return vehicleOfMass(
      random, std::exp(random.uniform(std::log(limits.leastMass), std::log(limits.mostMass))));
}

Pair randomPair(Random& random, const PairLimits& limits) {
  constexpr double pi = std::numbers::pi;
  Pair pair;
  for (PairState* state : {&pair.first, &pair.second}) {
    state->vehicle = randomVehicle(random, limits);
    state->motion.yaw = random.uniform(-pi, pi);
    state->motion.yawRate = random.uniform(-limits.mostYawRate, limits.mostYawRate);
    state->motion.velocity =
        random.uniform(0.0, limits.mostSpeed) * direction(random.uniform(-pi, pi));
  }
  PlanarMotion& a = pair.first.motion;
  PlanarMotion& b = pair.second.motion;
  Vector2 closing = b.velocity - a.velocity;
  if (closing.norm() < 1.0) {
    b.velocity += direction(random.uniform(-pi, pi));
    closing = b.velocity - a.velocity;
  }
  // Back from somewhere in the first one's way, to where the outlines cannot touch.
  const double room = Outline(pair.first.vehicle).radius() + Outline(pair.second.vehicle).radius();
  const Vector2 way = closing.normalized();
  const double offset = random.uniform(-0.7, 0.7) * room;
  a.position = {random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0)};
  b.position = a.position + offset * turnedLeft(way) - (room + 0.01) * way;
  return pair;
}

Pair mirrored(const Pair& pair) { return {flippedState(pair.first), flippedState(pair.second)}; }

Pair turned(const Pair& pair, double angle) {
  return {turnedState(pair.first, angle), turnedState(pair.second, angle)};
}

PairState rounded(const PairState& state) {
  PairState result = state;
  result.motion = {
      .position = {single(state.motion.position.x()), single(state.motion.position.y())},
      .yaw = single(state.motion.yaw),
      .velocity = {single(state.motion.velocity.x()), single(state.motion.velocity.y())},
      .yawRate = single(state.motion.yawRate)};
  return result;
}

}  // namespace bumper::tests
