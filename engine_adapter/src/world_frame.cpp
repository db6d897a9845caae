#include "world_frame.h"

#include <cmath>
#include <sstream>
#include <string>

#include "bumper/response/error.h"

namespace bumper {

namespace {

// How far from unit and perpendicular a direction may be: written by hand, or single precision.
constexpr double axisTolerance = 1e-6;

std::string textOf(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text << '(' << v.x() << ", " << v.y() << ", " << v.z() << ')';
  return text.str();
}

void requireUnit(const Eigen::Vector3d& v, const char* what) {
  if (v.allFinite() && std::abs(v.norm() - 1.0) <= axisTolerance) return;
  throw Error(std::string(what) + " is " + textOf(v) + ": it must be a unit vector");
}

// The axis that a direction is, if it is one to the last bit.
bool isAxis(const Eigen::Vector3d& v) { return (v.array() == 0.0).count() == 2; }

Eigen::Vector3d unit(const Eigen::Vector3d& v) {
  return isAxis(v) ? Eigen::Vector3d(v.array().sign()) : v.normalized();
}

// The rows are Bumper's axes in the world's.
Eigen::Matrix3d rowsFor(const Eigen::Vector3d& up) {
  Eigen::Matrix3d rows;
  if (!isAxis(up)) {
    return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
  int axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  rows.setZero();
  rows(2, axis) = up[axis];
  rows(0, (axis + 1) % 3) = 1.0;
  rows(1, (axis + 2) % 3) = up[axis];
  return rows;
}

// What an event has in units of length: times `length` for each power of it.
void scale(double length, ImpactEvent& event) {
  event.arm *= length;
  event.otherArm *= length;
  event.approachSpeed *= length;
  event.impulseNormal *= length;
  event.impulseTangent *= length;
  event.deltaV *= length;
  event.speedBefore *= length;
  event.speedAfter *= length;
  event.energyLost *= length * length;
}

}  // namespace

void validate(const WorldAxes& axes) {
  requireUnit(axes.up, "WorldAxes::up");
  if (!(std::isfinite(axes.metre) && axes.metre > 0.0)) {
    std::ostringstream message;
    message << "WorldAxes::metre is " << axes.metre << ": it must be finite and positive";
    throw Error(message.str());
  }
}

void validate(const ChassisAxes& axes) {
  requireUnit(axes.forward, "ChassisAxes::forward");
  requireUnit(axes.up, "ChassisAxes::up");
  if (std::abs(axes.forward.dot(axes.up)) <= axisTolerance) return;
  throw Error("ChassisAxes: forward " + textOf(axes.forward) + " and up " + textOf(axes.up) +
              " must be perpendicular");
}

WorldFrame::WorldFrame(const WorldAxes& axes) {
  validate(axes);
  turn_ = Turn(rowsFor(unit(axes.up)));
  metre_ = axes.metre;
  isUsual_ = turn_.isNone() && metre_ == 1.0;
}

Scene WorldFrame::scene(const Scene& world) const {
  Scene own = world;
  for (Eigen::Vector3d& vertex : own.vertices) vertex = vector(vertex);
  return own;
}

ImpactEvent WorldFrame::event(const ImpactEvent& world) const {
  ImpactEvent own = world;
  own.normal = direction(world.normal);
  for (const auto member :
       {&ImpactEvent::contact, &ImpactEvent::velocityBefore, &ImpactEvent::velocityAfter,
        &ImpactEvent::otherVelocityBefore, &ImpactEvent::otherVelocityAfter}) {
    own.*member = vector(world.*member);
  }
  scale(1.0 / metre_, own);
  return own;
}

ImpactEvent WorldFrame::eventInWorld(const ImpactEvent& own) const {
  ImpactEvent world = own;
  world.normal = directionInWorld(own.normal);
  for (const auto member :
       {&ImpactEvent::contact, &ImpactEvent::velocityBefore, &ImpactEvent::velocityAfter,
        &ImpactEvent::otherVelocityBefore, &ImpactEvent::otherVelocityAfter}) {
    world.*member = vectorInWorld(own.*member);
  }
  scale(metre_, world);
  return world;
}

Turn turnOf(const ChassisAxes& axes) {
  validate(axes);
  Eigen::Matrix3d rows;
  const Eigen::Vector3d up = unit(axes.up);
  const Eigen::Vector3d forward = unit(axes.forward);
  rows.row(2) = up;
  rows.row(0) = unit(forward - forward.dot(up) * up);
  rows.row(1) = rows.row(2).cross(rows.row(0));
  return Turn(rows);
}

Eigen::Vector3d zUp(const Eigen::Vector3d& vector, const WorldAxes& axes) {
  return WorldFrame(axes).vector(vector);
}

Eigen::Quaterniond zUp(const Eigen::Quaterniond& orientation, const WorldAxes& axes) {
  return Eigen::Quaterniond(WorldFrame(axes).turn().rows()) * orientation;
}

Scene zUp(const Scene& scene, const WorldAxes& axes) { return WorldFrame(axes).scene(scene); }

ImpactEvent zUp(const ImpactEvent& event, const WorldAxes& axes) {
  return WorldFrame(axes).event(event);
}

}  // namespace bumper
