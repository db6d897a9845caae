#include "vehicle_schemes.h"

#include <ode/ode.h>

#include <array>

#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "car_world.h"
#include "vehicle_peers.h"

namespace bumper::benchmark {

namespace {

constexpr double height = 0.7;  // of the boxes, m
constexpr int mostContacts = 8;

/// A case's vehicles as bodies in an ODE world.
class OdeVehicles {
 public:
  /// With a geom each, if ODE is to collide them.
  OdeVehicles(const VehicleCase& vehicleCase, bool collide) {
    dRandSetSeed(1);
    for (const auto& [vehicle, motion] : vehicleCase.vehicles) {
      dBodyID body = dBodyCreate(ode.world);
      dMass mass;
      dMassSetParameters(&mass, vehicle.mass, 0.0, 0.0, 0.0, vehicle.yawInertia, vehicle.yawInertia,
                         vehicle.yawInertia, 0.0, 0.0, 0.0);
      dBodySetMass(body, &mass);
      dBodySetFiniteRotationMode(body, 1);
      dBodySetPosition(body, motion.position.x(), motion.position.y(), vehicle.massCentreHeight);
      dQuaternion turn = {std::cos(0.5 * motion.yaw), 0.0, 0.0, std::sin(0.5 * motion.yaw)};
      dBodySetQuaternion(body, turn);
      dBodySetLinearVel(body, motion.velocity.x(), motion.velocity.y(), 0.0);
      dBodySetAngularVel(body, 0.0, 0.0, motion.yawRate);
      bodies.push_back(body);
      if (!collide) continue;
      dGeomID geom = dCreateBox(ode.space, vehicle.massCentreToFront + vehicle.massCentreToRear,
                                vehicle.width, height);
      dGeomSetBody(geom, body);
      dGeomSetOffsetPosition(geom, 0.5 * (vehicle.massCentreToFront - vehicle.massCentreToRear),
                             0.0, 0.0);
    }
  }

  [[nodiscard]] std::vector<PlanarMotion> motions() const {
    std::vector<PlanarMotion> result;
    for (dBodyID body : bodies) {
      const dReal* p = dBodyGetPosition(body);
      const dReal* q = dBodyGetQuaternion(body);
      const dReal* v = dBodyGetLinearVel(body);
      result.push_back({.position = {p[0], p[1]},
                        .yaw = 2.0 * std::atan2(q[3], q[0]),
                        .velocity = {v[0], v[1]},
                        .yawRate = dBodyGetAngularVel(body)[2]});
    }
    return result;
  }

  CarWorld ode;
  std::vector<dBodyID> bodies;
};

VehicleRun runBumper(const VehicleTask& task) {
  OdeVehicles vehicles(*task.vehicleCase, false);
  const ResponseSettings& settings = task.vehicleCase->settings;
  Responder responder(vehicles.ode.world, {.response = settings, .vehicleResponse = settings});
  for (const StraightWall& wall : task.vehicleCase->walls) {
    responder.addBarrier(straightWall(wall.start, wall.end, 2.0), {.space = vehicles.ode.space});
  }
  for (std::size_t i = 0; i < vehicles.bodies.size(); ++i) {
    responder.addVehicle(vehicles.bodies[i], task.vehicleCase->vehicles[i].vehicle);
  }
  return runSteps(
      task,
      [&] {
        responder.step(task.step);
        dWorldQuickStep(vehicles.ode.world, task.step);
      },
      [&] { return vehicles.motions(); });
}

/// ODE's own answer: contact joints with bounce and friction.
class Joints {
 public:
  explicit Joints(const VehicleTask& task)
      : task_(task),
        vehicles_(*task.vehicleCase, true),
        restitution_(task.vehicleCase->settings.restitution(0.0)),
        friction_(task.vehicleCase->settings.friction(0.0)) {}
  ~Joints() { dJointGroupDestroy(joints_); }
  Joints(const Joints&) = delete;
  Joints& operator=(const Joints&) = delete;
  Joints(Joints&&) = delete;
  Joints& operator=(Joints&&) = delete;

  VehicleRun run(int (*stepWorld)(dWorldID, dReal)) {
    return runSteps(
        task_,
        [&] {
          dSpaceCollide(vehicles_.ode.space, this, [](void* joints, dGeomID a, dGeomID b) {
            static_cast<Joints*>(joints)->collide(a, b);
          });
          stepWorld(vehicles_.ode.world, task_.step);
          dJointGroupEmpty(joints_);
        },
        [&] { return vehicles_.motions(); });
  }

 private:
  void collide(dGeomID a, dGeomID b) {
    std::array<dContact, mostContacts> contacts;
    const int count = dCollide(a, b, mostContacts, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts.at(static_cast<std::size_t>(i));
      contact.surface = {};
      contact.surface.mode = dContactBounce | dContactApprox1;
      contact.surface.mu = friction_;
      contact.surface.bounce = restitution_;
      contact.surface.bounce_vel = 0.1;
      dJointAttach(dJointCreateContact(vehicles_.ode.world, joints_, &contact), dGeomGetBody(a),
                   dGeomGetBody(b));
    }
  }

  VehicleTask task_;
  OdeVehicles vehicles_;
  dJointGroupID joints_ = dJointGroupCreate(0);
  double restitution_;
  double friction_;
};

}  // namespace

double energyOf(const VehicleCase& vehicleCase, const std::vector<PlanarMotion>& motions) {
  double sum = 0.0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const VehicleParameters& vehicle = vehicleCase.vehicles[i].vehicle;
    sum += yawPlaneEnergy(motions[i], vehicle.mass, vehicle.yawInertia);
  }
  return sum;
}

std::vector<VehicleScheme> vehicleSchemes() {
  return {
      {"bumper", runBumper},
      {"ode_quickstep", [](const VehicleTask& task) { return Joints(task).run(dWorldQuickStep); }},
      {"ode_worldstep", [](const VehicleTask& task) { return Joints(task).run(dWorldStep); }},
#ifdef BUMPER_BULLET
      {"bullet", runBullet},
#endif
#ifdef BUMPER_BOX2D
      {"box2d", runBox2d},
#endif
  };
}

}  // namespace bumper::benchmark
