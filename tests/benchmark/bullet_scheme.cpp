#include "bullet_scheme.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

namespace bumper::benchmark {

namespace {

btVector3 toBullet(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

class BulletScheme : public Scheme {
 public:
  explicit BulletScheme(int triangles) {
    const Scene scene = wallScene(triangles);
    for (const Scene::Triangle& triangle : scene.triangles) {
      mesh_.addTriangle(toBullet(scene.corner(triangle, 0)), toBullet(scene.corner(triangle, 1)),
                        toBullet(scene.corner(triangle, 2)));
    }
    wallShape_ = std::make_unique<btBvhTriangleMeshShape>(&mesh_, true);
    wall_ = std::make_unique<btRigidBody>(0.0F, nullptr, wallShape_.get());
    wall_->setFriction(1.0F);
    wall_->setRestitution(1.0F);
    world_.setGravity(btVector3(0.0F, 0.0F, 0.0F));
    world_.getSolverInfo().m_restitutionVelocityThreshold = 0.1F;
    world_.addRigidBody(wall_.get());
  }
  ~BulletScheme() override { world_.removeRigidBody(wall_.get()); }
  BulletScheme(const BulletScheme&) = delete;
  BulletScheme& operator=(const BulletScheme&) = delete;
  BulletScheme(BulletScheme&&) = delete;
  BulletScheme& operator=(BulletScheme&&) = delete;

  RunResult run(const Run& run) override {
    const ImpactCase& one = *run.impactCase;
    const VehicleParameters& car = one.car.body;
    // Mass centre off the box's middle.
    const double length = car.massCentreToFront + car.massCentreToRear;
    const double height = 2.0 * (car.massCentreHeight - 0.2);
    btBoxShape box(toBullet(0.5 * Eigen::Vector3d(length, car.width, height)));
    btCompoundShape shape;
    shape.addChildShape(
        btTransform(btQuaternion::getIdentity(),
                    toBullet({0.5 * (car.massCentreToFront - car.massCentreToRear), 0.0, 0.0})),
        &box);
    const auto inertia = static_cast<btScalar>(car.yawInertia);
    btRigidBody body(static_cast<btScalar>(car.mass), nullptr, &shape,
                     btVector3(inertia, inertia, inertia));
    body.setWorldTransform(btTransform(
        btQuaternion(btVector3(0.0F, 0.0F, 1.0F), static_cast<btScalar>(one.start.yaw)),
        toBullet({one.start.position.x(), one.start.position.y(), car.massCentreHeight})));
    body.setInterpolationWorldTransform(body.getWorldTransform());
    body.setLinearVelocity(toBullet({one.start.velocity.x(), one.start.velocity.y(), 0.0}));
    body.setAngularVelocity(toBullet({0.0, 0.0, one.start.yawRate}));
    body.setLinearFactor(btVector3(1.0F, 1.0F, 0.0F));
    body.setAngularFactor(btVector3(0.0F, 0.0F, 1.0F));
    body.setFriction(static_cast<btScalar>(one.law.friction));
    body.setRestitution(static_cast<btScalar>(one.law.restitution));
    body.setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(&body);

    const auto motion = [&] {
      const btTransform& at = body.getWorldTransform();
      const btVector3& velocity = body.getLinearVelocity();
      return PlanarMotion{.position = {at.getOrigin().x(), at.getOrigin().y()},
                          .yaw = std::atan2(at.getBasis()[1][0], at.getBasis()[0][0]),
                          .velocity = {velocity.x(), velocity.y()},
                          .yawRate = body.getAngularVelocity().z()};
    };
    const double energy = yawPlaneEnergy(one.start, car.mass, car.yawInertia);
    double most = energy;
    const auto steps = static_cast<int>(std::lround(run.reference->duration / run.step));
    const double clock = cpuTime();
    for (int k = 0; k < steps; ++k) {
      world_.stepSimulation(static_cast<btScalar>(run.step), 0);
      if (run.watchEnergy) {
        most = std::max(most, yawPlaneEnergy(motion(), car.mass, car.yawInertia));
      }
    }
    RunResult result;
    result.cpuTime = cpuTime() - clock;
    result.energyGain = most / energy - 1.0;
    result.end = motion();
    world_.removeRigidBody(&body);
    return result;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btTriangleMesh mesh_;
  std::unique_ptr<btBvhTriangleMeshShape> wallShape_;
  std::unique_ptr<btRigidBody> wall_;
};

}  // namespace

std::unique_ptr<Scheme> makeBulletScheme(int triangles) {
  return std::make_unique<BulletScheme>(triangles);
}

}  // namespace bumper::benchmark
