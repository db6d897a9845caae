// A contact is owned by what touches what, however the pair was given to dCollide.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

/// Road and wall in one mesh, and a car that touches both with one box, whose wheel stands on the
/// road with another geom.
class ContactGeoms : public ::testing::Test {
 protected:
  ContactGeoms() : mesh_(nullptr, scene()), responder_(ode_.world), car_(ode_.world) {
    responder_.addBarrier(mesh_.geom);
    responder_.addVehicle(car_.body, car_.parameters);
    dGeomBoxSetLengths(car_.geom, 4.6, 1.8, 1.1);
    dGeomSetOffsetPosition(car_.geom, -0.2, 0.0, 0.0);
    car_.place({0.0, 0.89, 0.545}, Eigen::Matrix3d::Identity());
  }

  static Scene scene() {
    Scene scene = straightWall({-8.0, 0.0}, {8.0, 0.0}, 1.2);
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), {{-8, 0, 0}, {8, 0, 0}, {8, 9, 0}, {-8, 9, 0}});
    scene.triangles.push_back({.corners = {first, first + 1, first + 2}, .mesh = 0});
    scene.triangles.push_back({.corners = {first, first + 2, first + 3}, .mesh = 0});
    return scene;
  }

  struct Count {
    int wall = 0;
    int road = 0;
    bool operator==(const Count&) const = default;
  };
  static Count countOf(const dContact* contacts, int count) {
    Count result;
    for (int i = 0; i < count; ++i) {
      // The mesh's triangle; of what is no mesh the number is -1.
      const int triangle = std::max(contacts[i].geom.side1, contacts[i].geom.side2);
      ++(triangle < 2 ? result.wall : result.road);
    }
    return result;
  }

  /// What dCollide finds, and what is left of it.
  std::pair<Count, Count> collide(dGeomID a, dGeomID b,
                                  const std::function<void(dContact&)>& change = {}) {
    std::vector<dContact> contacts(64);
    const int found = dCollide(a, b, 64, &contacts[0].geom, sizeof(dContact));
    if (change) std::for_each(contacts.begin(), contacts.begin() + found, change);
    const Count before = countOf(contacts.data(), found);
    const int kept = responder_.keepUnclaimed(a, b, contacts.data(), found);
    return {before, countOf(contacts.data(), kept)};
  }

  void expectShared(dGeomID a, dGeomID b, const std::function<void(dContact&)>& change = {}) {
    for (const bool swapped : {false, true}) {
      const auto [found, kept] = swapped ? collide(b, a, change) : collide(a, b, change);
      EXPECT_GT(found.wall, 0);
      EXPECT_GT(found.road, 0);
      EXPECT_EQ(kept, (Count{.wall = 0, .road = found.road}));
    }
  }

  OdeWorld ode_;
  OdeMesh mesh_;
  Responder responder_;
  BoxCar car_;
};

TEST_F(ContactGeoms, AGeom) { expectShared(car_.geom, mesh_.geom); }

TEST_F(ContactGeoms, ASpaceAndNestedSpaces) {
  const dSpaceID inner = dSimpleSpaceCreate(nullptr);
  dSpaceAdd(inner, car_.geom);
  expectShared(reinterpret_cast<dGeomID>(inner), mesh_.geom);
  const dSpaceID outer = dHashSpaceCreate(nullptr);
  dSpaceAdd(outer, reinterpret_cast<dGeomID>(inner));
  expectShared(reinterpret_cast<dGeomID>(outer), mesh_.geom);
  const dSpaceID track = dSimpleSpaceCreate(nullptr);
  dSpaceAdd(track, mesh_.geom);
  expectShared(reinterpret_cast<dGeomID>(inner), reinterpret_cast<dGeomID>(track));
  dSpaceRemove(track, mesh_.geom);
  dSpaceRemove(inner, car_.geom);
  dSpaceDestroy(track);
  dSpaceDestroy(outer);
}

// A ball in the same space as the car hits the same wall: that one is ODE's.
TEST_F(ContactGeoms, StrangersInTheSameSpace) {
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  const dGeomID post = dCreateBox(space, 0.5, 0.5, 1.0);  // stands on its own, without a body
  dGeomSetPosition(post, 5.0, 0.2, 0.6);
  const dBodyID ball = dBodyCreate(ode_.world);
  const dGeomID sphere = dCreateSphere(space, 0.3);
  dGeomSetBody(sphere, ball);
  dBodySetPosition(ball, -5.0, 0.25, 0.6);
  const auto [foundAlone, keptAlone] = collide(reinterpret_cast<dGeomID>(space), mesh_.geom);
  EXPECT_GT(foundAlone.wall, 0);
  EXPECT_EQ(keptAlone, foundAlone);
  dSpaceAdd(space, car_.geom);
  const auto [found, kept] = collide(reinterpret_cast<dGeomID>(space), mesh_.geom);
  EXPECT_GT(found.wall, foundAlone.wall);
  EXPECT_EQ(kept.wall, foundAlone.wall);
  EXPECT_EQ(kept.road, found.road);
  dSpaceRemove(space, car_.geom);
  dSpaceDestroy(space);
  dBodyDestroy(ball);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

TEST_F(ContactGeoms, AGeomTransform) {
  for (const int information : {0, 1}) {
    const dGeomID inner = dCreateBox(nullptr, 4.6, 1.8, 1.1);
    const dGeomID transform = dCreateGeomTransform(nullptr);
    dGeomTransformSetGeom(transform, inner);
    dGeomTransformSetInfo(transform, information);
    dGeomTransformSetCleanup(transform, 1);
    dGeomSetBody(transform, car_.body);
    expectShared(transform, mesh_.geom);
    const dSpaceID space = dSimpleSpaceCreate(nullptr);
    dSpaceAdd(space, transform);
    expectShared(reinterpret_cast<dGeomID>(space), mesh_.geom);
    dSpaceDestroy(space);
  }
}

#pragma GCC diagnostic pop

// Contacts that do not say what they touch are those of the pair that was collided.
TEST_F(ContactGeoms, NoGeomOrOneThatNobodyKnows) {
  const auto setGeoms = [&](dGeomID geom) {
    return [geom](dContact& contact) { contact.geom.g1 = contact.geom.g2 = geom; };
  };
  expectShared(car_.geom, mesh_.geom, setGeoms(nullptr));
  const dGeomID part = dCreateSphere(nullptr, 1.0);
  expectShared(car_.geom, mesh_.geom, setGeoms(part));
  dGeomDestroy(part);
}

}  // namespace
}  // namespace bumper::tests
