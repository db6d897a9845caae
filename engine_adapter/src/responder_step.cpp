#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ode_vectors.h"
#include "pulse_delivery.h"
#include "responder_implementation.h"
#include "sustained_contacts.h"

namespace bumper {

namespace {

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

// What acts on a vehicle in no impact besides the forces that are known before a step, at most:
// tyres, motors.
constexpr double ordinaryAcceleration = 15.0;     // m/s²
constexpr double ordinaryYawAcceleration = 15.0;  // rad/s²

// A point that is no further from its wall than this, m, slides along it in the step.
constexpr double slidingGap = 1e-3;

// What the coming step should do by the known forces and the impulse that is given.
void expect(const VehicleState& known, const PlanarImpulse& impulse, double h,
            Expectation& expected) {
  expected.step = h;
  expected.velocity =
      known.velocity + h * known.acceleration + known.toWorld(impulse.linear) / known.mass;
  expected.yawRate = known.yawRate + h * known.yawAcceleration + impulse.angular / known.yawInertia;
}

// Takes out of what is pending what joints have done of it already.
void reconcile(const Expectation& expected, const VehicleState& state, ForcePulse& pulse) {
  if (expected.step <= 0.0) return;
  const Vector2 surplus = (state.axes.transpose() * (state.velocity - expected.velocity)).head<2>();
  pulse.reconcile({.linear = state.mass * surplus,
                   .angular = state.yawInertia * (state.yawRate - expected.yawRate)},
                  {.linear = expected.step * ordinaryAcceleration * state.mass,
                   .angular = expected.step * ordinaryYawAcceleration * state.yawInertia},
                  state.mass, state.yawInertia);
}

double gravityOf(dWorldID world) {
  dVector3 gravity;
  dWorldGetGravity(world, gravity);
  return toVector(gravity).norm();
}

bool hasForce(dBodyID body) { return !toVector(dBodyGetForce(body)).isZero(0.0); }

// Where the vehicle's forward axis points now in the yaw plane that it had before, unit.
Vector2 aheadSince(const Eigen::Matrix3d& before, const Eigen::Matrix3d& now) {
  return (before.transpose() * now.col(0)).head<2>().normalized();
}

}  // namespace

// Puts right what the world's last step did not do as it was told.
void Responder::Implementation::reconsiderLastStep(std::span<Vehicle* const> some) {
  bool repeated = false;
  const bool known = clock && clock->isRunning();
  for (Vehicle* each : some) {
    if (!each->memory.delivery.any) continue;
    Vehicle& vehicle = *each;
    VehicleMemory& memory = vehicle.memory;
    const WorldSteps steps =
        known ? clock->read()
              : WorldSteps{.total = memory.delivery.step, .first = memory.delivery.step};
    switch (lookBack(memory.delivery, vehicle.bodies, steps)) {
      case LastStep::as_told:
        break;
      case LastStep::not_taken:
        takeBack(vehicle.bodies, options.delivery, memory.delivery);
        memory = vehicle.memoryBefore;
        vehicle.issues |= step_issue::repeated_step;
        repeated = true;
        break;
      case LastStep::other_size: {
        const double missing = 1.0 - steps.first / memory.delivery.step;
        if (options.delivery == Delivery::force_pulse) {
          const PlanarImpulse owed{.linear = missing * memory.delivery.impulse.linear,
                                   .angular = missing * memory.delivery.impulse.angular};
          const VehicleState state = vehicle.bodies.read();
          memory.pulse.owe(owed);
          memory.expectation.velocity -=
              memory.delivery.axes.leftCols<2>() * owed.linear / state.mass;
          memory.expectation.yawRate -= owed.angular / state.yawInertia;
        }
        vehicle.issues |= step_issue::other_step_size;
        break;
      }
      case LastStep::moved_since:
        // A force waits for the world's step, unless it was cleared with the rest; a change of
        // velocity has been overwritten.
        if (!(steps.total > 0.0) && options.delivery == Delivery::force_pulse &&
            hasForce(vehicle.bodies.chassis())) {
          takeBack(vehicle.bodies, options.delivery, memory.delivery);
        }
        memory.pulse.drop();
        memory.expectation = {};
        vehicle.issues |= step_issue::moved;
        break;
    }
    memory.delivery.any = false;
  }
  if (clock) clock->stop();
  if (repeated) time -= lastStep;
}

// Walls that broke are left out until the outline has left them; those whose long force pulse runs
// are not answered until it ends.
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
    if (goesOn && passage.until > 0.0) {
      for (WallSegment& wall : segments) {
        if (!isOfIt(wall)) continue;
        wall.entered = true;
        wall.depth = std::max(wall.depth, passage.depth);
      }
    } else if (goesOn) {
      std::erase_if(segments, isOfIt);
    }
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

// Those that matter are in `segments`.
void Responder::Implementation::collectWalls(Vehicle& vehicle, const VehicleState& state,
                                             const PlanarMotion& motion, bool guarded, double h) {
  if (!options.skipping) vehicle.nearby.forget();
  const VehicleMemory& memory = vehicle.memory;
  const VehicleParameters parameters = withMassOf(vehicle.parameters, state);
  NearbyWalls::Question question{
      .around = vehicle.query.swept(motion, h),
      .reach = CollisionStep::reach(parameters, motion, longestPenetrationTime, h),
      .evenIfNoneIsThere =
          !options.skipping || mayHaveEnded(memory.contacts, time) || !memory.passages.empty()};
  if (guarded) {
    const double near = nearDistance(motion.velocity.norm(), h);
    question.around = hull(question.around, vehicle.query.outline().enlarged(near));
    question.reach = std::max(question.reach, near);
  }
  vehicle.nearby.collect(vehicle.query, barriers, state, question, segments);
}

// For the walls in `segments`, after their impacts have been found; `after` as these leave it.
void Responder::Implementation::addGuards(Vehicle& vehicle, const VehicleState& state,
                                          const PlanarMotion& motion, const PlanarMotion& after,
                                          double h) {
  // What is near at the step's end was near at its start, so that it does not matter whether what
  // is further away was looked at.
  const double speed = motion.velocity.norm();
  const double way = h * (speed + std::abs(motion.yawRate) * vehicle.query.outline().radius());
  const double near = nearDistance(speed, h);
  const double distance = std::max(near - way, 0.5 * near);
  for (const SpeculativeContact& contact :
       collision.speculativeContacts(motion, after, distance, h)) {
    const BarrierWall hit = vehicle.nearby.at(contact.wall);
    const ResponseSettings& settings = *contact.settings;
    const bool slides =
        contact.gap <= slidingGap && settings.frictionKind == Friction::Kind::coulomb;
    const Impact impact{.normal = contact.normal, .arm = contact.arm};
    vehicle.guards.add(
        {.contact = contact,
         .barrier = hit.barrier->id(),
         .wall = hit.wall,
         .friction =
             slides ? settings.friction(attackDirection(impact, motion, settings.angle)) : 0.0},
        guardJoints.get(), vehicle.bodies.chassis(), state, {.time = time, .size = h});
    hasGuards = true;
  }
}

PlanarMotion Responder::Implementation::answerCuts(Vehicle& vehicle, const VehicleState& state,
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
          {.barrier = barrier.id(),
           .settings = number,
           .until = time + each.time + contactTime,
           .depth = enteredDepth(each.response.approachSpeed, contactTime)});
    } else {
      pulse.add(each.response.impulse, each.time, h);
    }
    if (each.response.brokeThrough) {
      vehicle.memory.passages.push_back({.barrier = barrier.id(), .settings = number});
    }
    report(vehicle, state, barrier, wall, each);
  }
  return outcome.after;
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
  const Expectation expected = std::exchange(memory.expectation, {});
  if (vehicle.bodies.areAsleep() && !hasJointWithBody(vehicle.bodies)) {
    vehicle.guards.forget();
    return;
  }
  const VehicleState state = vehicle.bodies.read();
  const bool isMoved = vehicle.bodies.anyKinematic();
  if (isMoved || !state.isFinite()) {
    vehicle.issues |= isMoved ? step_issue::kinematic : step_issue::not_finite;
    memory.pulse.drop();
    vehicle.guards.forget();
    return;
  }
  if (!memory.pulse.isEmpty()) {
    vehicle.memoryBefore = memory;
    memory.pulse.turnFrame(aheadSince(memory.delivery.axes, state.axes));
    reconcile(expected, state, memory.pulse);
  }
  const bool delivering = !memory.pulse.isEmpty();
  reportLoads(vehicle, state);
  const bool upright = vehicle.isUpright();
  const bool exact = options.contactSource == ContactSource::exact_cut;
  segments.clear();
  const bool remembersWalls =
      delivering || mayHaveEnded(memory.contacts, time) || !memory.passages.empty();
  if (exact && upright && options.skipping && !remembersWalls &&
      vehicle.freeSpace.find(barriers, state, gravityOf(world), h,
                             stepsUntilEnd(memory.contacts, time, h))) {
    return;
  }
  PlanarMotion motion;
  bool isHeld = false;  // joints act on it too
  if (upright) {
    motion = motionOf(state, memory.pulse, options.response.method, h);
    if (exact) {
      isHeld = hasOuterJoint(vehicle.bodies);
      collectWalls(vehicle, state, motion, isHeld && options.guardContacts, h);
    }
  } else {
    vehicle.issues |= step_issue::tilted;
  }
  if (mayHaveEnded(memory.contacts, time)) endContacts(vehicle);
  if (!delivering) vehicle.memoryBefore = memory;
  leaveOutPassages(vehicle);
  if (!exact && upright) answerContacts(vehicle, state, motion, h);
  if (!segments.empty()) {
    const PlanarMotion after = answerCuts(vehicle, state, motion, h);
    if (isHeld && options.guardContacts) addGuards(vehicle, state, motion, after, h);
  }
  // With guards alone the world's step is watched as well.
  if (memory.pulse.isEmpty() && vehicle.guards.isEmpty()) return;
  give(vehicle, state, h);
  if (isHeld && memory.delivery.any) {
    expect(state, memory.delivery.impulse, h, memory.expectation);
  }
}

void Responder::Implementation::stepAll(std::span<Vehicle* const> some, double h) {
  reconsiderLastStep(some);
  for (Vehicle* vehicle : some) {
    stepVehicle(*vehicle, h);
    issues |= vehicle->issues;
  }
  const bool isTold = std::any_of(some.begin(), some.end(), [](const Vehicle* vehicle) {
    return vehicle->memory.delivery.any;
  });
  if (clock && isTold) clock->start();
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
  if (self.hasGuards) {
    dJointGroupEmpty(self.guardJoints.get());
    self.hasGuards = false;
  }
  if (!active.empty()) self.stepAll(active, h);
  self.time += h;
  self.lastStep = h;
  return self.events;
}

}  // namespace bumper
