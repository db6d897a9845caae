#include "bumper/response/force_pulse.h"

#include <algorithm>

namespace bumper {

namespace {

void accumulate(PlanarImpulse& sum, const PlanarImpulse& impulse, double share) {
  sum.linear += share * impulse.linear;
  sum.angular += share * impulse.angular;
}

bool isZero(const PlanarImpulse& impulse) {
  return impulse.linear.isZero(0.0) && impulse.angular == 0.0;
}

}  // namespace

void ForcePulse::add(const PlanarImpulse& impulse, double start, double step) {
  const double late = start / step;
  accumulate(thisStep_, impulse, 1.0 - late);
  accumulate(nextStep_, impulse, late);
}

void ForcePulse::addLong(const PlanarImpulse& impulse, double start, double duration) {
  if (longCount_ < maxLong) {
    long_[longCount_++] = {.left = impulse, .delay = start, .time = duration};
    return;
  }
  Long& last = long_.back();
  last.left += impulse;
  last.time = std::max(last.time, duration);
}

void ForcePulse::shift(const PlanarImpulse& impulse) {
  thisStep_ += impulse;
  accumulate(nextStep_, impulse, -1.0);
}

void ForcePulse::owe(const PlanarImpulse& impulse) { thisStep_ += impulse; }

PlanarForce ForcePulse::take(double step) {
  if (!(step > 0.0)) return {};
  const PlanarImpulse now = due(step);
  thisStep_ = nextStep_;
  nextStep_ = {};
  std::size_t running = 0;
  for (std::size_t i = 0; i < longCount_; ++i) {
    Long pulse = long_[i];
    const double run = std::clamp(step - pulse.delay, 0.0, pulse.time);
    accumulate(pulse.left, pulse.left, -run / pulse.time);
    pulse.delay = std::max(pulse.delay - step, 0.0);
    pulse.time -= run;
    if (pulse.time > 0.0) long_[running++] = pulse;
  }
  longCount_ = running;
  return {.force = now.linear / step, .yawMoment = now.angular / step};
}

PlanarImpulse ForcePulse::due(double step) const {
  if (!(step > 0.0)) return {};
  PlanarImpulse sum = thisStep_;
  for (std::size_t i = 0; i < longCount_; ++i) {
    const Long& pulse = long_[i];
    accumulate(sum, pulse.left, std::clamp(step - pulse.delay, 0.0, pulse.time) / pulse.time);
  }
  return sum;
}

PlanarImpulse ForcePulse::pending() const {
  PlanarImpulse sum = thisStep_;
  sum += nextStep_;
  for (std::size_t i = 0; i < longCount_; ++i) sum += long_[i].left;
  return sum;
}

bool ForcePulse::isEmpty() const {
  return longCount_ == 0 && isZero(thisStep_) && isZero(nextStep_);
}

void ForcePulse::turnFrame(const Vector2& ahead) {
  const auto turn = [&ahead](PlanarImpulse& impulse) {
    impulse.linear = {ahead.dot(impulse.linear), cross(ahead, impulse.linear)};
  };
  turn(thisStep_);
  turn(nextStep_);
  for (std::size_t i = 0; i < longCount_; ++i) turn(long_[i].left);
}

void ForcePulse::drop() { *this = {}; }

}  // namespace bumper
