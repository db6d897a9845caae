#include "guard_contacts.h"

#include <algorithm>
#include <cmath>

#include "ode_vectors.h"

namespace bumper {

namespace {

// Soft enough for a solver of redundant contacts, whatever the world's own is: 200 kN yields by
// 0.02 mm/s.
constexpr double constraintForceMixing = 1e-10;

// Less friction than this is taken as none: constraint rows without effect are a problem for
// dWorldStep.
constexpr double leastFriction = 1e-3;

// When two corners reach a wall at exactly the same time, dWorldStep's solver fails and drops all
// forces of the step. So no two speed limits are exactly equal, m/s.
constexpr double mostDither = 1e-7;

// In [0, 1), another for each step and each guard: the multiples of these two spread evenly, also
// where steps are a round number of milliseconds.
double dither(double time, std::size_t number) {
  constexpr double eachSecond = 7548.776662466927;
  constexpr double eachGuard = 0.6180339887498949;
  const double turns = eachSecond * time + eachGuard * static_cast<double>(number);
  return turns - std::floor(turns);
}

bool anyOuterJoint(const VehicleBodies& bodies, auto&& counts) {
  const std::span<const dBodyID> own = bodies.all();
  return std::any_of(own.begin(), own.end(), [&](dBodyID body) {
    const int count = dBodyGetNumJoints(body);
    for (int i = 0; i < count; ++i) {
      const dJointID joint = dBodyGetJoint(body, i);
      if (dJointIsEnabled(joint) == 0) continue;
      const dBodyID first = dJointGetBody(joint, 0);
      const dBodyID other = first == body ? dJointGetBody(joint, 1) : first;
      if (std::find(own.begin(), own.end(), other) == own.end() && counts(other)) return true;
    }
    return false;
  });
}

}  // namespace

bool hasOuterJoint(const VehicleBodies& bodies) {
  return anyOuterJoint(bodies, [](dBodyID) { return true; });
}

bool hasJointWithBody(const VehicleBodies& bodies) {
  return anyOuterJoint(bodies, [](dBodyID other) { return other != nullptr; });
}

void GuardContacts::add(const Guard& guard, dJointGroupID group, dBodyID chassis,
                        const VehicleState& state, const Step& step) {
  if (count_ == loads_.size()) return;
  GuardLoad& load = loads_[count_];
  load.with = {.barrier = guard.barrier};
  load.wall = guard.wall;
  load.arm = state.toWorld(guard.contact.arm);
  load.contact = state.massCentre + load.arm;
  // In the yaw plane of a vehicle that leans the normal points up or down, and would lift it.
  const Eigen::Vector3d inYawPlane = state.toWorld(guard.contact.normal);
  load.normal = Eigen::Vector3d(inYawPlane.x(), inYawPlane.y(), 0.0).normalized();
  load.velocity = state.velocityAt(load.arm);
  const Eigen::Vector3d unpushed =
      state.toWorld(guard.contact.velocity) + state.up().dot(state.velocity) * state.up();
  const double room = guard.contact.room / load.normal.dot(inYawPlane);
  const double leastSpeed = load.normal.dot(unpushed) - room / step.size;
  attach({.leastSpeed = leastSpeed, .friction = guard.friction}, group, chassis, step);
}

void GuardContacts::add(const PairGuard& guard, dJointGroupID group, dBodyID chassis,
                        const Step& step) {
  if (count_ == loads_.size()) return;
  GuardLoad& load = loads_[count_];
  load.with = {.vehicle = guard.other};
  load.wall = 0;
  load.arm = guard.arm;
  load.contact = guard.place;
  load.normal = guard.normal;
  load.velocity = guard.velocity;
  attach({.other = guard.chassis,
          .leastSpeed = guard.normal.dot(guard.velocity) - guard.room / step.size,
          .friction = guard.friction},
         group, chassis, step);
}

// Makes the joint of the next load.
void GuardContacts::attach(const Constraint& constraint, dJointGroupID group, dBodyID chassis,
                           const Step& step) {
  GuardLoad& load = loads_[count_];
  load.force.setZero();
  dContact contact{};
  contact.surface.mode = dContactMotionN | dContactSoftERP | dContactSoftCFM | dContactApprox1;
  contact.surface.soft_erp = 0.0;
  contact.surface.soft_cfm = constraintForceMixing;
  contact.surface.mu = constraint.friction >= leastFriction ? constraint.friction : 0.0;
  contact.surface.motionN =
      frame_.metre() * (constraint.leastSpeed - mostDither * dither(step.time, count_));
  const Eigen::Vector3d place = frame_.vectorInWorld(load.contact);
  const Eigen::Vector3d normal = frame_.directionInWorld(load.normal);
  for (int k = 0; k < 3; ++k) {
    contact.geom.pos[k] = place[k];
    contact.geom.normal[k] = normal[k];
  }
  // The axes of friction, level and upright: what ODE takes where z is up.
  if (!frame_.isUsual()) {
    contact.surface.mode |= dContactFDir1;
    const Eigen::Vector3d level =
        frame_.directionInWorld(Eigen::Vector3d::UnitZ().cross(load.normal).normalized());
    for (int k = 0; k < 3; ++k) contact.fdir1[k] = level[k];
  }
  const dJointID joint = dJointCreateContact(dBodyGetWorld(chassis), group, &contact);
  dJointAttach(joint, chassis, constraint.other);
  feedback_[count_] = {};
  dJointSetFeedback(joint, &feedback_[count_]);
  joints_[count_++] = joint;
}

std::span<GuardLoad> GuardContacts::loads() {
  for (std::size_t i = 0; i < count_; ++i) {
    loads_[i].force = frame_.vector(toVector(feedback_[i].f1));
  }
  return {loads_.data(), count_};
}

void GuardContacts::setLoads(std::span<const GuardLoad> loads) {
  count_ = std::min(loads.size(), loads_.size());
  std::copy_n(loads.begin(), count_, loads_.begin());
  for (std::size_t i = 0; i < count_; ++i) {
    const Eigen::Vector3d force = frame_.vectorInWorld(loads_[i].force);
    for (int k = 0; k < 3; ++k) feedback_[i].f1[k] = force[k];
    joints_[i] = nullptr;
  }
}

void GuardContacts::release() {
  for (std::size_t i = 0; i < count_; ++i) {
    if (joints_[i] != nullptr) dJointSetFeedback(joints_[i], nullptr);
  }
  forget();
}

}  // namespace bumper
