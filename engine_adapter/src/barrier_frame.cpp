#include "barrier_frame.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "ode_vectors.h"

namespace bumper {

namespace {

// Moves in successive steps are as far apart as a step's size, within its rounding.
constexpr double sameTime = 1e-9;

bool isPlaceable(dGeomID geom) { return dGeomGetClass(geom) != dPlaneClass; }

}  // namespace

BarrierFrame::BarrierFrame(dGeomID geom, WorldFrame world)
    : world_(std::move(world)), body_(dGeomGetBody(geom)), moves_(body_ != nullptr) {
  if (!isPlaceable(geom)) return;
  place(geom);
  place_ = now_.position;
  axes_ = now_.axes;
  turn_.setIdentity();
}

void BarrierFrame::place(dGeomID geom) {
  place(body_ != nullptr ? dBodyGetPosition(body_) : dGeomGetPosition(geom),
        body_ != nullptr ? dBodyGetRotation(body_) : dGeomGetRotation(geom));
}

void BarrierFrame::place(const dReal* position, const dReal* rotation) {
  now_.position = world_.vector(toVector(position));
  now_.axes = world_.turn().ofColumns(toMatrix(rotation));
  turn_ = now_.axes * axes_.transpose();
}

void BarrierFrame::restore(const BarrierMotion& motion) {
  moves_ = true;
  now_ = motion;
  turn_ = now_.axes * axes_.transpose();
}

void BarrierFrame::stop() { now_ = {.position = now_.position, .axes = now_.axes}; }

void BarrierFrame::takeOver(const BarrierFrame& before) {
  if (before.body_ != body_) return;
  moves_ = before.moves_;
  now_ = before.now_;
  turn_ = now_.axes * axes_.transpose();
}

void BarrierFrame::follow(dGeomID geom, double time, double lastStep) {
  if (!isPlaceable(geom)) return;
  if (dGeomGetBody(geom) != body_) {
    // The walls stay where they are: from now on they move with another body, or by themselves.
    const Eigen::Vector3d origin = toWorld(Eigen::Vector3d::Zero());
    const Eigen::Matrix3d turned = turn_;
    body_ = dGeomGetBody(geom);
    moves_ = true;
    place(geom);
    axes_ = turned.transpose() * now_.axes;
    place_ = turned.transpose() * (now_.position - origin);
    turn_ = turned;
    now_.moves = 0;
  }
  if (body_ != nullptr) return;
  const BarrierMotion before = now_;
  place(geom);
  // Moved again before the same step it has the velocity since the step before.
  const bool again = before.moves > 0 && before.moved == time;
  const Eigen::Vector3d& from = again ? before.lastPosition : before.position;
  const Eigen::Matrix3d& fromAxes = again ? before.lastAxes : before.axes;
  const bool isElsewhere = now_.position != from || now_.axes != fromAxes;
  if (!isElsewhere && !moves_) return;
  moves_ = true;
  const bool follows =
      lastStep > 0.0 && std::abs(time - before.moved - lastStep) <= sameTime * (1.0 + time);
  if (!again) now_.moves = before.moves > 0 && follows ? before.moves + 1 : 1;
  now_.lastPosition = from;
  now_.lastAxes = fromAxes;
  now_.moved = time;
  now_.velocity.setZero();
  now_.turning.setZero();
  if (now_.moves < 2) return;
  now_.velocity = (now_.position - from) / lastStep;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(now_.axes * fromAxes.transpose()));
  now_.turning = turn.angle() / lastStep * turn.axis();
}

void BarrierFrame::setVelocity(const BarrierVelocity& velocity, double time) {
  moves_ = true;
  now_.moved = time;
  now_.velocity = world_.vector(velocity.linear);
  now_.turning = world_.direction(velocity.angular);
}

void BarrierFrame::read(double time) {
  if (body_ == nullptr) {
    if (now_.moved == time) return;
    now_.velocity.setZero();
    now_.turning.setZero();
    return;
  }
  const Eigen::Vector3d velocity = world_.vector(toVector(dBodyGetLinearVel(body_)));
  const Eigen::Vector3d turning = world_.direction(toVector(dBodyGetAngularVel(body_)));
  const BarrierMotion before = now_;
  place(dBodyGetPosition(body_), dBodyGetRotation(body_));
  const bool isFinite = now_.position.allFinite() && now_.axes.allFinite() &&
                        velocity.allFinite() && turning.allFinite();
  if (!isFinite) restore(before);
  const bool isAtRest = !isFinite || dBodyIsEnabled(body_) == 0;
  now_.velocity = isAtRest ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : velocity;
  now_.turning = isAtRest ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : turning;
}

Eigen::Vector3d BarrierFrame::toFrame(const Eigen::Vector3d& place) const {
  if (!moves_) return place;
  return place_ + turn_.transpose() * (place - now_.position);
}

Eigen::Vector3d BarrierFrame::toWorld(const Eigen::Vector3d& place) const {
  if (!moves_) return place;
  return now_.position + turn_ * (place - place_);
}

Eigen::Vector3d BarrierFrame::directionToFrame(const Eigen::Vector3d& direction) const {
  if (!moves_) return direction;
  return turn_.transpose() * direction;
}

Eigen::Vector3d BarrierFrame::directionToWorld(const Eigen::Vector3d& direction) const {
  if (!moves_) return direction;
  return turn_ * direction;
}

VehiclePose BarrierFrame::toFrame(const VehiclePose& pose) const {
  if (!moves_) return pose;
  return {.massCentre = toFrame(pose.massCentre), .axes = turn_.transpose() * pose.axes};
}

VehicleState BarrierFrame::toFrame(const VehicleState& state) const {
  VehicleState seen = state;
  static_cast<VehiclePose&>(seen) = toFrame(static_cast<const VehiclePose&>(state));
  seen.velocity = directionToFrame(state.velocity);
  return seen;
}

// Its point at the height of the mass centre moves straight if the barrier turns about the
// vehicle's z axis alone.
PlanarMotion BarrierFrame::inYawPlane(const VehiclePose& vehicle) const {
  const Eigen::Vector3d up = vehicle.up();
  const Eigen::Vector3d away = now_.position - vehicle.massCentre;
  const Eigen::Vector3d rise = -up.dot(away) * up;
  const Eigen::Vector3d velocity = now_.velocity + now_.turning.cross(rise);
  return {.position = (vehicle.axes.transpose() * away).head<2>(),
          .velocity = (vehicle.axes.transpose() * velocity).head<2>(),
          .yawRate = now_.turning.dot(up)};
}

double BarrierFrame::fastestWithin(const Eigen::Vector3d& place, double radius) const {
  return now_.velocity.norm() + now_.turning.norm() * ((place - now_.position).norm() + radius);
}

}  // namespace bumper
