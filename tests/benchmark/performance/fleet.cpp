#include "fleet.h"

#include <algorithm>
#include <cmath>

#include "scenes.h"

namespace bumper::benchmark {

namespace {

constexpr double speed = 20.0;      // m/s
constexpr double pushing = 3000.0;  // N

template <std::size_t count>
std::array<dReal, count> copied(const dReal* values) {
  std::array<dReal, count> result;
  std::copy_n(values, count, result.begin());
  return result;
}

}  // namespace

Fleet::Fleet(const Scene& scene, const FleetOptions& options)
    : options_(options),
      world_(dWorldCreate()),
      space_(dSimpleSpaceCreate(nullptr)),
      joints_(dJointGroupCreate(0)) {
  if (options.answer == Answer::bumper) {
    responder_.emplace(world_);
    responder_->addBarrier(scene, {.space = space_});
  } else if (options.answer == Answer::joints) {
    mesh_.emplace(space_, scene);
  }
  for (const PlanPlace& place : placesAlongCourse(scene, options.vehicles, options.inContact)) {
    addVehicle(place);
  }
  if (responder_) saved_ = responder_->save();
}

Fleet::~Fleet() {
  responder_.reset();
  mesh_.reset();
  cars_.clear();
  hinge2Cars_.clear();
  dJointGroupDestroy(joints_);
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
}

void Fleet::addVehicle(const PlanPlace& place) {
  // Several are not collided with each other.
  const dSpaceID space = options_.vehicles == 1 ? space_ : nullptr;
  const double yaw = std::atan2(place.sine, place.cosine);
  std::vector<dBodyID> bodies;
  if (options_.fiveBodies) {
    hinge2Cars_.push_back(
        std::make_unique<tests::Hinge2Car>(world_, space, place.position, 0.0, yaw, speed));
    const tests::Hinge2Car& car = *hinge2Cars_.back();
    bodies.push_back(car.chassis);
    bodies.insert(bodies.end(), car.wheels.begin(), car.wheels.end());
    if (responder_) {
      responder_->addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});
    }
  } else {
    const VehicleParameters parameters = queryCar();
    cars_.push_back(std::make_unique<examples::YawPlaneCar>(
        world_, space, examples::YawPlaneCarDesign{.body = parameters},
        Eigen::Vector3d(place.position.x(), place.position.y(), parameters.massCentreHeight), yaw,
        speed));
    bodies.push_back(cars_.back()->body());
    if (responder_) responder_->addVehicle(bodies.front(), parameters);
  }
  chassis_.push_back(bodies.front());
  pushes_.push_back({pushing * place.sine, -pushing * place.cosine});
  for (const dBodyID body : bodies) {
    starts_.push_back({.body = body,
                       .position = copied<3>(dBodyGetPosition(body)),
                       .rotation = copied<4>(dBodyGetQuaternion(body)),
                       .velocity = copied<3>(dBodyGetLinearVel(body)),
                       .turning = copied<3>(dBodyGetAngularVel(body))});
  }
}

void Fleet::reset() {
  for (const Start& start : starts_) {
    dBodySetPosition(start.body, start.position[0], start.position[1], start.position[2]);
    dBodySetQuaternion(start.body, start.rotation.data());
    dBodySetLinearVel(start.body, start.velocity[0], start.velocity[1], start.velocity[2]);
    dBodySetAngularVel(start.body, start.turning[0], start.turning[1], start.turning[2]);
    dBodySetForce(start.body, 0.0, 0.0, 0.0);
    dBodySetTorque(start.body, 0.0, 0.0, 0.0);
  }
  if (responder_) responder_->restore(saved_);
  dRandSetSeed(1);
}

void Fleet::push() {
  if (!options_.inContact) return;
  for (std::size_t i = 0; i < chassis_.size(); ++i) {
    dBodyAddForce(chassis_[i], pushes_[i][0], pushes_[i][1], 0.0);
  }
}

void Fleet::near(void* fleet, dGeomID a, dGeomID b) {
  auto& self = *static_cast<Fleet*>(fleet);
  const dBodyID bodyA = dGeomGetBody(a);
  const dBodyID bodyB = dGeomGetBody(b);
  if (bodyA != nullptr && bodyB != nullptr) return;  // chassis and wheels
  if (self.responder_ && self.responder_->claims(a, b)) return;
  std::array<dContact, 8> contacts;
  int count =
      dCollide(a, b, static_cast<int>(contacts.size()), &contacts[0].geom, sizeof(dContact));
  if (self.responder_) count = self.responder_->keepUnclaimed(a, b, contacts.data(), count);
  for (int i = 0; i < count; ++i) {
    dContact& contact = contacts.at(static_cast<std::size_t>(i));
    contact.surface = {};
    contact.surface.mode = dContactBounce | dContactApprox1;
    contact.surface.mu = 0.3;
    contact.surface.bounce = 0.1;
    contact.surface.bounce_vel = 0.1;
    dJointAttach(dJointCreateContact(self.world_, self.joints_, &contact), bodyA, bodyB);
  }
}

void Fleet::collide() {
  if (options_.answer == Answer::nobody || options_.vehicles > 1) return;
  dSpaceCollide(space_, this, &Fleet::near);
}

void Fleet::stepWorld() {
  dWorldQuickStep(world_, stepSize_);
  dJointGroupEmpty(joints_);
}

void Fleet::glide() {
  for (const Start& start : starts_) {
    const dReal* place = dBodyGetPosition(start.body);
    const dReal* velocity = dBodyGetLinearVel(start.body);
    dBodySetPosition(start.body, place[0] + stepSize_ * velocity[0],
                     place[1] + stepSize_ * velocity[1], place[2] + stepSize_ * velocity[2]);
  }
}

}  // namespace bumper::benchmark
