#include <btBulletDynamicsCommon.h>

#include <memory>

#include "vehicle_peers.h"

namespace bumper::benchmark {

namespace {

constexpr double height = 0.7;  // of the boxes, m

btVector3 toBullet(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

/// A box whose mass centre is not its middle, kept in the plane.
struct BulletVehicle {
  BulletVehicle(const PairState& state, double restitution, double friction)
      : box(toBullet(
            0.5 * Eigen::Vector3d(state.vehicle.massCentreToFront + state.vehicle.massCentreToRear,
                                  state.vehicle.width, height))) {
    const auto& [vehicle, motion] = state;
    const double middle = 0.5 * (vehicle.massCentreToFront - vehicle.massCentreToRear);
    shape.addChildShape(btTransform(btQuaternion::getIdentity(), toBullet({middle, 0.0, 0.0})),
                        &box);
    const auto inertia = static_cast<btScalar>(vehicle.yawInertia);
    body = std::make_unique<btRigidBody>(static_cast<btScalar>(vehicle.mass), nullptr, &shape,
                                         btVector3(inertia, inertia, inertia));
    body->setWorldTransform(
        btTransform(btQuaternion(btVector3(0.0F, 0.0F, 1.0F), static_cast<btScalar>(motion.yaw)),
                    toBullet({motion.position.x(), motion.position.y(), 0.0})));
    body->setInterpolationWorldTransform(body->getWorldTransform());
    body->setLinearVelocity(toBullet({motion.velocity.x(), motion.velocity.y(), 0.0}));
    body->setAngularVelocity(toBullet({0.0, 0.0, motion.yawRate}));
    body->setLinearFactor(btVector3(1.0F, 1.0F, 0.0F));
    body->setAngularFactor(btVector3(0.0F, 0.0F, 1.0F));
    // Bullet takes the product of both.
    body->setFriction(static_cast<btScalar>(std::sqrt(friction)));
    body->setRestitution(static_cast<btScalar>(std::sqrt(restitution)));
    body->setActivationState(DISABLE_DEACTIVATION);
  }

  [[nodiscard]] PlanarMotion motion() const {
    const btTransform& at = body->getWorldTransform();
    const btVector3& velocity = body->getLinearVelocity();
    return {.position = {at.getOrigin().x(), at.getOrigin().y()},
            .yaw = std::atan2(at.getBasis()[1][0], at.getBasis()[0][0]),
            .velocity = {velocity.x(), velocity.y()},
            .yawRate = body->getAngularVelocity().z()};
  }

  btBoxShape box;
  btCompoundShape shape;
  std::unique_ptr<btRigidBody> body;
};

}  // namespace

VehicleRun runBullet(const VehicleTask& task) {
  const VehicleCase& one = *task.vehicleCase;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0.0F, 0.0F, 0.0F));
  world.getSolverInfo().m_restitutionVelocityThreshold = 0.1F;
  std::vector<std::unique_ptr<BulletVehicle>> vehicles;
  for (const PairState& state : one.vehicles) {
    vehicles.push_back(std::make_unique<BulletVehicle>(state, one.settings.restitution(0.0),
                                                       one.settings.friction(0.0)));
    world.addRigidBody(vehicles.back()->body.get());
  }
  const VehicleRun run = runSteps(
      task, [&] { world.stepSimulation(static_cast<btScalar>(task.step), 0); },
      [&] {
        std::vector<PlanarMotion> motions;
        for (const auto& vehicle : vehicles) motions.push_back(vehicle->motion());
        return motions;
      });
  for (const auto& vehicle : vehicles) world.removeRigidBody(vehicle->body.get());
  return run;
}

}  // namespace bumper::benchmark
