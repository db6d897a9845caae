#include "vehicle_bodies.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

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
Eigen::Vector3d torqueFor(const dMass& mass, dBodyID body, const Eigen::Vector3d& acceleration) {
  const Eigen::Matrix3d rotation = toMatrix(dBodyGetRotation(body));
  const Eigen::Vector3d inOwnAxes = rotation.transpose() * acceleration;
  const Eigen::Vector3d torque = toMatrix(mass.I) * inOwnAxes;
  return rotation * torque;
}

VehicleBodies bodiesOf(dBodyID chassis, std::span<const dBodyID> linkedBodies, const char* call) {
  std::vector<dBodyID> bodies{chassis};
  bodies.insert(bodies.end(), linkedBodies.begin(), linkedBodies.end());
  if (std::find(bodies.begin(), bodies.end(), nullptr) != bodies.end()) {
    throw Error(std::string(call) + ": a body is null");
  }
  return VehicleBodies(std::move(bodies));
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

VehiclePose VehicleBodies::readPose() const {
  VehiclePose pose;
  pose.axes = toMatrix(dBodyGetRotation(chassis()));
  pose.massCentre = toVector(dBodyGetPosition(chassis()));
  if (bodies_.size() == 1) return pose;
  double mass = 0.0;
  pose.massCentre.setZero();
  for (dBodyID body : bodies_) {
    const double itsMass = massOf(body);
    mass += itsMass;
    pose.massCentre += itsMass * toVector(dBodyGetPosition(body));
  }
  pose.massCentre /= mass;
  return pose;
}

VehicleState VehicleBodies::read() const {
  VehicleState state;
  static_cast<VehiclePose&>(state) = readPose();
  const Eigen::Vector3d up = state.up();
  state.yawRate = toVector(dBodyGetAngularVel(chassis())).dot(up);

  dVector3 gravity;
  dWorldGetGravity(dBodyGetWorld(chassis()), gravity);
  state.velocity.setZero();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  double moment = 0.0;
  for (dBodyID body : bodies_) {
    dMass mass;
    dBodyGetMass(body, &mass);
    const Eigen::Vector3d itsForce = toVector(dBodyGetForce(body));
    state.mass += mass.mass;
    state.velocity += mass.mass * toVector(dBodyGetLinearVel(body));
    force += itsForce;
    if (dBodyGetGravityMode(body) != 0) force += mass.mass * toVector(gravity);

    const Eigen::Vector3d arm = toVector(dBodyGetPosition(body)) - state.massCentre;
    const Eigen::Vector3d axis = toMatrix(dBodyGetRotation(body)).transpose() * up;
    state.yawInertia += axis.dot(toMatrix(mass.I) * axis) + mass.mass * up.cross(arm).squaredNorm();
    moment += up.dot(toVector(dBodyGetTorque(body)) + arm.cross(itsForce));
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
    const Eigen::Vector3d arm = toVector(dBodyGetPosition(body)) - state.massCentre;
    dMass mass;
    dBodyGetMass(body, &mass);
    const Eigen::Vector3d share = mass.mass * (acceleration + turning.cross(arm));
    const Eigen::Vector3d torque = torqueFor(mass, body, turning);
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
    const Eigen::Vector3d arm = toVector(dBodyGetPosition(body)) - state.massCentre;
    const Eigen::Vector3d velocity =
        toVector(dBodyGetLinearVel(body)) + change + turning.cross(arm);
    const Eigen::Vector3d angular = toVector(dBodyGetAngularVel(body)) + turning;
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
                                       double width, double massCentreHeight) {
  const VehicleState state = bodiesOf(chassis, linkedBodies, "parametersFromBodies").read();
  return {.mass = state.mass,
          .yawInertia = state.yawInertia,
          .massCentreToFront = massCentreToFront,
          .massCentreToRear = massCentreToRear,
          .width = width,
          .massCentreHeight = massCentreHeight};
}

VehicleParameters parametersFromGeoms(dBodyID chassis, std::span<const dBodyID> linkedBodies,
                                      double massCentreHeight) {
  const VehicleBodies bodies = bodiesOf(chassis, linkedBodies, "parametersFromGeoms");
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
