// The timeline of one step: free flight to the next time of impact, impulses there, and on, until
// the step ends.

#include "encounter.h"

#include <algorithm>

#include "bumper/response/sweep.h"

namespace bumper {

namespace {

// Fraction of the penetration recovered in a step, and the slop that is kept, m.
constexpr double recoveryShare = 0.2;
constexpr double allowedDepth = 1e-4;

// Fraction of a step after which a touch without effect is checked again.
constexpr double lookAgain = 0.01;

// A contact that does not approach is checked again before its penetration can exceed this, m.
constexpr double unseenDepth = 1e-6;

}  // namespace

StepOutcome Encounter::resolve(const PlanarBody& body, const Outline& outline,
                               const CollisionStep::Walls& walls, double h) {
  begin(body, outline, walls, h);
  settle();
  while (!isHeld() && h > 0.0) {
    const double next = nextLook(h);
    if (!(next < h) && touched_ == nullptr) break;
    advanceTo(next);
    settle();
  }
  return finish();
}

void Encounter::begin(const PlanarBody& body, const Outline& outline,
                      const CollisionStep::Walls& walls, double h, const Vector2& eased) {
  place(body, outline);
  contacts_.begin(walls.segments, walls.surfaces);
  instant_.begin(h);
  step_ = h;
  shift_ = {};
  settled_ = Settled::without_impulse;
  touched_ = nullptr;

  contacts_.update(0.0);
  if (!(h > 0.0)) return;
  contacts_.findWayOut();
  shift_.velocity = recoveryVelocity(eased);
  if (shift_.velocity.isZero(0.0)) return;
  vehicle_.body.motion.position += h * shift_.velocity;
  contacts_.update(0.0);
  contacts_.findWayOut();
}

void Encounter::settle(Effort effort) {
  settled_ = instant_.settle(time_, effort);
  if (settled_ == Settled::without_impulse && touched_ != nullptr) {
    touched_->ignoredUntil = time_ + lookAgain * step_;
  }
  touched_ = nullptr;
}

double Encounter::nextLook(double until) {
  const double look = std::min(time_ + pause(), until);
  const NextTouch next = nextTouch(look);
  touched_ = next.wall;
  nextTime_ = next.time;
  return next.time;
}

void Encounter::advanceTo(double time) {
  vehicle_.body.motion = advanced(vehicle_.body.motion, time - time_);
  time_ = time;
  if (time != nextTime_) touched_ = nullptr;
  contacts_.update(time);
}

StepOutcome Encounter::finish() const {
  StepOutcome outcome;
  outcome.shift = shift_;
  outcome.impacts = instant_.impacts();
  for (const StepImpact& impact : outcome.impacts) outcome.impulse += impact.response.impulse;
  outcome.settled = !isHeld();
  const PlanarMotion& motion = vehicle_.body.motion;
  if (outcome.settled || !(step_ > 0.0)) {
    outcome.after = advanced(motion, step_ - time_);
  } else {
    // Its further motion is unknown: it is held.
    outcome.after = motion;
    const double share = (step_ - time_) / step_;
    outcome.shift.velocity -= share * motion.velocity;
    outcome.shift.yawRate -= share * motion.yawRate;
  }
  return outcome;
}

// Of all walls that the outline penetrates: the velocity of penetration recovery.
Vector2 Encounter::recoveryVelocity(const Vector2& eased) const {
  constexpr double most = CollisionStep::maxRecoverySpeed;
  Vector2 velocity = eased;
  for (const Manifold& wall : contacts_.all()) {
    if (!wall.touched || wall.hidden || wall.passed) continue;
    const double depth = wall.overlap.depth - allowedDepth;
    if (depth <= 0.0) continue;
    const double wanted = std::min(recoveryShare * depth / step_, most);
    const double missing = wanted - velocity.dot(wall.overlap.normal);
    if (missing > 0.0) velocity += missing * wall.overlap.normal;
  }
  const double speed = velocity.norm();
  return speed > most ? Vector2(most / speed * velocity) : velocity;
}

// The next touch, and its wall; null if there is none before `until`.
Encounter::NextTouch Encounter::nextTouch(double until) {
  NextTouch next{.time = until, .wall = nullptr};
  const Sweep among(vehicle_.outline, vehicle_.body.motion);
  for (Manifold& wall : contacts_.all()) {
    if (wall.passed) continue;
    const double start = std::max(time_, wall.ignoredUntil);
    if (start > next.time) continue;
    const auto wait = [&](const Sweep& sweep) {
      return sweep.timeOfTouch(wall.segment, wall.touched ? &wall.overlap : nullptr, start - time_,
                               next.time - time_);
    };
    const double time =
        time_ +
        (contacts_.surfaceOf(wall).moves
             ? wait(Sweep(vehicle_.outline, vehicle_.body.motion, contacts_.bodyOf(wall).motion))
             : wait(among));
    if (time <= next.time) next = {.time = time, .wall = &wall};
  }
  return next;
}

// How long a touched wall needs no check, s: until then no contact point can approach or be deeper
// than `unseenDepth`.
double Encounter::quietTime(const Manifold& wall) const {
  const PlanarMotion& motion = vehicle_.body.motion;
  const double acceleration = contacts_.gapAcceleration(wall);
  if (wall.hidden) return leastTime(unseenDepth, 0.0, acceleration);
  const Overlap& overlap = wall.overlap;
  const Vector2 tangent = turnedLeft(overlap.normal);
  double time = never;
  for (const ContactPoint& contact : wall.points.all()) {
    const double speed = contacts_.approach(wall, contact, overlap.normal).speed;
    const double along = tangent.dot(contact.point);
    const bool isCorner =
        !overlap.byEnd && std::min(along - overlap.start, overlap.end - along) > touchTolerance;
    // Turning draws a corner away from the wall as long as it lies on the wall's side of the mass
    // centre; at the step's end, too.
    const double highest = overlap.normal.dot(contact.arm) +
                           std::abs(motion.yawRate) * step_ * vehicle_.outline.radius();
    if (!isCorner || highest > 0.0 || contacts_.turns(wall)) {
      time = std::min(time, leastTime(unseenDepth, speed, acceleration));
    }
  }
  return time;
}

// How long no current contact needs a check, s.
double Encounter::pause() const {
  double time = never;
  for (const Manifold& wall : contacts_.all()) {
    if (wall.touched && !wall.passed) time = std::min(time, quietTime(wall));
  }
  return std::max(time, step_ / looksInStep);
}

std::span<const SpeculativeContact> Encounter::speculativeContacts(const PlanarMotion& motion,
                                                                   const PlanarMotion& after,
                                                                   double distance, double h) {
  speculative_.begin(vehicle_.outline, motion, after, distance, h);
  vehicle_.body.motion = motion;
  contacts_.update(0.0);
  for (const Manifold& wall : contacts_.all()) {
    const Surface& surface = contacts_.surfaceOf(wall);
    if (breaks(*surface.settings) || wall.hidden) continue;
    // A long force pulse allows penetration.
    const double depth = surface.entered ? surface.depth
                                         : enteredDepth(contacts_.seenFrom(wall).fastest(),
                                                        surface.settings->contactTime);
    const ContactSet::Forecast then = contacts_.forecast(wall, h);
    speculative_.addWall(then.segment, wall.touched ? &then.overlap : nullptr, depth);
  }
  return speculative_.all();
}

}  // namespace bumper
