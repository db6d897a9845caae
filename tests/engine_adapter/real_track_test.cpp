// A four-wheel car on a real race track whose road and walls are one trimesh.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/contact_solve.h"
#include "bumper/response/restitution_law.h"
#include "bumper/scenes/scene_files.h"
#include "hinge2_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;
constexpr double gravity = 9.81;

std::filesystem::path aalborg() {
  return std::filesystem::path(BUMPER_TRACKS_DIR) / "road/aalborg/aalborg.acc";
}

bool isWall(dGeomID mesh, const dContactGeom& contact) {
  dVector3 a, b, c;
  dGeomTriMeshGetTriangle(mesh, contact.g1 == mesh ? contact.side1 : contact.side2, &a, &b, &c);
  const Eigen::Vector3d u(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  const Eigen::Vector3d v(c[0] - a[0], c[1] - a[1], c[2] - a[2]);
  return std::abs(u.cross(v).normalized().z()) <= 0.3;
}

// A place above the main straight, whose left wall stands at y = 492.4 m.
constexpr double skyHeight = 20.0;

class RealTrack : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(aalborg())) {
      GTEST_SKIP() << aalborg() << " is not there: examples/fetch_tracks.sh road/aalborg gets it";
    }
    scene = loadTrustedScene(aalborg(), {.up = UpAxis::y});
  }
  Scene scene;
};

TEST_F(RealTrack, AFourWheelCarHitsItsWalls) {
  OdeWorld ode(gravity);
  const OdeMesh mesh(ode.space, scene);
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(mesh.geom, {.name = "aalborg"});
  EXPECT_EQ(responder.report(barrier).walls + responder.report(barrier).dropped(),
            scene.triangles.size());

  // On the main straight, towards its left wall.
  Hinge2Car car(ode.world, ode.space, {330.0, 486.5}, mesh.heightBelow(330.0, 486.5, skyHeight),
                0.15, 25.0);
  const VehicleId vehicle =
      responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});

  std::size_t impacts = 0;
  int wallContacts = 0;
  int groundContacts = 0;
  for (int i = 0; i < 600; ++i) {
    const Eigen::Vector3d placeBefore = car.massCentre();
    ode.step(h, &responder, [&] {
      const double start = responder.time();
      bool first = true;
      for (const ImpactEvent& event : responder.step(h)) {
        if (event.phase != EventPhase::impact) continue;
        ++impacts;
        const VehicleParameters now = car.parameters();
        EXPECT_NEAR(event.normal.z(), 0.0, 0.2);
        EXPECT_NEAR(event.deltaV, std::hypot(event.impulseNormal, event.impulseTangent) / now.mass,
                    1e-9);
        // Of a later one the yaw at the impact is not known here.
        if (!std::exchange(first, false)) continue;
        // The law's own numbers for what the event says of the contact.
        const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> axes(
            dBodyGetRotation(car.chassis));
        const Vector2 normal = rotated((axes.leftCols<3>().transpose() * event.normal).head<2>(),
                                       -event.yawRateBefore * (event.time - start));
        const ContactBody body{.inverseMass = 1.0 / now.mass,
                               .inverseYawInertia = 1.0 / now.yawInertia,
                               .arm = event.arm};
        const ContactMobility mobility = contactMobility(body, {}, normal);
        const double denominator = mobility.normal + event.impulseRatio * mobility.coupling;
        const double law = (1.0 + event.restitution) * event.approachSpeed / denominator;
        EXPECT_NEAR(event.impulseNormal, law, 1e-9 * law);
      }
    });
    EXPECT_EQ(responder.issues(vehicle), step_issue::none);
    // Flat contacts as high as the band are the tops of the walls that the chassis is in.
    const Eigen::Vector3d up = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(
                                   dBodyGetRotation(car.chassis))
                                   .col(2);
    const double bottom = 0.3 - car.parameters().massCentreHeight;
    const auto isPartOfWall = [&](const dContactGeom& contact) {
      const Eigen::Map<const Eigen::Vector3d> place(contact.pos);
      return isWall(mesh.geom, contact) || up.dot(place - placeBefore) > bottom;
    };
    int foundGround = 0;
    int keptGround = 0;
    for (const dContactGeom& contact : ode.found) {
      if (contact.g1 != mesh.geom && contact.g2 != mesh.geom) continue;
      if (isPartOfWall(contact)) {
        ++wallContacts;
      } else {
        ++foundGround;
      }
    }
    for (const dContactGeom& contact : ode.contacts) {
      if (contact.g1 != mesh.geom && contact.g2 != mesh.geom) continue;
      // A wall joint would be one whose wall lies outside the band: there is none on this straight.
      EXPECT_FALSE(isPartOfWall(contact)) << "step " << i;
      ++keptGround;
    }
    EXPECT_EQ(keptGround, foundGround);
    groundContacts += foundGround;
  }
  EXPECT_GE(impacts, 2U) << "at " << car.massCentre().transpose() << ", "
                         << car.velocity().transpose();
  EXPECT_GT(wallContacts, 0);
  EXPECT_GT(groundContacts, 1000);
}

TEST_F(RealTrack, AFreeBallBouncesOffTheSameWall) {
  OdeWorld ode;
  ode.bounce = 0.8;
  ode.friction = 0.0;
  const OdeMesh mesh(ode.space, scene);
  Responder responder(ode.world);
  responder.addBarrier(mesh.geom);
  const dBodyID ball = dBodyCreate(ode.world);
  dMass mass;
  dMassSetSphereTotal(&mass, 5.0, 0.15);
  dBodySetMass(ball, &mass);
  // Low over the main straight, towards its left wall.
  dBodySetPosition(ball, 300.0, 484.5, 5.7);
  dBodySetLinearVel(ball, 0.0, 20.0, 0.0);
  const dGeomID sphere = dCreateSphere(ode.space, 0.15);
  dGeomSetBody(sphere, ball);
  std::size_t joints = 0;
  for (int i = 0; i < 400 && joints == 0; ++i) {
    ode.step(h, &responder, [&] { EXPECT_TRUE(responder.step(h).empty()); });
    joints += ode.contacts.size();
  }
  EXPECT_GT(joints, 0U);
  EXPECT_LT(dBodyGetLinearVel(ball)[1], -10.0);
  dGeomDestroy(sphere);
  dBodyDestroy(ball);
}

TEST_F(RealTrack, ACarOnItsRoofIsHeldByOrdinaryContacts) {
  OdeWorld ode(gravity);
  const OdeMesh mesh(ode.space, scene);
  Responder responder(ode.world);
  responder.addBarrier(mesh.geom);
  const double road = mesh.heightBelow(300.0, 484.5, skyHeight);
  Hinge2Car car(ode.world, ode.space, {300.0, 484.5}, road, 0.0, 0.0);
  const VehicleId vehicle =
      responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});
  // Turned over about its own x axis, wheels and all.
  const Eigen::Vector3d pivot = car.massCentre();
  const auto turnOver = [&](dBodyID body) {
    const dReal* p = dBodyGetPosition(body);
    dBodySetPosition(body, p[0], 2.0 * pivot.y() - p[1], 2.0 * pivot.z() - p[2]);
    dMatrix3 flip;
    dRFromAxisAndAngle(flip, 1.0, 0.0, 0.0, std::numbers::pi);
    dBodySetRotation(body, flip);
  };
  turnOver(car.chassis);
  for (dBodyID wheel : car.wheels) turnOver(wheel);
  std::size_t joints = 0;
  for (int i = 0; i < 400; ++i) {
    ode.step(h, &responder, [&] { EXPECT_TRUE(responder.step(h).empty()); });
    EXPECT_EQ(responder.issues(vehicle), step_issue::tilted);
    joints += ode.contacts.size();
  }
  EXPECT_GT(joints, 400U);
  EXPECT_NEAR(dBodyGetPosition(car.chassis)[2], road + 0.5 * Hinge2Car::height, 0.1);
}

}  // namespace
}  // namespace bumper::tests
