#include "bumper/response/force_pulse.h"

namespace bumper {

namespace {

void accumulate(PlanarImpulse& sum, const PlanarImpulse& impulse, double share) {
  sum.linear += share * impulse.linear;
  sum.angular += share * impulse.angular;
}

}  // namespace

void ForcePulse::add(const PlanarImpulse& impulse, double start, double step) {
  const double late = start / step;
  accumulate(thisStep_, impulse, 1.0 - late);
  accumulate(nextStep_, impulse, late);
}

PlanarForce ForcePulse::take(double step) {
  if (!(step > 0.0)) return {};
  PlanarForce force{.force = thisStep_.linear / step, .yawMoment = thisStep_.angular / step};
  thisStep_ = nextStep_;
  nextStep_ = {};
  return force;
}

PlanarImpulse ForcePulse::pending() const {
  PlanarImpulse sum = thisStep_;
  accumulate(sum, nextStep_, 1.0);
  return sum;
}

void ForcePulse::drop() {
  thisStep_ = {};
  nextStep_ = {};
}

}  // namespace bumper
