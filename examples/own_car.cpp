#include "own_car.h"

namespace bumper::examples {

PlanarMotion OwnCar::unhindered(const PlanarImpulse& due, double h) const {
  PlanarImpulse all{.linear = h * own_.force, .angular = h * own_.yawMoment};
  all += due;
  return afterImpulse(motion_, all, parameters_.mass, parameters_.yawInertia);
}

void OwnCar::stepByForce(std::span<const WallSegment> walls, double h) {
  const StepOutcome outcome =
      collision_.resolve(parameters_, unhindered(pulse_.due(h), h), walls, h);
  for (const StepImpact& each : outcome.impacts) {
    pulse_.add(each.response.impulse, each.time, h);
  }
  pulse_.shift({.linear = parameters_.mass * outcome.shift.velocity,
                .angular = parameters_.yawInertia * outcome.shift.yawRate});
  // From here on it is any engine's own step, with one more force.
  const PlanarForce force = pulse_.take(h);
  motion_.velocity += h / parameters_.mass * (own_.force + force.force);
  motion_.yawRate += h / parameters_.yawInertia * (own_.yawMoment + force.yawMoment);
  motion_ = advanced(motion_, h);
  own_ = {};
}

void OwnCar::stepByReset(std::span<const WallSegment> walls, double h) {
  motion_ = collision_.resolve(parameters_, unhindered({}, h), walls, h).after;
  own_ = {};
}

PlanarMotion OwnCar::motion() const {
  return afterImpulse(motion_, pulse_.pending(), parameters_.mass, parameters_.yawInertia);
}

}  // namespace bumper::examples
