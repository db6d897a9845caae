#include <algorithm>
#include <cmath>

#include "responder_implementation.h"

namespace bumper {

namespace {

// The vehicle in its own frame, with the velocity that it would have at the step's end without
// walls; the paper takes the velocity as it is.
PlanarMotion motionOf(const VehicleState& state, Method method, double h) {
  const double ahead = method == Method::paper ? 0.0 : h;
  const Eigen::Vector3d velocity = state.velocity + ahead * state.acceleration;
  PlanarMotion motion;
  motion.velocity = (state.axes.transpose() * velocity).head<2>();
  motion.yawRate = state.yawRate + ahead * state.yawAcceleration;
  return motion;
}

// What the law works with: the outline as given, mass and inertia as the bodies have them now.
VehicleParameters withMassOf(VehicleParameters parameters, const VehicleState& state) {
  parameters.mass = state.mass;
  parameters.yawInertia = state.yawInertia;
  return parameters;
}

}  // namespace

void UnknownForces::foresee(VehicleState& state) const {
  // More than tyres can do was a blow or a teleport, and is over.
  constexpr double mostAcceleration = 15.0;     // m/s²
  constexpr double mostYawAcceleration = 15.0;  // rad/s²
  if (step_ <= 0.0) return;
  const Eigen::Vector3d acceleration = (state.velocity - velocity_) / step_;
  const double yawAcceleration = (state.yawRate - yawRate_) / step_;
  if (acceleration.norm() > mostAcceleration || std::abs(yawAcceleration) > mostYawAcceleration) {
    return;
  }
  state.acceleration += acceleration;
  state.yawAcceleration += yawAcceleration;
}

void UnknownForces::expect(const VehicleState& known, const PlanarImpulse& impulse, double h) {
  velocity_ = known.velocity + h * known.acceleration + known.toWorld(impulse.linear) / known.mass;
  yawRate_ = known.yawRate + h * known.yawAcceleration + impulse.angular / known.yawInertia;
  step_ = h;
}

void Responder::Implementation::report(const Vehicle& vehicle, const VehicleState& state,
                                       const Barrier& barrier, int wall, const Impact& impact,
                                       const ImpactResponse& response) {
  if (response.approachSpeed <= barrier.settings->restSpeed) return;
  ImpactEvent event;
  event.time = time;
  event.vehicle = vehicle.name;
  event.barrier = barrier.mesh.name();
  event.triangle = barrier.mesh.walls()[static_cast<std::size_t>(wall)].triangle;
  event.material = barrier.mesh.materialOf(wall);
  event.contact = state.massCentre + state.toWorld(impact.point);
  event.normal = state.toWorld(impact.normal);
  event.arm = impact.arm;
  event.law = response.law;
  event.angles = response.angles;
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
  event.outcome = response.outcome;
  event.regime = response.contact.regime;
  events.push_back(event);
}

// A barrier that the vehicle breaks through is ignored until the outline has left it.
void Responder::Implementation::appendSegments(Vehicle& vehicle, const VehicleState& state,
                                               double reach, const Barrier& barrier, int firstId) {
  const std::size_t before = segments.size();
  vehicle.query.append(barrier.mesh, state, reach, *barrier.settings, firstId, segments);
  std::vector<const Barrier*>& broken = vehicle.brokenThrough;
  const auto mark = std::find(broken.begin(), broken.end(), &barrier);
  if (mark == broken.end()) return;
  const auto first = segments.begin() + static_cast<std::ptrdiff_t>(before);
  const bool inside = std::any_of(first, segments.end(), [&](const WallSegment& wall) {
    return findOverlap(vehicle.query.outline(), Vector2::Zero(), 0.0, wall).has_value();
  });
  if (inside) {
    segments.resize(before);
  } else {
    broken.erase(mark);
  }
}

PlanarImpulse Responder::Implementation::impulseOfCuts(Vehicle& vehicle, const VehicleState& state,
                                                       double h) {
  const PlanarMotion motion = motionOf(state, options.response.method, h);
  const double speed = motion.velocity.norm() + std::abs(motion.yawRate) * vehicle.query.radius();
  segments.clear();
  firstIds.clear();
  int nextId = 0;
  for (const std::unique_ptr<Barrier>& barrier : barriers) {
    firstIds.push_back(nextId);
    if (barrier == nullptr) continue;
    appendSegments(vehicle, state, speed * barrier->settings->penetrationTime, *barrier, nextId);
    nextId += static_cast<int>(barrier->mesh.walls().size());
  }
  if (segments.empty()) return {};

  const StepOutcome outcome = collision.resolve(
      withMassOf(vehicle.parameters, state), motionOf(state, options.response.method, h), segments);
  if (!outcome.settled) vehicle.issues |= step_issue::unsettled;
  for (const StepImpact& each : outcome.impacts) {
    // The last barrier that starts at or before the wall's number, and is still there.
    std::size_t owner = firstIds.size() - 1;
    while (firstIds[owner] > each.impact.wall || barriers[owner] == nullptr) --owner;
    report(vehicle, state, *barriers[owner], each.impact.wall - firstIds[owner], each.impact,
           each.response);
    if (each.response.brokeThrough) vehicle.brokenThrough.push_back(barriers[owner].get());
  }
  return outcome.impulse;
}

PlanarImpulse Responder::Implementation::impulseOfContacts(Vehicle& vehicle,
                                                           const VehicleState& state, double h) {
  PlanarImpulse sum;
  PlanarMotion motion = motionOf(state, options.response.method, h);
  for (const std::unique_ptr<Barrier>& barrier : barriers) {
    if (barrier == nullptr) continue;
    const std::optional<Impact> impact = vehicle.query.meanOfContacts(barrier->mesh, state);
    if (!impact || -velocityAt(motion, impact->arm).dot(impact->normal) <= 0.0) continue;
    const ImpactResponse response =
        respond(*impact, motion, state.mass, state.yawInertia, *barrier->settings);
    report(vehicle, state, *barrier, impact->wall, *impact, response);
    sum += response.impulse;
    motion = response.after;
  }
  return sum;
}

void Responder::Implementation::stepVehicle(Vehicle& vehicle, double h) {
  if (vehicle.bodies.areAsleep()) {
    vehicle.unknown.forget();
    return;
  }
  const VehicleState known = vehicle.bodies.read();
  if (!known.isFinite()) {
    vehicle.issues |= step_issue::not_finite;
    vehicle.unknown.forget();
    return;
  }
  if (!vehicle.isUpright()) {
    vehicle.issues |= step_issue::tilted;
    vehicle.unknown.forget();
    return;
  }
  VehicleState state = known;
  vehicle.unknown.foresee(state);
  const PlanarImpulse impulse = options.contactSource == ContactSource::exact_cut
                                    ? impulseOfCuts(vehicle, state, h)
                                    : impulseOfContacts(vehicle, state, h);
  vehicle.unknown.expect(known, impulse, h);
  if (impulse.linear.isZero(0.0) && impulse.angular == 0.0) return;

  // The whole pulse lies in this step, because an impact is noticed when a step begins.
  ForcePulse pulse;
  pulse.add(impulse, 0.0, h);
  const PlanarForce force = pulse.take(h);
  if (!force.force.allFinite() || !std::isfinite(force.yawMoment)) {
    vehicle.issues |= step_issue::not_finite;
    return;
  }
  vehicle.bodies.push(state, force);
}

std::span<const ImpactEvent> Responder::step(double h) {
  Implementation& self = *implementation_;
  self.events.clear();
  self.issues = step_issue::none;
  for (const std::unique_ptr<Vehicle>& vehicle : self.vehicles) {
    if (vehicle != nullptr) vehicle->issues = step_issue::none;
  }
  if (!std::isfinite(h) || h < 0.0) {
    self.issues = step_issue::invalid_step;
    return {};
  }
  if (h == 0.0) return {};
  for (const std::unique_ptr<Vehicle>& vehicle : self.vehicles) {
    if (vehicle == nullptr) continue;
    self.stepVehicle(*vehicle, h);
    self.issues |= vehicle->issues;
  }
  self.time += h;
  return self.events;
}

}  // namespace bumper
