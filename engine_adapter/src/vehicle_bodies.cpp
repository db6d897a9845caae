#include "vehicle_bodies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "bumper/response/error.h"
#include "geom_class.h"
#include "ode_vectors.h"
#include "vehicle_extents.h"

namespace bumper {

namespace {

double massOf(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  return mass.mass;
}

// The torque that gives a body an angular acceleration, by the inertia about its origin, which ODE
// requires to be its mass centre.
Eigen::Vector3d torqueFor(const Eigen::Matrix3d& inertia, const Eigen::Matrix3d& rotation,
                          const Eigen::Vector3d& acceleration) {
  const Eigen::Vector3d inOwnAxes = rotation.transpose() * acceleration;
  const Eigen::Vector3d torque = inertia * inOwnAxes;
  return rotation * torque;
}

void copy(const Eigen::Vector3d& v, dReal* to) {
  for (int k = 0; k < 3; ++k) to[k] = v[k];
}

// In the world's own axes and unit.
VehicleBodies bodiesOf(dBodyID chassis, std::span<const dBodyID> linkedBodies,
                       const ChassisAxes& axes, const char* call) {
  std::vector<dBodyID> bodies{chassis};
  bodies.insert(bodies.end(), linkedBodies.begin(), linkedBodies.end());
  if (std::find(bodies.begin(), bodies.end(), nullptr) != bodies.end()) {
    throw Error(std::string(call) + ": a body is null");
  }
  return VehicleBodies(std::move(bodies), WorldFrame(), turnOf(axes));
}

// The geoms of bodies that cannot be measured, for an error.
std::string geomsOf(std::span<const dBodyID> bodies) {
  std::string names;
  for (dBodyID body : bodies) {
    for (dGeomID geom = dBodyGetFirstGeom(body); geom != nullptr; geom = dBodyGetNextGeom(geom)) {
      names += (names.empty() ? "" : ", ") + std::string(classNameOf(geom));
    }
  }
  return names.empty() ? "have no geom" : "have no geom that can be measured, only: " + names;
}

void requireBeyond(double reach, const char* side) {
  if (reach > 0.0) return;
  std::ostringstream message;
  message << "parametersFromGeoms: the geoms end " << -reach << " m before the mass centre at the "
          << side << ": it must lie within them";
  throw Error(message.str());
}

}  // namespace

bool VehicleState::isFinite() const {
  return massCentre.allFinite() && axes.allFinite() && velocity.allFinite() &&
         std::isfinite(yawRate) && acceleration.allFinite() && std::isfinite(yawAcceleration);
}

VehicleBodies::VehicleBodies(std::vector<dBodyID> bodies, WorldFrame frame, Turn axes)
    : bodies_(std::move(bodies)), frame_(std::move(frame)), axes_(std::move(axes)) {
  if (!frame_.isUsual() || !axes_.isNone()) copies_ = std::make_unique<Copy[]>(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    dBodyID body = bodies_[i];
    if (copies_ != nullptr) {
      const Copy& own = copies_[i];
      numbers_.push_back(
          {own.position, own.rotation, own.velocity, own.turning, own.force, own.torque});
    } else {
      numbers_.push_back({dBodyGetPosition(body), dBodyGetRotation(body), dBodyGetLinearVel(body),
                          dBodyGetAngularVel(body), dBodyGetForce(body), dBodyGetTorque(body)});
    }
  }
  if (areCopied()) refresh();
}

void VehicleBodies::refresh() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    dBodyID body = bodies_[i];
    Copy& own = copies_[i];
    const Eigen::Matrix3d rotation = axesOf(body);
    for (int row = 0; row < 3; ++row)
      copy(rotation.row(row), own.rotation + 4 * static_cast<std::ptrdiff_t>(row));
    copy(positionOf(body), own.position);
    copy(velocityOf(body), own.velocity);
    copy(frame_.direction(toVector(dBodyGetAngularVel(body))), own.turning);
    copy(frame_.vector(toVector(dBodyGetForce(body))), own.force);
    copy(frame_.torque(toVector(dBodyGetTorque(body))), own.torque);
  }
}

Eigen::Matrix3d VehicleBodies::inertiaOf(const dMass& mass) const {
  Eigen::Matrix3d inertia = toMatrix(mass.I);
  if (!areCopied()) return inertia;
  return axes_.ofRows(axes_.ofColumns(inertia)) / (frame_.metre() * frame_.metre());
}

Eigen::Quaterniond VehicleBodies::orientationInWorld() const {
  const dReal* q = dBodyGetQuaternion(chassis());
  Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
  if (axes_.isNone()) return orientation;
  return orientation * Eigen::Quaterniond(axes_.rows()).conjugate();
}

VehiclePose VehicleBodies::readPose() const {
  VehiclePose pose;
  pose.axes = axes();
  pose.massCentre = position();
  if (bodies_.size() == 1) return pose;
  double mass = 0.0;
  pose.massCentre.setZero();
  for (dBodyID body : bodies_) {
    const double itsMass = massOf(body);
    mass += itsMass;
    pose.massCentre += itsMass * positionOf(body);
  }
  pose.massCentre /= mass;
  return pose;
}

VehicleState VehicleBodies::read() const {
  if (areCopied()) refresh();
  VehicleState state;
  static_cast<VehiclePose&>(state) = readPose();
  const Eigen::Vector3d up = state.up();
  state.yawRate = toVector(numbers_.front().turning).dot(up);

  dVector3 worldGravity;
  dWorldGetGravity(dBodyGetWorld(chassis()), worldGravity);
  const Eigen::Vector3d gravity = frame_.vector(toVector(worldGravity));
  state.velocity.setZero();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  double moment = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyNumbers& its = numbers_[i];
    dMass mass;
    dBodyGetMass(bodies_[i], &mass);
    const Eigen::Vector3d itsForce = toVector(its.force);
    state.mass += mass.mass;
    state.velocity += mass.mass * toVector(its.velocity);
    force += itsForce;
    if (dBodyGetGravityMode(bodies_[i]) != 0) force += mass.mass * gravity;

    const Eigen::Vector3d arm = toVector(its.position) - state.massCentre;
    const Eigen::Vector3d axis = toMatrix(its.rotation).transpose() * up;
    state.yawInertia += axis.dot(inertiaOf(mass) * axis) + mass.mass * up.cross(arm).squaredNorm();
    moment += up.dot(toVector(its.torque) + arm.cross(itsForce));
  }
  state.velocity /= state.mass;
  state.acceleration = force / state.mass;
  state.yawAcceleration = moment / state.yawInertia;
  return state;
}

bool VehicleBodies::areAsleep() const {
  return std::none_of(bodies_.begin(), bodies_.end(),
                      [](dBodyID body) { return dBodyIsEnabled(body) != 0; });
}

bool VehicleBodies::anyKinematic() const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [](dBodyID body) { return dBodyIsKinematic(body) != 0; });
}

void VehicleBodies::push(const VehicleState& state, const PlanarForce& force) const {
  const Eigen::Vector3d acceleration = state.toWorld(force.force) / state.mass;
  const Eigen::Vector3d turning = force.yawMoment / state.yawInertia * state.up();
  for (dBodyID body : bodies_) {
    const Eigen::Vector3d arm = positionOf(body) - state.massCentre;
    dMass mass;
    dBodyGetMass(body, &mass);
    const Eigen::Vector3d share =
        frame_.vectorInWorld(mass.mass * (acceleration + turning.cross(arm)));
    const Eigen::Vector3d torque =
        frame_.torqueInWorld(torqueFor(inertiaOf(mass), axesOf(body), turning));
    // ODE keeps the force of a sleeping body until it wakes by other means.
    if (dBodyIsEnabled(body) == 0) dBodyEnable(body);
    dBodyAddForce(body, share.x(), share.y(), share.z());
    dBodyAddTorque(body, torque.x(), torque.y(), torque.z());
  }
}

void VehicleBodies::changeVelocity(const VehicleState& state, const PlanarImpulse& impulse) const {
  const Eigen::Vector3d change = state.toWorld(impulse.linear) / state.mass;
  const Eigen::Vector3d turning = impulse.angular / state.yawInertia * state.up();
  for (dBodyID body : bodies_) {
    const Eigen::Vector3d arm = positionOf(body) - state.massCentre;
    const Eigen::Vector3d velocity =
        frame_.vectorInWorld(velocityOf(body) + change + turning.cross(arm));
    const Eigen::Vector3d angular =
        frame_.directionInWorld(frame_.direction(toVector(dBodyGetAngularVel(body))) + turning);
    if (dBodyIsEnabled(body) == 0) dBodyEnable(body);
    dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(body, angular.x(), angular.y(), angular.z());
  }
}

Band defaultBand(const VehicleParameters& vehicle) {
  return {.bottom = std::min(0.3, 0.5 * vehicle.massCentreHeight),
          .top = vehicle.massCentreHeight + 0.2};
}

Band plateBand(const VehicleParameters& vehicle) {
  constexpr double halfThickness = 0.01;
  return {.bottom = vehicle.massCentreHeight - halfThickness,
          .top = vehicle.massCentreHeight + halfThickness};
}

VehicleParameters parametersFromBodies(dBodyID chassis, std::span<const dBodyID> linkedBodies,
                                       double massCentreToFront, double massCentreToRear,
                                       double width, double massCentreHeight,
                                       const ChassisAxes& axes) {
  const VehicleState state = bodiesOf(chassis, linkedBodies, axes, "parametersFromBodies").read();
  return {.mass = state.mass,
          .yawInertia = state.yawInertia,
          .massCentreToFront = massCentreToFront,
          .massCentreToRear = massCentreToRear,
          .width = width,
          .massCentreHeight = massCentreHeight};
}

VehicleParameters parametersFromGeoms(dBodyID chassis, std::span<const dBodyID> linkedBodies,
                                      double massCentreHeight, const ChassisAxes& axes) {
  const VehicleBodies bodies = bodiesOf(chassis, linkedBodies, axes, "parametersFromGeoms");
  const VehicleState state = bodies.read();
  const std::optional<VehicleExtents> geoms = extentsOf(bodies.all(), state);
  if (!geoms) throw Error("parametersFromGeoms: the bodies " + geomsOf(bodies.all()));
  const double halfWidth = std::max(geoms->left, geoms->right);
  requireBeyond(geoms->front, "front");
  requireBeyond(geoms->rear, "rear");
  requireBeyond(std::min(geoms->left, geoms->right), "side");
  return {.mass = state.mass,
          .yawInertia = state.yawInertia,
          .massCentreToFront = geoms->front,
          .massCentreToRear = geoms->rear,
          .width = 2.0 * halfWidth,
          .massCentreHeight = massCentreHeight};
}

}  // namespace bumper
