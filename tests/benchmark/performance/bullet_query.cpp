#include "bullet_query.h"

#include <btBulletCollisionCommon.h>

#include "scenes.h"

namespace bumper::benchmark {

namespace {

btVector3 toBullet(double x, double y, double z) {
  return {static_cast<btScalar>(x), static_cast<btScalar>(y), static_cast<btScalar>(z)};
}

struct CountContacts : btCollisionWorld::ContactResultCallback {
  std::size_t count = 0;
  btScalar addSingleResult(btManifoldPoint& /*point*/, const btCollisionObjectWrapper* /*a*/,
                           int /*partA*/, int /*indexA*/, const btCollisionObjectWrapper* /*b*/,
                           int /*partB*/, int /*indexB*/) override {
    ++count;
    return 0.0F;
  }
};

class BulletQuery {
 public:
  explicit BulletQuery(const Scene& scene)
      : boxShape_(toBullet(0.5 * (queryCar().massCentreToFront + queryCar().massCentreToRear),
                           0.5 * queryCar().width, 0.5 * (bandTop - bandBottom))) {
    mesh_.preallocateVertices(static_cast<int>(scene.vertices.size()));
    for (const Eigen::Vector3d& vertex : scene.vertices) {
      mesh_.findOrAddVertex(toBullet(vertex.x(), vertex.y(), vertex.z()), false);
    }
    for (const Scene::Triangle& triangle : scene.triangles) {
      mesh_.addTriangleIndices(static_cast<int>(triangle.corners[0]),
                               static_cast<int>(triangle.corners[1]),
                               static_cast<int>(triangle.corners[2]));
    }
    meshShape_ = std::make_unique<btBvhTriangleMeshShape>(&mesh_, true);
    wall_.setCollisionShape(meshShape_.get());
    box_.setCollisionShape(&boxShape_);
  }

  void moveTo(const Pose& pose) {
    const PlanPlace& place = pose.place;
    const auto c = static_cast<btScalar>(place.cosine);
    const auto s = static_cast<btScalar>(place.sine);
    box_.setWorldTransform(btTransform(
        btMatrix3x3(c, -s, 0.0F, s, c, 0.0F, 0.0F, 0.0F, 1.0F),
        toBullet(place.position.x(), place.position.y(), 0.5 * (bandBottom + bandTop))));
  }
  std::size_t query() {
    CountContacts contacts;
    world_.contactPairTest(&box_, &wall_, contacts);
    count_ = contacts.count;
    return count_;
  }
  [[nodiscard]] bool found() const { return count_ > 0; }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  btTriangleMesh mesh_{true, false};
  std::unique_ptr<btBvhTriangleMeshShape> meshShape_;
  btBoxShape boxShape_;
  btCollisionObject wall_;
  btCollisionObject box_;
  std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<QueryScheme> makeBulletQuery(const Scene& scene) {
  return std::make_unique<SchemeOf<BulletQuery>>(scene);
}

}  // namespace bumper::benchmark
