// The foot of a wall is the wall's for the chassis, and the wheels' ground.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <random>
#include <vector>

#include "bumper/engine_adapter/responder.h"
#include "ode_world.h"
#include "wall_profiles.h"

namespace bumper::tests {
namespace {

/// A box with a wheel that is a body of its own; its front is at x = 0, the ground at z = 0.
class BoxOnWheel {
 public:
  static constexpr double length = 4.0;
  static constexpr double height = 0.9;  // of its upper side above the ground

  BoxOnWheel(dWorldID world, double clearance)
      : chassis(dBodyCreate(world)),
        wheel(dBodyCreate(world)),
        box(dCreateBox(nullptr, length, 1.8, height - clearance)),
        tyre(dCreateSphere(nullptr, 0.32)),
        clearance_(clearance) {
    dMass mass;
    dMassSetBoxTotal(&mass, 1500.0, length, 1.8, 0.8);
    dBodySetMass(chassis, &mass);
    dMassSetSphereTotal(&mass, 20.0, 0.32);
    dBodySetMass(wheel, &mass);
    dGeomSetBody(box, chassis);
    dGeomSetBody(tyre, wheel);
  }
  ~BoxOnWheel() {
    dGeomDestroy(box);
    dGeomDestroy(tyre);
    dBodyDestroy(chassis);
    dBodyDestroy(wheel);
  }
  BoxOnWheel(const BoxOnWheel&) = delete;
  BoxOnWheel& operator=(const BoxOnWheel&) = delete;
  BoxOnWheel(BoxOnWheel&&) = delete;
  BoxOnWheel& operator=(BoxOnWheel&&) = delete;

  /// `wheelX` is where the wheel's front is.
  void place(const Eigen::Isometry3d& place, double wheelX) const {
    put(chassis, place, {-0.5 * length, 0.0, 0.55});
    dGeomSetOffsetPosition(box, 0.0, 0.0, 0.5 * (clearance_ + height) - 0.55);
    put(wheel, place, {wheelX - 0.32, 0.0, 0.32});
  }

  VehicleId addTo(Responder& responder) const {
    const std::vector<dBodyID> linked{wheel};
    const VehicleParameters parameters =
        parametersFromBodies(chassis, linked, 0.5 * length, 0.5 * length, 1.8, 0.55);
    return responder.addVehicle(chassis, parameters, {.linkedBodies = linked});
  }

  dBodyID chassis;
  dBodyID wheel;
  dGeomID box;
  dGeomID tyre;

 private:
  static void put(dBodyID body, const Eigen::Isometry3d& place, const Eigen::Vector3d& local) {
    const Eigen::Vector3d p = place * local;
    const Eigen::Matrix3d r = place.rotation();
    dBodySetPosition(body, p.x(), p.y(), p.z());
    const dMatrix3 rotation = {r(0, 0), r(0, 1), r(0, 2), 0.0,     r(1, 0), r(1, 1),
                               r(1, 2), 0.0,     r(2, 0), r(2, 1), r(2, 2), 0.0};
    dBodySetRotation(body, rotation);
  }

  double clearance_;
};

constexpr int mostContacts = 4096;

/// Contacts by what they are with: the piece of the profile.
struct Contacts {
  std::vector<std::size_t> found;
  std::vector<std::size_t> kept;
};

Contacts collide(const Responder& responder, dGeomID geom, dGeomID mesh,
                 const std::vector<std::size_t>& pieceOf) {
  std::vector<dContact> contacts(mostContacts);
  int count = dCollide(geom, mesh, mostContacts, &contacts[0].geom, sizeof(dContact));
  const auto pieces = [&] {
    std::vector<std::size_t> result;
    for (int i = 0; i < count; ++i) {
      result.push_back(
          pieceOf[static_cast<std::size_t>(contacts[static_cast<std::size_t>(i)].geom.side2)]);
    }
    return result;
  };
  Contacts result;
  result.found = pieces();
  count = responder.keepUnclaimed(geom, mesh, contacts.data(), count);
  result.kept = pieces();
  return result;
}

std::size_t countUpTo(std::size_t piece, const std::vector<std::size_t>& pieces) {
  return static_cast<std::size_t>(
      std::count_if(pieces.begin(), pieces.end(), [&](std::size_t each) { return each <= piece; }));
}

Eigen::Isometry3d somewhere(std::mt19937& random) {
  std::uniform_real_distribution<double> turn(-std::numbers::pi, std::numbers::pi);
  std::uniform_real_distribution<double> away(-100.0, 100.0);
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translate(Eigen::Vector3d(away(random), away(random), 0.1 * away(random)));
  place.rotate(Eigen::AngleAxisd(turn(random), Eigen::Vector3d::UnitZ()));
  return place;
}

constexpr double coarse = 100.0;

class Profiles : public ::testing::TestWithParam<double> {};

TEST_P(Profiles, WhatIsAtTheFootOfAWallIsTheWalls) {
  std::mt19937 random(11);
  for (const WallProfile& profile : wallProfiles()) {
    SCOPED_TRACE(profile.name);
    const Eigen::Isometry3d place = somewhere(random);
    const ProfileScene profileScene(profile, GetParam(), place);
    OdeWorld ode;
    const OdeMesh mesh(nullptr, profileScene.scene);
    Responder responder(ode.world);
    responder.addBarrier(mesh.geom);
    // The last touches the ground with its whole length.
    for (const double clearance : {0.15, 0.3, -0.005}) {
      const BoxOnWheel car(ode.world, clearance);
      const VehicleId vehicle = car.addTo(responder);
      for (const double depth : {0.001, 0.02}) {
        for (const double yaw : {0.0, 0.02, -0.3}) {
          Eigen::Isometry3d at = place;
          at.translate(Eigen::Vector3d(profile.faceX + depth, 0.0, profile.groundZ));
          at.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
          // The corner that turning takes nearest stays at the face.
          at.translate(Eigen::Vector3d(-0.9 * std::abs(std::sin(yaw)), 0.0, 0.0));
          car.place(at, -1.0);
          const Contacts contacts = collide(responder, car.box, mesh.geom, profileScene.pieceOf);
          const std::size_t ground = countUpTo(profile.ground, contacts.found);
          // At the face a wall that leans is touched by a low car alone.
          if (depth > 0.01) {
            EXPECT_GT(contacts.found.size(), ground) << clearance << ' ' << yaw;
          }
          EXPECT_EQ(contacts.kept.size(), ground) << clearance << ' ' << depth << ' ' << yaw;
          EXPECT_EQ(countUpTo(profile.ground, contacts.kept), ground);
          EXPECT_EQ(ground > 0, clearance < 0.0);
          EXPECT_FALSE(responder.claims(car.box, mesh.geom));
        }
      }
      responder.removeVehicle(vehicle);
    }
  }
}

// The wall's own triangles without the ground, as a geom of Bumper's.
TEST_P(Profiles, WallsOnly) {
  std::mt19937 random(12);
  for (const WallProfile& profile : wallProfiles()) {
    if (profile.groundZ > 0.0) continue;  // its kerb is another wall
    SCOPED_TRACE(profile.name);
    const Eigen::Isometry3d place = somewhere(random);
    const ProfileScene profileScene(profile, GetParam(), place);
    OdeWorld ode;
    Responder responder(ode.world);
    const dGeomID geom = responder.geom(responder.addBarrier(profileScene.scene));
    const BoxOnWheel car(ode.world, 0.05);
    car.addTo(responder);
    Eigen::Isometry3d at = place;
    at.translate(Eigen::Vector3d(profile.faceX + 0.02, 0.0, 0.0));
    car.place(at, -1.0);
    std::vector<dContact> contacts(mostContacts);
    const int found = dCollide(car.box, geom, mostContacts, &contacts[0].geom, sizeof(dContact));
    EXPECT_GT(found, 0);
    EXPECT_EQ(responder.keepUnclaimed(car.box, geom, contacts.data(), found), 0);
  }
}

TEST_P(Profiles, WheelsClimbIt) {
  std::mt19937 random(13);
  std::size_t onFoot = 0;
  std::size_t onWall = 0;
  for (const WallProfile& profile : wallProfiles()) {
    // Of the others the lowest piece is the wall, or may be.
    const bool isLow = profile.points.size() == 4 && profile.points[1].y() < 0.3;
    if (!isLow || profile.groundZ > 0.0) continue;
    SCOPED_TRACE(profile.name);
    const Eigen::Isometry3d place = somewhere(random);
    const ProfileScene profileScene(profile, GetParam(), place);
    OdeWorld ode;
    const OdeMesh mesh(nullptr, profileScene.scene);
    Responder responder(ode.world);
    responder.addBarrier(mesh.geom);
    const BoxOnWheel car(ode.world, 0.15);
    car.addTo(responder);
    for (double x = profile.points.front().x(); x < 0.05; x += 0.01) {
      Eigen::Isometry3d at = place;
      at.translate(Eigen::Vector3d(profile.faceX - 1.0, 0.0, 0.0));
      car.place(at, 1.0 + x);
      const Contacts contacts = collide(responder, car.tyre, mesh.geom, profileScene.pieceOf);
      const std::size_t rest = countUpTo(2, contacts.found);
      EXPECT_EQ(countUpTo(2, contacts.kept), rest) << x;
      EXPECT_EQ(contacts.kept.size(), rest) << x;
      onFoot += rest - countUpTo(ProfileScene::road, contacts.found);
      onWall += contacts.found.size() - rest;
    }
  }
  EXPECT_GT(onFoot, 0U);
  EXPECT_GT(onWall, 0U);
}

/// What of a car's contacts is kept, if its front is at the face of a wall.
Contacts atTheFace(const WallProfile& profile, double fineness) {
  const Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  const ProfileScene profileScene(profile, fineness, origin);
  OdeWorld ode;
  const OdeMesh mesh(nullptr, profileScene.scene);
  Responder responder(ode.world);
  responder.addBarrier(mesh.geom);
  const BoxOnWheel car(ode.world, 0.05);
  car.addTo(responder);
  car.place(Eigen::Isometry3d(Eigen::Translation3d(profile.faceX + 0.01, 0.0, 0.0)), -1.0);
  return collide(responder, car.box, mesh.geom, profileScene.pieceOf);
}

// A beam on the face of a wall that goes on behind it.
TEST_P(Profiles, TheFrontOfABeamAboveTheBandIsOdes) {
  const Contacts contacts = atTheFace(
      {.name = "beam",
       .points = {{0.0, 0.0}, {0.0, 3.0}, {0.0, 0.85}, {-0.3, 0.85}, {-0.3, 0.8}, {0.0, 0.8}}},
      GetParam());
  const auto front = [](const std::vector<std::size_t>& pieces) {
    return countUpTo(4, pieces) - countUpTo(3, pieces);
  };
  EXPECT_GT(front(contacts.found), 0U);
  EXPECT_EQ(front(contacts.kept), front(contacts.found));
}

// A kerb in two steps.
TEST_P(Profiles, TheFootOfAWallBelowTheBandIsOdes) {
  const Contacts contacts = atTheFace(
      {.name = "steps", .points = {{-0.1, 0.0}, {-0.1, 0.1}, {0.0, 0.1}, {0.0, 0.25}}}, GetParam());
  EXPECT_FALSE(contacts.found.empty());
  EXPECT_EQ(contacts.kept, contacts.found);
}

INSTANTIATE_TEST_SUITE_P(Fineness, Profiles, ::testing::Values(coarse, 0.5, 0.15));

}  // namespace
}  // namespace bumper::tests
