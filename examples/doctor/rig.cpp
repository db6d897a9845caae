#include "rig.h"

#include <cmath>

namespace bumper::doctor {

namespace {

constexpr int capacity = 64;  // contacts, as generous applications have

Eigen::Vector3d toVector(const dReal* v) { return {v[0], v[1], v[2]}; }

}  // namespace

Rig::Rig() : world_(dWorldCreate()), joints_(dJointGroupCreate(0)) {}

Rig::~Rig() {
  dJointGroupDestroy(joints_);
  if (box_ != nullptr) dGeomDestroy(box_);
  dWorldDestroy(world_);
}

void Rig::makeVehicle(const VehicleParameters& vehicle) {
  body_ = dBodyCreate(world_);
  const double length = vehicle.massCentreToFront + vehicle.massCentreToRear;
  const double height = boxHeight(vehicle);
  box_ = dCreateBox(nullptr, length, vehicle.width, height);
  dGeomSetBody(box_, body_);
  dGeomSetOffsetPosition(box_, 0.5 * (vehicle.massCentreToFront - vehicle.massCentreToRear), 0.0,
                         0.0);
  dMass mass;
  const double roll = vehicle.mass * (vehicle.width * vehicle.width + height * height) / 12.0;
  dMassSetParameters(&mass, vehicle.mass, 0.0, 0.0, 0.0, roll, 0.95 * vehicle.yawInertia,
                     vehicle.yawInertia, 0.0, 0.0, 0.0);
  dBodySetMass(body_, &mass);
  dBodySetFiniteRotationMode(body_, 1);
}

void Rig::place(const TestDrive& drive) const {
  const PlanarMotion& start = drive.start;
  const Eigen::Vector3d position = drive.plane.world(start.position);
  const Eigen::Vector3d velocity = drive.plane.direction(start.velocity);
  const Eigen::Vector3d turning = start.yawRate * drive.plane.axes.col(2);
  const Eigen::Matrix3d axes =
      drive.plane.axes * Eigen::AngleAxisd(start.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  dMatrix3 rotation{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation[4 * row + column] = axes(row, column);
  }
  dBodySetPosition(body_, position.x(), position.y(), position.z());
  dBodySetRotation(body_, rotation);
  dBodySetLinearVel(body_, velocity.x(), velocity.y(), velocity.z());
  dBodySetAngularVel(body_, turning.x(), turning.y(), turning.z());
  dBodySetForce(body_, 0.0, 0.0, 0.0);
  dBodySetTorque(body_, 0.0, 0.0, 0.0);
  dBodyEnable(body_);
  // QuickStep visits its rows in random order: the same one in each drive.
  dRandSetSeed(1);
}

void Rig::push(const TestDrive& drive) const {
  if (drive.sideForce == 0.0) return;
  const Eigen::Vector3d velocity = toVector(dBodyGetLinearVel(body_));
  const Eigen::Vector3d left = drive.plane.axes.col(2).cross(velocity);
  if (left.norm() < 0.1) return;
  const Eigen::Vector3d force = drive.sideForce * left.normalized();
  dBodyAddForce(body_, force.x(), force.y(), force.z());
}

JointRig::JointRig(const Subject& subject, const std::vector<Wall>& walls)
    : subject_(subject), mesh_(walls.size()) {
  makeVehicle(subject.vehicle);
  for (const Wall& wall : walls) mesh_.add(wall.corners[0], wall.corners[1], wall.corners[2]);
  mesh_.build();
}

int JointRig::collide(std::vector<dContact>& contacts) const {
  contacts.resize(capacity);
  if (mesh_.geom() == nullptr) return 0;
  return dCollide(box_, mesh_.geom(), capacity, &contacts[0].geom, sizeof(dContact));
}

std::vector<DriveContact> JointRig::contactsAt(const TestDrive& drive) {
  place(drive);
  std::vector<dContact> contacts;
  const int count = collide(contacts);
  std::vector<DriveContact> result;
  for (int i = 0; i < count; ++i) {
    const dContactGeom& geom = contacts[static_cast<std::size_t>(i)].geom;
    result.push_back(
        {.place = toVector(geom.pos), .normal = toVector(geom.normal), .wall = geom.side2});
  }
  return result;
}

DriveState JointRig::state() const {
  DriveState state{.position = toVector(dBodyGetPosition(body_)),
                   .velocity = toVector(dBodyGetLinearVel(body_))};
  const dReal* q = dBodyGetQuaternion(body_);
  state.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  const Eigen::Vector3d turning =
      state.orientation.conjugate() * toVector(dBodyGetAngularVel(body_));
  state.yawRate = turning.z();
  dMass mass;
  dBodyGetMass(body_, &mass);
  const Eigen::Vector3d inertia(mass.I[0], mass.I[5], mass.I[10]);
  state.energy = 0.5 * mass.mass * state.velocity.squaredNorm() +
                 0.5 * inertia.dot(turning.cwiseProduct(turning));
  return state;
}

DriveTrace JointRig::run(const TestDrive& drive) {
  place(drive);
  const double friction = subject_.response.friction(drive.attack);
  const double bounce = subject_.response.restitution(drive.attack);
  DriveTrace trace;
  trace.states.push_back(state());
  std::vector<dContact> contacts;
  for (std::size_t i = 0; i < drive.steps; ++i) {
    const int count = collide(contacts);
    for (int k = 0; k < count; ++k) {
      dContact& contact = contacts[static_cast<std::size_t>(k)];
      contact.surface = {};
      contact.surface.mode = dContactBounce | dContactApprox1;
      contact.surface.mu = friction;
      contact.surface.bounce = bounce;
      contact.surface.bounce_vel = subject_.response.restSpeed;
      dJointAttach(dJointCreateContact(world_, joints_, &contact), body_, nullptr);
      trace.contacts.push_back({.step = i,
                                .place = toVector(contact.geom.pos),
                                .normal = toVector(contact.geom.normal),
                                .wall = contact.geom.side2});
    }
    push(drive);
    dWorldQuickStep(world_, subject_.step);
    dJointGroupEmpty(joints_);
    trace.states.push_back(state());
  }
  return trace;
}

BumperRig::BumperRig(const Subject& subject)
    : subject_(subject),
      responder_(world_, {.response = subject.response}),
      barrier_(responder_.addBarrier(subject.scene, {.walls = subject.selection()})) {
  makeVehicle(subject.vehicle);
  warnings_.assign(responder_.warnings().begin(), responder_.warnings().end());
}

void BumperRig::attachUnclaimed() {
  const dGeomID walls = responder_.geom(barrier_);
  if (responder_.claims(box_, walls)) return;
  std::vector<dContact> contacts(capacity);
  int count = dCollide(box_, walls, capacity, &contacts[0].geom, sizeof(dContact));
  count = responder_.keepUnclaimed(box_, walls, contacts.data(), count);
  for (int k = 0; k < count; ++k) {
    dContact& contact = contacts[static_cast<std::size_t>(k)];
    contact.surface = {};
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = 0.6;
    dJointAttach(dJointCreateContact(world_, joints_, &contact), body_, nullptr);
  }
}

DriveState BumperRig::state(VehicleId vehicle) const {
  DriveState state{.position = responder_.position(vehicle),
                   .orientation = responder_.orientation(vehicle),
                   .velocity = responder_.velocity(vehicle),
                   .yawRate = responder_.yawRate(vehicle)};
  state.energy = 0.5 * subject_.vehicle.mass * state.velocity.squaredNorm() +
                 0.5 * subject_.vehicle.yawInertia * state.yawRate * state.yawRate;
  return state;
}

DriveTrace BumperRig::run(const TestDrive& drive) {
  place(drive);
  const VehicleId vehicle = responder_.addVehicle(body_, subject_.vehicle);
  DriveTrace trace;
  trace.states.push_back(state(vehicle));
  for (std::size_t i = 0; i < drive.steps; ++i) {
    attachUnclaimed();
    push(drive);
    for (const ImpactEvent& event : responder_.step(subject_.step)) {
      trace.contacts.push_back(
          {.step = i, .place = event.contact, .normal = event.normal, .wall = -1});
    }
    dWorldQuickStep(world_, subject_.step);
    dJointGroupEmpty(joints_);
    trace.states.push_back(state(vehicle));
  }
  responder_.removeVehicle(vehicle);
  return trace;
}

}  // namespace bumper::doctor
