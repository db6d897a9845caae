// One step, in three passes over the vehicles that may touch something: all are read, islands are
// solved, and the impulses are delivered. No force is added before all vehicles have been read.
// An island is one vehicle among fixed walls, or several that may hit each other.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "expectation.h"
#include "ode_vectors.h"
#include "pulse_delivery.h"
#include "responder_implementation.h"
#include "sustained_contacts.h"

namespace bumper {

namespace {

// The vehicle in its own frame, with the velocity that it has in this step without walls: ODE moves
// it with the velocity that the forces lead to. The paper takes the velocity as it is, and so does
// what the application moves.
PlanarMotion motionOf(const Vehicle& vehicle, Method method, double h) {
  const VehicleState& state = vehicle.reading.state;
  if (vehicle.reading.isAsleep) return {};
  const bool asItIs = method == Method::paper || vehicle.mover != Mover::world;
  const double ahead = asItIs ? 0.0 : h;
  const PlanarImpulse due = vehicle.memory.pulse.due(h);
  const Eigen::Vector3d velocity = state.velocity + ahead * state.acceleration;
  PlanarMotion motion;
  motion.velocity = (state.axes.transpose() * velocity).head<2>() + due.linear / state.mass;
  motion.yawRate = state.yawRate + ahead * state.yawAcceleration + due.angular / state.yawInertia;
  return motion;
}

double gravityOf(dWorldID world, const WorldFrame& frame) {
  dVector3 gravity;
  dWorldGetGravity(world, gravity);
  return frame.vector(toVector(gravity)).norm();
}

// Where the vehicle's forward axis points now in the yaw plane that it had before, unit.
Vector2 aheadSince(const Eigen::Matrix3d& before, const Eigen::Matrix3d& now) {
  return (before.transpose() * now.col(0)).head<2>().normalized();
}

// They come vehicle by vehicle, those of pairs last. What was in order stays so.
void sortByTime(std::vector<ImpactEvent>& events) {
  const auto isBefore = [](double time, const ImpactEvent& event) { return time < event.time; };
  for (auto next = events.begin(); next != events.end(); ++next) {
    std::rotate(std::upper_bound(events.begin(), next, next->time, isBefore), next, next + 1);
  }
}

}  // namespace

std::span<const ImpactEvent> Responder::step(double h) {
  Implementation& self = *implementation_;
  self.events.clear();
  self.issues = step_issue::none;
  // Those that are not certainly away from all walls and other vehicles. One that is has no event,
  // and had none before.
  const bool hasPairs = self.hasPairs();
  self.activeCount = 0;
  if (self.anyCopied) self.refreshCopies();
  const bool anyMoving = !self.movingBarriers.empty();
  if (anyMoving) self.readMovingBarriers();
  for (const std::unique_ptr<Vehicle>& vehicle : self.vehicles) {
    vehicle->isFar = vehicle->mover != Mover::world || vehicle->freeSpace.holds(h);
    vehicle->isAlone = !hasPairs || Traffic::isApart(vehicle->traveller, self.time, h);
    const bool mayBeHit = anyMoving && self.mayMeetMovingBarrier(*vehicle, h);
    vehicle->isActive = !vehicle->isFar || !vehicle->isAlone || mayBeHit;
    if (vehicle->isActive) self.active[self.activeCount++] = vehicle.get();
  }
  for (Vehicle* vehicle : self.activeNow()) {
    vehicle->issues = step_issue::none;
    vehicle->hasCompany = false;
  }
  if (!(h > 0.0 && h < std::numeric_limits<double>::infinity())) {
    if (h != 0.0) self.issues = step_issue::invalid_step;
    return {};
  }
  if (self.hasGuards) {
    dJointGroupEmpty(self.guardJoints.get());
    self.hasGuards = false;
  }
  if (hasPairs) self.findCompany(h);
  if (self.activeCount > 0) self.stepAll(self.activeNow(), h);
  if (!self.worldFrame.isUsual()) self.tellInWorld();
  self.time += h;
  self.lastStep = h;
  sortByTime(self.events);
  return self.events;
}

void Responder::Implementation::refreshCopies() const {
  for (const std::unique_ptr<Vehicle>& vehicle : vehicles) {
    if (vehicle->bodies.areCopied()) vehicle->bodies.refresh();
  }
}

void Responder::Implementation::tellInWorld() {
  for (ImpactEvent& event : events) event = worldFrame.eventInWorld(event);
}

void Responder::Implementation::stepAll(std::span<Vehicle* const> some, double h) {
  checkLastStep(some);
  for (Vehicle* vehicle : some) read(*vehicle, h);
  findIslands(h);
  for (Vehicle* vehicle : some) {
    if (vehicle->reading.takesPart && vehicle->island < 0) solve(*vehicle, h);
  }
  solveIslands(h);
  bool anyDelivered = false;
  for (Vehicle* vehicle : some) {
    if (vehicle->reading.takesPart) deliver(*vehicle, h);
    anyDelivered |= vehicle->memory.delivery.any;
    issues |= vehicle->issues;
  }
  if (clock && anyDelivered) clock->start();
}

// Reads a vehicle's bodies, reconciles the last step's pulse, and finds the walls near it.
void Responder::Implementation::read(Vehicle& vehicle, double h) {
  VehicleMemory& memory = vehicle.memory;
  vehicle.reading.takesPart = false;
  if (!vehicle.isFar) vehicle.freeSpace.leave();
  const Expectation expected = std::exchange(memory.expectation, {});
  vehicle.reading.isAsleep = vehicle.mover == Mover::world && vehicle.bodies.areAsleep() &&
                             !hasJointWithBody(vehicle.bodies);
  const bool mayBeHit = vehicle.barrierSpeed >= 0.0;
  if (vehicle.reading.isAsleep && !vehicle.hasCompany && !mayBeHit) {
    vehicle.guards.forget();
    return;
  }
  const VehicleState& state = vehicle.reading.state = vehicle.bodies.read();
  const bool isKinematic = vehicle.mover == Mover::world && vehicle.bodies.anyKinematic();
  if (isKinematic || !state.isFinite()) {
    vehicle.issues |= isKinematic ? step_issue::kinematic : step_issue::not_finite;
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
  reportLoads(vehicle);

  const bool isUpright = vehicle.isUpright();
  const bool remembersWalls =
      delivering || mayHaveEnded(memory.contacts, time) || !memory.passable.empty();
  if (isUpright && options.skipping && !remembersWalls && !vehicle.isFar) {
    vehicle.isFar = vehicle.freeSpace.find(barriers, state, gravityOf(world, worldFrame), h,
                                           stepsUntilEnd(memory.contacts, time, h));
  }
  if (vehicle.isFar && !vehicle.hasCompany && !mayBeHit) return;
  vehicle.reading.takesPart = true;
  vehicle.reading.isHeld =
      isUpright && vehicle.mover == Mover::world && hasOuterJoint(vehicle.bodies);
  if (isUpright) {
    vehicle.reading.motion = motionOf(vehicle, options.response.method, h);
    // One that is far by its own motion may be thrown against a wall.
    if (vehicle.mover == Mover::world) collectWalls(vehicle, h);
  } else {
    vehicle.issues |= step_issue::tilted;
    vehicle.nearby.clear();
  }
  if (mayHaveEnded(memory.contacts, time)) reportEndedContacts(vehicle);
  if (!delivering) vehicle.memoryBefore = memory;
  applyPassableWalls(vehicle);
}

void Responder::Implementation::readMovingBarriers() {
  for (Barrier* barrier : movingBarriers) barrier->frame().read(time);
}

bool Responder::Implementation::mayMeetMovingBarrier(Vehicle& vehicle, double h) const {
  vehicle.barrierSpeed = -1.0;
  if (vehicle.mover != Mover::world) return false;
  const BodyNumbers& chassis = vehicle.bodies.numbers().front();
  const Eigen::Vector3d place = toVector(chassis.position);
  const double radius = vehicle.traveller.radius + vehicle.envelope.radius();
  const double own = toVector(chassis.velocity).norm() + toVector(chassis.turning).norm() * radius;
  for (const Barrier* barrier : movingBarriers) {
    const BarrierFrame& frame = barrier->frame();
    const double speed = frame.fastestWithin(place, radius);
    // Thrown by it, too; beyond that a wall has no guards.
    const double reach = radius + (h + longestPenetrationTime) * (own + 3.0 * speed) +
                         2.0 * guardDistance(std::max(own, speed), h);
    if (!barrier->mayComeWithin(frame.toFrame(place), reach)) continue;
    vehicle.barrierSpeed = std::max(vehicle.barrierSpeed, speed);
  }
  return vehicle.barrierSpeed >= 0.0;
}

void Responder::Implementation::collectWalls(Vehicle& vehicle, double h) {
  if (!options.skipping) vehicle.nearby.forget();
  const VehicleMemory& memory = vehicle.memory;
  const PlanarMotion& motion = vehicle.reading.motion;
  NearbyWalls::Question question{
      .around = vehicle.envelope.swept(motion, h),
      .reach = CollisionStep::reach(vehicle.parametersNow(), motion, longestPenetrationTime, h),
      .evenIfNoneIsThere =
          !options.skipping || mayHaveEnded(memory.contacts, time) || !memory.passable.empty()};
  if (vehicle.hasCompany || (vehicle.reading.isHeld && options.guardContacts)) {
    const double own = motion.velocity.norm();
    const double speed = vehicle.hasCompany ? std::max(own, vehicle.traveller.companySpeed) : own;
    const double near = guardDistance(speed, h);
    question.around = hull(question.around, vehicle.envelope.outline().enlarged(near));
    question.reach = std::max(question.reach, near);
  }
  const bool mayBeHit = vehicle.barrierSpeed >= 0.0;
  if (mayBeHit) {
    // As a barrier that moves sees it; hit by that it may be thrown.
    PlanRectangle swept = vehicle.envelope.swept(motion, h);
    swept.half.array() += h * vehicle.barrierSpeed;
    question.around = hull(question.around, swept);
    question.reach += 3.0 * vehicle.barrierSpeed * (h + longestPenetrationTime);
  }
  const BarrierList list{
      .all = barriers,
      .moving = mayBeHit ? std::span<Barrier* const>(movingBarriers) : std::span<Barrier* const>()};
  vehicle.nearby.collect(vehicle.envelope, list, vehicle.reading.state, question);
}

// Adds the walls' impulses on a vehicle to its force pulse and to the events.
void Responder::Implementation::solve(Vehicle& vehicle, double h) {
  const CollisionStep::Walls walls = vehicle.nearby.all();
  if (walls.segments.empty()) return;
  if (vehicle.reading.isAsleep && vehicle.barrierSpeed < 0.0) return;
  const StepOutcome outcome =
      collision.resolve(vehicle.parametersNow(), vehicle.reading.motion, walls, h);
  if (vehicle.reading.isAsleep && outcome.impacts.empty()) return;
  applyOutcome(vehicle, outcome, h);
  if (vehicle.reading.isHeld && options.guardContacts) {
    addGuards(vehicle,
              collision.speculativeContacts(vehicle.reading.motion, outcome.after,
                                            guardedDistance(vehicle, h), h),
              h);
  }
}

// … and what they did to it in an island.
void Responder::Implementation::applyOutcome(Vehicle& vehicle, const StepOutcome& outcome,
                                             double h) {
  if (!outcome.settled) vehicle.issues |= step_issue::unsettled;
  const VehicleState& state = vehicle.reading.state;
  ForcePulse& pulse = vehicle.memory.pulse;
  pulse.shift({.linear = state.mass * outcome.shift.velocity,
               .angular = state.yawInertia * outcome.shift.yawRate});
  for (const StepImpact& each : outcome.impacts) {
    const BarrierWall hit = vehicle.nearby.at(each.impact.wall);
    const Barrier& barrier = *hit.barrier;
    const int number = barrier.settingsNumberOf(hit.wall);
    const double contactTime = barrier.settings(number).contactTime;
    PassableWall passable{
        .barrier = barrier.id(),
        .settings = number,
        .place = barrier.frame().toFrame(state.massCentre + state.toWorld(each.impact.point)),
        .normal = barrier.frame().directionToFrame(state.toWorld(each.impact.normal))};
    // What presses steadily is answered in each step, or it would sink in while pulses run.
    const bool presses =
        each.response.approachSpeed < impactInContact * barrier.settings(number).restSpeed;
    if (contactTime > 0.0 && !presses) {
      pulse.addLong(each.response.impulse, each.time, contactTime);
      passable.until = time + each.time + contactTime;
      passable.depth = enteredDepth(each.response.approachSpeed, contactTime);
      vehicle.memory.passable.push_back(passable);
    } else {
      pulse.add(each.response.impulse, each.time, h);
    }
    if (each.response.brokeThrough) {
      passable.until = passable.depth = 0.0;
      vehicle.memory.passable.push_back(passable);
    }
    if (barrier.frame().moves()) pushBack(barrier, vehicle, each, h);
    reportImpact(vehicle, barrier, hit.wall, each);
  }
}

// A barrier that forces move takes the opposite of an impulse.
void Responder::Implementation::pushBack(const Barrier& barrier, const Vehicle& vehicle,
                                         const StepImpact& each, double h) {
  dBodyID body = barrier.frame().body();
  if (body == nullptr || dBodyIsKinematic(body) != 0) return;
  const VehicleState& state = vehicle.reading.state;
  const WorldFrame& frame = vehicle.bodies.frame();
  const Eigen::Vector3d force =
      frame.vectorInWorld(state.toWorld(-each.response.impulse.linear) / h);
  const Eigen::Vector3d place =
      frame.vectorInWorld(state.massCentre + state.toWorld(each.impact.point));
  dBodyEnable(body);
  dBodyAddForceAtPos(body, force.x(), force.y(), force.z(), place.x(), place.y(), place.z());
}

// A wall near at the step's end was near at its start, so that those further away do not matter.
double Responder::Implementation::guardedDistance(const Vehicle& vehicle, double h) {
  const PlanarMotion& motion = vehicle.reading.motion;
  const double speed = motion.velocity.norm();
  const double way = h * (speed + std::abs(motion.yawRate) * vehicle.envelope.outline().radius());
  const double near = guardDistance(speed, h);
  return std::max(near - way, 0.5 * near);
}

void Responder::Implementation::addGuards(Vehicle& vehicle,
                                          std::span<const SpeculativeContact> contacts, double h) {
  const PlanarMotion& motion = vehicle.reading.motion;
  for (const SpeculativeContact& contact : contacts) {
    const BarrierWall hit = vehicle.nearby.at(contact.wall);
    const ResponseSettings& settings = vehicle.nearby.settingsOf(contact.surface);
    const bool slides =
        contact.gap <= slidingGap && settings.frictionKind == Friction::Kind::coulomb;
    const Impact impact{.normal = contact.normal, .arm = contact.arm};
    // Friction is that of the motion relative to the wall.
    PlanarMotion relative = motion;
    const BarrierFrame& frame = hit.barrier->frame();
    if (frame.moves()) {
      const PlanarMotion walls = frame.inYawPlane(vehicle.reading.state);
      relative.velocity -= velocityAt(walls, contact.arm - walls.position);
    }
    vehicle.guards.add(
        {.contact = contact,
         .barrier = hit.barrier->id(),
         .wall = hit.wall,
         .friction =
             slides ? settings.friction(attackDirection(impact, relative, settings.angle)) : 0.0},
        guardJoints.get(), vehicle.bodies.chassis(), vehicle.reading.state,
        {.time = time, .size = h});
    hasGuards = true;
  }
}

// Delivers the part of the force pulse in the coming step. With guards alone there is nothing to
// deliver, but the world's step is measured as well.
void Responder::Implementation::deliver(Vehicle& vehicle, double h) {
  VehicleMemory& memory = vehicle.memory;
  if (memory.pulse.isEmpty() && vehicle.guards.isEmpty()) return;
  const PlanarForce force = memory.pulse.take(h);
  // What is still pending is delivered in the next step, wherever it is then.
  if (!memory.pulse.isEmpty()) vehicle.freeSpace.leave();
  const PlanarImpulse impulse{.linear = h * force.force, .angular = h * force.yawMoment};
  if (!impulse.linear.allFinite() || !std::isfinite(impulse.angular)) {
    memory.pulse.drop();
    vehicle.issues |= step_issue::not_finite;
    return;
  }
  const VehicleState& state = vehicle.reading.state;
  bumper::deliver(vehicle.bodies, state, impulse, h, options.delivery, memory.delivery);
  if (vehicle.reading.isHeld) memory.expectation = expectationOf(state, impulse, h);
}

void Responder::Implementation::forgetSurroundings() {
  for (const std::unique_ptr<Vehicle>& vehicle : vehicles) {
    vehicle->freeSpace.forget();
    vehicle->nearby.forget();
    vehicle->barrierSpeed = -1.0;
    vehicle->traveller.forget();
  }
}

}  // namespace bumper
