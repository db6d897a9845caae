#include <algorithm>
#include <cmath>
#include <limits>

#include "ode_vectors.h"
#include "pulse_delivery.h"
#include "responder_implementation.h"
#include "sustained_contacts.h"

namespace bumper {

namespace {

// A contact that begins more slowly than this, m/s, is rounding's.
constexpr double noticedSpeed = 1e-6;

// The vehicle in its own frame, with the velocity that it has in this step without walls: ODE moves
// it with the velocity that the forces lead to. The paper takes the velocity as it is.
PlanarMotion motionOf(const VehicleState& state, const ForcePulse& pulse, Method method, double h) {
  const double ahead = method == Method::paper ? 0.0 : h;
  const PlanarImpulse due = pulse.due(h);
  const Eigen::Vector3d velocity = state.velocity + ahead * state.acceleration;
  PlanarMotion motion;
  motion.velocity = (state.axes.transpose() * velocity).head<2>() + due.linear / state.mass;
  motion.yawRate = state.yawRate + ahead * state.yawAcceleration + due.angular / state.yawInertia;
  return motion;
}

// What the law works with: the outline as given, mass and inertia as the bodies have them now.
VehicleParameters withMassOf(VehicleParameters parameters, const VehicleState& state) {
  parameters.mass = state.mass;
  parameters.yawInertia = state.yawInertia;
  return parameters;
}

// What acts on a vehicle besides the forces that are known before a step, joints above all, is the
// difference between the last step's outcome and what it should have been. It rarely changes much
// from step to step: the coming step's is foreseen to be its running mean, which keeps the solver's
// noise out of the answer.
void foresee(Expectation& expected, VehicleState& state) {
  // More than tyres can do was a blow or a teleport, and is over.
  constexpr double mostAcceleration = 15.0;     // m/s²
  constexpr double mostYawAcceleration = 15.0;  // rad/s²
  constexpr double weight = 0.25;               // of the last step in the mean
  if (expected.step <= 0.0) return;
  const Eigen::Vector3d acceleration = (state.velocity - expected.velocity) / expected.step;
  const double yawAcceleration = (state.yawRate - expected.yawRate) / expected.step;
  if (acceleration.norm() <= mostAcceleration && std::abs(yawAcceleration) <= mostYawAcceleration) {
    const double share = expected.known ? weight : 1.0;
    expected.acceleration += share * (acceleration - expected.acceleration);
    expected.yawAcceleration += share * (yawAcceleration - expected.yawAcceleration);
    expected.known = true;
  }
  state.acceleration += expected.acceleration;
  state.yawAcceleration += expected.yawAcceleration;
}

// What the coming step should do by the known forces and the impulse that is given.
void expect(const VehicleState& known, const PlanarImpulse& impulse, double h,
            Expectation& expected) {
  expected.step = h;
  expected.velocity =
      known.velocity + h * known.acceleration + known.toWorld(impulse.linear) / known.mass;
  expected.yawRate = known.yawRate + h * known.yawAcceleration + impulse.angular / known.yawInertia;
}

double gravityOf(dWorldID world) {
  dVector3 gravity;
  dWorldGetGravity(world, gravity);
  return toVector(gravity).norm();
}

// Where the vehicle's forward axis points now in the yaw plane that it had before, unit.
Vector2 aheadSince(const Eigen::Matrix3d& before, const Eigen::Matrix3d& now) {
  return (before.transpose() * now.col(0)).head<2>().normalized();
}

}  // namespace

// Puts right what the world's last step did not do as it was told.
void Responder::Implementation::reconsiderLastStep(std::span<Vehicle* const> some) {
  bool repeated = false;
  for (Vehicle* each : some) {
    if (!each->memory.delivery.any) continue;
    Vehicle& vehicle = *each;
    VehicleMemory& memory = vehicle.memory;
    double worldStep = 0.0;
    switch (lookBack(memory.delivery, vehicle.bodies.chassis(), worldStep)) {
      case LastStep::as_told:
        break;
      case LastStep::not_taken:
        takeBack(vehicle.bodies, vehicle.bodies.read(), options.delivery, memory.delivery);
        memory = vehicle.memoryBefore;
        vehicle.issues |= step_issue::repeated_step;
        repeated = true;
        break;
      case LastStep::other_size: {
        const double missing = 1.0 - worldStep / memory.delivery.step;
        if (options.delivery == Delivery::force_pulse) {
          memory.pulse.owe({.linear = missing * memory.delivery.impulse.linear,
                            .angular = missing * memory.delivery.impulse.angular});
        }
        memory.expectation = {};
        vehicle.issues |= step_issue::other_step_size;
        break;
      }
      case LastStep::moved_since:
        memory.pulse.drop();
        memory.expectation = {};
        vehicle.issues |= step_issue::moved;
        break;
    }
    memory.delivery.any = false;
  }
  if (repeated) time -= lastStep;
}

// `wall` is any of those that make one face with the one that was hit.
void Responder::Implementation::report(Vehicle& vehicle, const VehicleState& state,
                                       const Barrier& barrier, int wall, const StepImpact& each) {
  const Impact& impact = each.impact;
  const ImpactResponse& response = each.response;
  const Eigen::Vector3d contact = state.massCentre + state.toWorld(impact.point);
  const Eigen::Vector3d normal = state.toWorld(impact.normal);
  const double when = time + each.time;
  const double energyLost = -response.contact.energyChange;

  const ResponseSettings& settings = barrier.settings(barrier.settingsNumberOf(wall));
  const double soft = isInContact(vehicle.memory.contacts, barrier.id())
                          ? impactInContact * settings.restSpeed
                          : settings.restSpeed;
  const bool hard = response.approachSpeed > soft && !each.slides;
  const bool begins = addToContact(vehicle.memory.contacts,
                                   {.barrier = barrier.id(),
                                    .wall = wall,
                                    .impulseNormal = response.contact.impulse.normal,
                                    .impulseTangent = response.contact.impulse.tangent,
                                    .energyLost = energyLost,
                                    .contact = contact,
                                    .normal = normal},
                                   when, !hard && response.approachSpeed > noticedSpeed);
  if (!hard && !begins) return;

  ImpactEvent event;
  event.time = when;
  event.phase = hard ? EventPhase::impact : EventPhase::contact_begin;
  event.vehicle = vehicle.name;
  event.barrier = barrier.name();
  event.triangle = barrier.triangleOf(barrier.wallAt(wall, contact));
  event.material = barrier.materialOf(wall);
  event.contact = contact;
  event.normal = normal;
  event.arm = rotated(impact.arm, -response.before.yaw);
  event.law = response.law;
  event.angles = anglesOfAttack(impact, response.before);
  event.approachSpeed = response.approachSpeed;
  event.restitution = response.restitution;
  event.friction = response.friction;
  event.impulseNormal = response.contact.impulse.normal;
  event.impulseTangent = response.contact.impulse.tangent;
  event.impulseRatio = response.contact.impulseRatio;
  event.criticalImpulseRatio = response.contact.criticalRatio;
  event.deltaV = (response.after.velocity - response.before.velocity).norm();
  event.yawRateBefore = response.before.yawRate;
  event.yawRateAfter = response.after.yawRate;
  event.speedBefore = response.before.velocity.norm();
  event.speedAfter = response.after.velocity.norm();
  event.velocityAfter =
      state.toWorld(response.after.velocity) + state.up().dot(state.velocity) * state.up();
  event.energyAsked = response.energyAsked;
  event.energyRatio = response.energyRatio;
  event.energyLost = energyLost;
  event.outcome = response.outcome;
  event.regime = response.contact.regime;
  events.push_back(event);
}

void Responder::Implementation::endContacts(Vehicle& vehicle) {
  Outline around = vehicle.query.outline();
  around.front += contactDistance;
  around.rear += contactDistance;
  around.halfWidth += contactDistance;
  std::erase_if(vehicle.memory.contacts, [&](const SustainedContact& contact) {
    if (time - contact.last < contactPause) return false;
    const bool near = std::any_of(segments.begin(), segments.end(), [&](const WallSegment& wall) {
      return wall.group == contact.barrier.value && findTouch(around, {}, wall).has_value();
    });
    if (near) return false;
    const Barrier& barrier = *barriers[static_cast<std::size_t>(contact.barrier.value)];
    ImpactEvent event;
    event.time = contact.last;
    event.phase = EventPhase::contact_end;
    event.vehicle = vehicle.name;
    event.barrier = barrier.name();
    event.triangle = barrier.triangleOf(barrier.wallAt(contact.wall, contact.contact));
    event.material = barrier.materialOf(contact.wall);
    event.contact = contact.contact;
    event.normal = contact.normal;
    event.impulseNormal = contact.impulseNormal;
    event.impulseTangent = contact.impulseTangent;
    event.energyLost = contact.energyLost;
    event.duration = contact.last - contact.begun;
    events.push_back(event);
    return true;
  });
}

// Walls that broke are left out until the outline has left them, and those whose long force pulse
// runs until it ends.
void Responder::Implementation::leaveOutPassages(Vehicle& vehicle) {
  std::erase_if(vehicle.memory.passages, [&](const Passage& passage) {
    const Barrier& barrier = *barriers[static_cast<std::size_t>(passage.barrier.value)];
    const ResponseSettings* settings = &barrier.settings(passage.settings);
    const auto isOfIt = [&](const WallSegment& wall) {
      return wall.group == passage.barrier.value && wall.settings == settings;
    };
    const bool goesOn =
        passage.until > 0.0
            ? time < passage.until
            : std::any_of(segments.begin(), segments.end(), [&](const WallSegment& wall) {
                return isOfIt(wall) && findTouch(vehicle.query.outline(), {}, wall).has_value();
              });
    if (goesOn) std::erase_if(segments, isOfIt);
    return !goesOn;
  });
}

void Responder::Implementation::forgetSurroundings() {
  for (const std::unique_ptr<Vehicle>& vehicle : vehicles) {
    if (vehicle == nullptr) continue;
    vehicle->freeSpace.forget();
    vehicle->nearby.forget();
  }
}

// Whether walls are near; those that matter are in `segments`.
bool Responder::Implementation::collectWalls(Vehicle& vehicle, const VehicleState& state,
                                             const PlanarMotion& motion, double h) {
  if (!options.skipping) vehicle.nearby.forget();
  const VehicleMemory& memory = vehicle.memory;
  return vehicle.nearby.collect(
      vehicle.query, barriers, state,
      {.zone = vehicle.query.nearZone(motion, state.velocity.norm(), h),
       .swept = vehicle.query.swept(motion, h),
       .reach = CollisionStep::reach(withMassOf(vehicle.parameters, state), motion,
                                     longestPenetrationTime, h),
       .evenIfNoneIsTouched =
           !options.skipping || mayHaveEnded(memory.contacts, time) || !memory.passages.empty()},
      segments);
}

void Responder::Implementation::answerCuts(Vehicle& vehicle, const VehicleState& state,
                                           const PlanarMotion& motion, double h) {
  const StepOutcome outcome =
      collision.resolve(withMassOf(vehicle.parameters, state), motion, segments, h);
  if (!outcome.settled) vehicle.issues |= step_issue::unsettled;
  ForcePulse& pulse = vehicle.memory.pulse;
  pulse.shift({.linear = state.mass * outcome.shift.velocity,
               .angular = state.yawInertia * outcome.shift.yawRate});
  for (const StepImpact& each : outcome.impacts) {
    const BarrierWall hit = vehicle.nearby.at(each.impact.wall);
    const Barrier& barrier = *hit.barrier;
    const int wall = hit.wall;
    const int number = barrier.settingsNumberOf(wall);
    const double contactTime = barrier.settings(number).contactTime;
    if (contactTime > 0.0) {
      pulse.addLong(each.response.impulse, each.time, contactTime);
      vehicle.memory.passages.push_back(
          {.barrier = barrier.id(), .settings = number, .until = time + each.time + contactTime});
    } else {
      pulse.add(each.response.impulse, each.time, h);
    }
    if (each.response.brokeThrough) {
      vehicle.memory.passages.push_back({.barrier = barrier.id(), .settings = number});
    }
    report(vehicle, state, barrier, wall, each);
  }
}

void Responder::Implementation::answerContacts(Vehicle& vehicle, const VehicleState& state,
                                               PlanarMotion motion, double h) {
  for (const std::unique_ptr<Barrier>& barrier : barriers) {
    if (barrier == nullptr || barrier->mesh() == nullptr) continue;
    const std::optional<Impact> impact = vehicle.query.meanOfContacts(*barrier->mesh(), state);
    if (!impact || -velocityAt(motion, impact->arm).dot(impact->normal) <= 0.0) continue;
    const ImpactResponse response =
        respond(*impact, motion, state.mass, state.yawInertia,
                barrier->settings(barrier->settingsNumberOf(impact->wall)));
    vehicle.memory.pulse.add(response.impulse, 0.0, h);
    report(vehicle, state, *barrier, impact->wall, {.impact = *impact, .response = response});
    motion = response.after;
  }
}

// Hands over what of the force pulses falls into the coming step.
void Responder::Implementation::give(Vehicle& vehicle, const VehicleState& state, double h) {
  VehicleMemory& memory = vehicle.memory;
  const PlanarForce force = memory.pulse.take(h);
  const PlanarImpulse impulse{.linear = h * force.force, .angular = h * force.yawMoment};
  if (!impulse.linear.allFinite() || !std::isfinite(impulse.angular)) {
    memory.pulse.drop();
    vehicle.issues |= step_issue::not_finite;
    return;
  }
  deliver(vehicle.bodies, state, impulse, h, options.delivery, memory.delivery);
}

void Responder::Implementation::stepVehicle(Vehicle& vehicle, double h) {
  VehicleMemory& memory = vehicle.memory;
  vehicle.freeSpace.leave();
  if (vehicle.bodies.areAsleep()) {
    memory.expectation = {};
    return;
  }
  const VehicleState known = vehicle.bodies.read();
  if (!known.isFinite()) {
    vehicle.issues |= step_issue::not_finite;
    memory.pulse.drop();
    memory.expectation = {};
    return;
  }
  const bool delivering = !memory.pulse.isEmpty();
  if (delivering) {
    vehicle.memoryBefore = memory;
    memory.pulse.turnFrame(aheadSince(memory.delivery.axes, known.axes));
  }
  const bool upright = vehicle.isUpright();
  const bool exact = options.contactSource == ContactSource::exact_cut;
  VehicleState state = known;
  PlanarMotion motion;
  bool near = false;
  segments.clear();
  const bool remembersWalls = delivering || memory.expectation.step > 0.0 ||
                              mayHaveEnded(memory.contacts, time) || !memory.passages.empty();
  if (exact && upright && options.skipping && !remembersWalls &&
      vehicle.freeSpace.find(barriers, known, gravityOf(world), h,
                             stepsUntilEnd(memory.contacts, time, h))) {
    return;
  }
  if (upright) {
    foresee(memory.expectation, state);
    motion = motionOf(state, memory.pulse, options.response.method, h);
    near = !exact || collectWalls(vehicle, state, motion, h);
  } else {
    vehicle.issues |= step_issue::tilted;
  }
  if (mayHaveEnded(memory.contacts, time)) endContacts(vehicle);
  if (!near && !delivering) {
    memory.expectation = {};
    memory.passages.clear();
    return;
  }
  if (!delivering) vehicle.memoryBefore = memory;
  if (exact) {
    leaveOutPassages(vehicle);
    if (!segments.empty()) answerCuts(vehicle, state, motion, h);
  } else if (near) {
    answerContacts(vehicle, state, motion, h);
  }
  give(vehicle, known, h);
  if (near && memory.delivery.any) {
    expect(known, memory.delivery.impulse, h, memory.expectation);
  } else {
    memory.expectation = {};
  }
}

void Responder::Implementation::stepAll(std::span<Vehicle* const> some, double h) {
  reconsiderLastStep(some);
  for (Vehicle* vehicle : some) {
    stepVehicle(*vehicle, h);
    issues |= vehicle->issues;
  }
}

std::span<const ImpactEvent> Responder::step(double h) {
  Implementation& self = *implementation_;
  self.events.clear();
  self.issues = step_issue::none;
  // Those that are not certainly away from all walls. One that is has nothing to say, and had
  // nothing to say before.
  Vehicle** last = self.active.data();
  for (const std::unique_ptr<Vehicle>& vehicle : self.vehicles) {
    if (vehicle != nullptr && !vehicle->freeSpace.holds(h)) *last++ = vehicle.get();
  }
  const std::span<Vehicle*> active(self.active.data(), last);
  for (Vehicle* vehicle : active) vehicle->issues = step_issue::none;
  if (!(h > 0.0 && h < std::numeric_limits<double>::infinity())) {
    if (h != 0.0) self.issues = step_issue::invalid_step;
    return {};
  }
  if (!active.empty()) self.stepAll(active, h);
  self.time += h;
  self.lastStep = h;
  return self.events;
}

}  // namespace bumper
