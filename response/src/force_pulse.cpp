#include "bumper/response/force_pulse.h"

#include <algorithm>
#include <cmath>

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
  accumulate(takenBackNextStep_, impulse, -1.0);
}

void ForcePulse::owe(const PlanarImpulse& impulse) { thisStep_ += impulse; }

PlanarForce ForcePulse::take(double step) {
  if (!(step > 0.0)) return {};
  const PlanarImpulse now = due(step);
  thisStep_ = nextStep_;
  nextStep_ = {};
  takenBackThisStep_ = takenBackNextStep_;
  takenBackNextStep_ = {};
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

void ForcePulse::reconcile(const PlanarImpulse& surplus, const Ordinary& ordinary, double mass,
                           double yawInertia) {
  PlanarImpulse impacts = thisStep_;
  accumulate(impacts, takenBackThisStep_, -1.0);
  PlanarImpulse whole = impacts;
  for (std::size_t i = 0; i < longCount_; ++i) whole += long_[i].left;

  const auto product = [&](double linear, double angular) {
    return linear / mass + angular / yawInertia;
  };
  const double all = product(whole.linear.squaredNorm(), whole.angular * whole.angular);
  if (!(all > 0.0)) return;
  const double done =
      product(surplus.linear.dot(whole.linear), surplus.angular * whole.angular) -
      product(ordinary.linear * whole.linear.norm(), ordinary.angular * std::abs(whole.angular));
  const double share = std::clamp(done / all, 0.0, 1.0);
  if (share == 0.0) return;
  accumulate(thisStep_, impacts, -share);
  for (std::size_t i = 0; i < longCount_; ++i) accumulate(long_[i].left, long_[i].left, -share);
}

void ForcePulse::turnFrame(const Vector2& ahead) {
  const auto turn = [&ahead](PlanarImpulse& impulse) {
    impulse.linear = {ahead.dot(impulse.linear), cross(ahead, impulse.linear)};
  };
  turn(thisStep_);
  turn(nextStep_);
  turn(takenBackThisStep_);
  turn(takenBackNextStep_);
  for (std::size_t i = 0; i < longCount_; ++i) turn(long_[i].left);
}

void ForcePulse::drop() { *this = {}; }

}  // namespace bumper
