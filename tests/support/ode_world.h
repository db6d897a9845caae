#pragma once

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <functional>
#include <vector>

#include "bumper/engine_adapter/responder.h"

namespace bumper::tests {

/// Starts ODE for the whole test program. Put one into every program that uses ODE.
class OdeEnvironment : public ::testing::Environment {
 public:
  void SetUp() override {
    dInitODE2(0);
    dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  }
  void TearDown() override { dCloseODE(); }
};

enum class Stepper { quick, exact };

/// A world with a space and the near callback of design: Bumper's pairs first, contact joints for
/// the rest.
class OdeWorld {
 public:
  explicit OdeWorld(double gravity = 0.0)
      : world(dWorldCreate()), space(dHashSpaceCreate(nullptr)), joints(dJointGroupCreate(0)) {
    dWorldSetGravity(world, 0.0, 0.0, -gravity);
    dRandSetSeed(1);
  }
  ~OdeWorld() {
    dJointGroupDestroy(joints);
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;
  OdeWorld(OdeWorld&&) = delete;
  OdeWorld& operator=(OdeWorld&&) = delete;

  /// One step: collide with contact joints for what the responder (may be null) does not claim.
  /// `before` runs after colliding, where an application adds its own forces and calls step().
  void step(double h, Responder* responder, const std::function<void()>& before,
            Stepper stepper = Stepper::quick) {
    responder_ = responder;
    found.clear();
    contacts.clear();
    dSpaceCollide(space, this, &OdeWorld::near);
    before();
    if (stepper == Stepper::quick) {
      dWorldQuickStep(world, h);
    } else {
      dWorldStep(world, h);
    }
    dJointGroupEmpty(joints);
  }

  dWorldID world;
  dSpaceID space;
  dJointGroupID joints;
  double friction = 0.9;
  double bounce = 0.0;
  /// Of the last step: what dCollide gave for pairs that were not claimed as a whole …
  std::vector<dContactGeom> found;
  /// … and those of them that became joints.
  std::vector<dContactGeom> contacts;

 private:
  static void near(void* data, dGeomID a, dGeomID b) {
    if (dGeomIsSpace(a) != 0 || dGeomIsSpace(b) != 0) {
      dSpaceCollide2(a, b, data, &OdeWorld::near);
      return;
    }
    static_cast<OdeWorld*>(data)->collide(a, b);
  }

  void collide(dGeomID a, dGeomID b) {
    const dBodyID bodyA = dGeomGetBody(a);
    const dBodyID bodyB = dGeomGetBody(b);
    if (bodyA == nullptr && bodyB == nullptr) return;
    if (bodyA != nullptr && bodyB != nullptr && dAreConnected(bodyA, bodyB) != 0) return;
    if (responder_ != nullptr && responder_->claims(a, b)) return;
    constexpr int capacity = 64;
    dContact each[capacity];
    int count = dCollide(a, b, capacity, &each[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) found.push_back(each[i].geom);
    if (responder_ != nullptr) count = responder_->keepUnclaimed(a, b, each, count);
    for (int i = 0; i < count; ++i) {
      each[i].surface = {};
      each[i].surface.mode = dContactBounce | dContactApprox1;
      each[i].surface.mu = friction;
      each[i].surface.bounce = bounce;
      each[i].surface.bounce_vel = 0.1;
      contacts.push_back(each[i].geom);
      dJointAttach(dJointCreateContact(world, joints, &each[i]), bodyA, bodyB);
    }
  }

  Responder* responder_ = nullptr;
};

/// A static trimesh of a scene, as an application would make one: road and walls in one geom.
class OdeMesh {
 public:
  OdeMesh(dSpaceID space, const Scene& scene) {
    for (const Eigen::Vector3d& v : scene.vertices) {
      vertices_.insert(vertices_.end(), {v.x(), v.y(), v.z()});
    }
    for (const Scene::Triangle& t : scene.triangles) {
      indices_.insert(indices_.end(), {t.corners[0], t.corners[1], t.corners[2]});
    }
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double),
                                static_cast<int>(vertices_.size() / 3), indices_.data(),
                                static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
    geom = dCreateTriMesh(space, data_, nullptr, nullptr, nullptr);
  }
  ~OdeMesh() {
    dGeomDestroy(geom);
    dGeomTriMeshDataDestroy(data_);
  }
  OdeMesh(const OdeMesh&) = delete;
  OdeMesh& operator=(const OdeMesh&) = delete;
  OdeMesh(OdeMesh&&) = delete;
  OdeMesh& operator=(OdeMesh&&) = delete;

  /// Height of the first triangle below `from`, m.
  [[nodiscard]] double heightBelow(double x, double y, double from) const {
    const dGeomID ray = dCreateRay(nullptr, 100.0);
    dGeomRaySetClosestHit(ray, 1);
    dGeomRaySet(ray, x, y, from, 0.0, 0.0, -1.0);
    dContactGeom hit = {};
    dCollide(ray, geom, 1, &hit, sizeof hit);
    dGeomDestroy(ray);
    return from - hit.depth;
  }

  dGeomID geom = nullptr;

 private:
  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_ = nullptr;
};

}  // namespace bumper::tests
