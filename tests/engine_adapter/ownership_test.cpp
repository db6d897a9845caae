// Which contacts are Bumper's and which stay ODE's: each has exactly one owner.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "hinge2_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double h = 0.005;
constexpr double gravity = 9.81;

void addQuad(Scene& scene, std::uint32_t mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
             const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), {a, b, c, d});
  scene.triangles.push_back({.corners = {first, first + 1, first + 2}, .mesh = mesh});
  scene.triangles.push_back({.corners = {first, first + 2, first + 3}, .mesh = mesh});
}

// Ground z = 0 and, at y = 0, a wall between two heights, in rows that share their vertices.
Scene roadWithWall(double foot, double top, std::size_t rows) {
  Scene scene = straightWall({-60.0, 0.0}, {60.0, 0.0}, top - foot, 24, rows);
  for (Eigen::Vector3d& vertex : scene.vertices) vertex.z() += foot;
  scene.meshes.push_back({.name = "road", .material = "asphalt", .colour = {0.3F, 0.3F, 0.3F}});
  for (int i = -6; i < 6; ++i) {
    const double x = 10.0 * i;
    addQuad(scene, 1, {x, -20.0, 0.0}, {x + 10.0, -20.0, 0.0}, {x + 10.0, 20.0, 0.0},
            {x, 20.0, 0.0});
  }
  return scene;
}

bool isOnWall(dGeomID mesh, const dContactGeom& contact) {
  const int triangle = contact.g1 == mesh ? contact.side1 : contact.side2;
  dVector3 a, b, c;
  dGeomTriMeshGetTriangle(mesh, triangle, &a, &b, &c);
  const Eigen::Vector3d u(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  const Eigen::Vector3d v(c[0] - a[0], c[1] - a[1], c[2] - a[2]);
  return std::abs(u.cross(v).normalized().z()) < 0.3;
}

struct Tally {
  int wallJoints = 0;
  int lostGround = 0;
  int wallContacts = 0;
  int groundContacts = 0;
  std::size_t events = 0;
};

// Counts over one step what dCollide found on the mesh and what became a joint.
void count(const OdeWorld& ode, dGeomID mesh, Tally& tally) {
  int foundGround = 0;
  int keptGround = 0;
  for (const dContactGeom& contact : ode.found) {
    if (contact.g1 != mesh && contact.g2 != mesh) continue;
    if (isOnWall(mesh, contact)) {
      ++tally.wallContacts;
    } else {
      ++foundGround;
    }
  }
  for (const dContactGeom& contact : ode.contacts) {
    if (contact.g1 != mesh && contact.g2 != mesh) continue;
    if (isOnWall(mesh, contact)) {
      ++tally.wallJoints;
    } else {
      ++keptGround;
    }
  }
  tally.groundContacts += foundGround;
  tally.lostGround += foundGround - keptGround;
}

// A wall in four rows: the lowest lies below the band, and is still the same wall.
TEST(Ownership, RoadAndWallInOneMesh) {
  OdeWorld ode(gravity);
  const OdeMesh mesh(ode.space, roadWithWall(0.0, 1.0, 4));
  Responder responder(ode.world);
  responder.addBarrier(mesh.geom);
  Hinge2Car car(ode.world, ode.space, {-20.0, 6.0}, 0.0, -20.0 * degree, 18.0);
  responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});

  Tally tally;
  double deepest = 0.0;
  for (int i = 0; i < 500; ++i) {
    ode.step(h, &responder, [&] { tally.events += responder.step(h).size(); });
    count(ode, mesh.geom, tally);
    const dReal* r = dBodyGetRotation(car.chassis);
    const double reach = std::abs(r[4]) * Hinge2Car::front + std::abs(r[5]) * 0.9;
    deepest = std::max(deepest, reach - dBodyGetPosition(car.chassis)[1]);
  }
  EXPECT_GE(tally.events, 1U);
  EXPECT_GT(tally.wallContacts, 0);  // dCollide did find the wall
  EXPECT_EQ(tally.wallJoints, 0);
  EXPECT_GT(tally.groundContacts, 1000);
  EXPECT_EQ(tally.lostGround, 0);
  EXPECT_GT(car.velocity().y(), -0.5);  // turned away from the wall
  EXPECT_GT(car.massCentre().y(), 0.8);
  // One step at the speed towards the wall, 18 sin 20° m/s · 5 ms = 31 mm, and as much again while
  // it turns.
  EXPECT_LT(deepest, 0.08);
}

// A slab 0.3 m thick on the ground, both sides and the top; each face twice if asked for.
Scene slabOnGround(double top, bool doubled) {
  Scene scene = roadWithWall(0.0, top, 1);
  const Scene back = straightWall({60.0, -0.3}, {-60.0, -0.3}, top, 24, 1);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), back.vertices.begin(), back.vertices.end());
  for (Scene::Triangle triangle : back.triangles) {
    for (std::uint32_t& corner : triangle.corners) corner += first;
    scene.triangles.push_back(triangle);
  }
  for (int i = -12; i < 12; ++i) {
    const double x = 5.0 * i;
    addQuad(scene, 0, {x, -0.3, top}, {x + 5.0, -0.3, top}, {x + 5.0, 0.0, top}, {x, 0.0, top});
  }
  if (doubled) {
    const std::vector<Scene::Triangle> once = scene.triangles;
    scene.triangles.insert(scene.triangles.end(), once.begin(), once.end());
  }
  return scene;
}

// A chassis that is taller than the wall has contacts with the wall's flat top as well; as joints
// they would answer the hit a second time, or throw the car up.
TEST(Ownership, TheTopOfAWallIsTheWalls) {
  for (const bool doubled : {false, true}) {
    for (const double top : {0.5, 0.75, 0.95, 1.0, 1.05}) {
      OdeWorld ode(gravity);
      const OdeMesh mesh(ode.space, slabOnGround(top, doubled));
      Responder responder(ode.world);
      responder.addBarrier(mesh.geom);
      BoxCar car(ode.world, ode.space);
      dGeomBoxSetLengths(car.geom, 4.6, 1.8, 1.1);  // from 0 to 1.1 m
      dGeomSetOffsetPosition(car.geom, -0.2, 0.0, 0.0);
      responder.addVehicle(car.body, car.parameters);
      const Eigen::Matrix3d axes =
          Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      car.place({1.7, 2.5, 0.551}, axes);
      car.move({0.0, -20.0, 0.0}, Eigen::Vector3d::Zero());
      ode.friction = 0.0;
      double highest = 0.0;
      double promised = 0.0;
      std::size_t events = 0;
      for (int i = 0; i < 60; ++i) {
        ode.step(h, &responder, [&] {
          for (const ImpactEvent& event : responder.step(h)) {
            ++events;
            promised = event.velocityAfter.y();
          }
        });
        highest = std::max(highest, car.massCentreHeight());
      }
      EXPECT_EQ(events, 1U) << top;
      EXPECT_NEAR(car.velocity().y(), promised, 0.02) << top;
      EXPECT_LT(highest, 0.56) << top;
    }
  }
}

// The same top is ground for a car that drives on it, and a ramp is for one that drives up it.
TEST(Ownership, GroundBehindARetainingWallIsGround) {
  OdeWorld ode(gravity);
  // A ramp from z = 0 at x = 0 to 1 m at x = 10, level from there on, between side walls that reach
  // up to its surface.
  Scene scene;
  scene.name = "ramp";
  scene.meshes.push_back({.name = "ramp", .material = "concrete", .colour = {0.5F, 0.5F, 0.5F}});
  addQuad(scene, 0, {-20, -2, 0}, {0, -2, 0}, {0, 2, 0}, {-20, 2, 0});
  addQuad(scene, 0, {0, -2, 0}, {10, -2, 1}, {10, 2, 1}, {0, 2, 0});
  addQuad(scene, 0, {10, -2, 1}, {60, -2, 1}, {60, 2, 1}, {10, 2, 1});
  for (const double side : {-2.0, 2.0}) {
    addQuad(scene, 0, {0, side, -1}, {10, side, -1}, {10, side, 1}, {0, side, 0});
    addQuad(scene, 0, {10, side, -1}, {60, side, -1}, {60, side, 1}, {10, side, 1});
  }
  const OdeMesh mesh(ode.space, scene);
  Responder responder(ode.world);
  responder.addBarrier(mesh.geom);
  Hinge2Car car(ode.world, ode.space, {-8.0, 0.0}, 0.0, 0.0, 8.0);
  car.drive(8.0, 300.0);
  responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});
  std::size_t events = 0;
  for (int i = 0; i < 800; ++i) {
    ode.step(h, &responder, [&] { events += responder.step(h).size(); });
    EXPECT_EQ(ode.contacts.size(), ode.found.size());
  }
  EXPECT_EQ(events, 0U);
  EXPECT_GT(car.massCentre().x(), 12.0);
  EXPECT_NEAR(car.massCentre().z(), 1.6, 0.15);
}

TEST(Ownership, AWallsOnlyBarrierIsClaimedWhole) {
  OdeWorld ode;
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0, 5, 3),
                                                 {.space = ode.space});
  BoxCar car(ode.world, ode.space);
  responder.addVehicle(car.body, car.parameters);
  car.place({0.0, 0.8, 0.55}, Eigen::Matrix3d::Identity());
  EXPECT_TRUE(responder.claims(car.geom, responder.geom(barrier)));
  EXPECT_TRUE(responder.claims(responder.geom(barrier), car.geom));
  EXPECT_FALSE(responder.claims(car.geom, car.geom));
  // Off the ground by more than the wall is tall: not the outline's any more.
  car.place({0.0, 0.8, 3.0}, Eigen::Matrix3d::Identity());
  EXPECT_FALSE(responder.claims(car.geom, responder.geom(barrier)));
}

TEST(Ownership, AKerbBelowTheBandIsOdes) {
  OdeWorld ode(gravity);
  const OdeMesh mesh(ode.space, roadWithWall(0.0, 0.12, 1));
  Responder responder(ode.world);
  responder.addBarrier(mesh.geom);
  Hinge2Car car(ode.world, ode.space, {0.0, 3.0}, 0.0, -60.0 * degree, 4.0);
  responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});
  Tally tally;
  for (int i = 0; i < 150; ++i) {
    ode.step(h, &responder, [&] { tally.events += responder.step(h).size(); });
    count(ode, mesh.geom, tally);
  }
  EXPECT_EQ(tally.events, 0U);
  EXPECT_GT(tally.wallContacts, 0);
  EXPECT_EQ(tally.wallJoints, tally.wallContacts);
}

TEST(Ownership, ABeamAboveTheBandIsOdes) {
  OdeWorld ode;
  const OdeMesh mesh(ode.space, roadWithWall(2.0, 3.0, 1));
  Responder responder(ode.world);
  responder.addBarrier(mesh.geom);
  BoxCar car(ode.world, ode.space);
  // A mast on the roof reaches the beam.
  const dGeomID mast = dCreateBox(ode.space, 0.3, 0.3, 2.0);
  dGeomSetBody(mast, car.body);
  dGeomSetOffsetPosition(mast, 0.0, 0.0, 1.3);
  responder.addVehicle(car.body, car.parameters);
  car.place({0.0, 2.0, 0.55}, Eigen::Matrix3d::Identity());
  car.move({0.0, -4.0, 0.0}, Eigen::Vector3d::Zero());
  Tally tally;
  for (int i = 0; i < 200; ++i) {
    ode.step(h, &responder, [&] { tally.events += responder.step(h).size(); });
    count(ode, mesh.geom, tally);
  }
  EXPECT_EQ(tally.events, 0U);
  EXPECT_GT(tally.wallJoints, 0);
  dGeomDestroy(mast);
}

TEST(Ownership, AFreeBallBouncesOffTheSameWall) {
  OdeWorld ode;
  ode.bounce = 0.8;
  Responder responder(ode.world);
  responder.addBarrier(straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0, 5, 3), {.space = ode.space});
  BoxCar car(ode.world, ode.space);
  car.place({20.0, 10.0, 0.55}, Eigen::Matrix3d::Identity());
  responder.addVehicle(car.body, car.parameters);
  const dBodyID ball = dBodyCreate(ode.world);
  dMass mass;
  dMassSetSphereTotal(&mass, 5.0, 0.2);
  dBodySetMass(ball, &mass);
  dBodySetPosition(ball, 0.0, 2.0, 0.5);
  dBodySetLinearVel(ball, 0.0, -10.0, 0.0);
  const dGeomID sphere = dCreateSphere(ode.space, 0.2);
  dGeomSetBody(sphere, ball);
  for (int i = 0; i < 80; ++i) {
    ode.step(h, &responder, [&] { EXPECT_TRUE(responder.step(h).empty()); });
  }
  EXPECT_NEAR(dBodyGetLinearVel(ball)[1], 8.0, 0.2);
  dGeomDestroy(sphere);
  dBodyDestroy(ball);
}

TEST(Ownership, ACarOnItsRoofIsHeldByOrdinaryContacts) {
  OdeWorld ode(gravity);
  const OdeMesh mesh(ode.space, roadWithWall(0.0, 1.0, 2));
  Responder responder(ode.world);
  responder.addBarrier(mesh.geom);
  BoxCar car(ode.world, ode.space);
  const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
  // Upside down, sliding sideways into the wall.
  car.place({0.0, 2.0, 0.36},
            Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix());
  car.move({0.0, -6.0, 0.0}, Eigen::Vector3d::Zero());
  ode.friction = 0.1;
  Tally tally;
  for (int i = 0; i < 400; ++i) {
    ode.step(h, &responder, [&] { tally.events += responder.step(h).size(); });
    count(ode, mesh.geom, tally);
    EXPECT_EQ(responder.issues(vehicle), step_issue::tilted);
  }
  EXPECT_EQ(tally.events, 0U);
  EXPECT_GT(tally.wallContacts, 0);
  EXPECT_EQ(tally.wallJoints, tally.wallContacts);
  EXPECT_EQ(tally.lostGround, 0);
  const dReal* place = dBodyGetPosition(car.body);
  EXPECT_GT(place[1], 0.8);   // the wall stopped it
  EXPECT_GT(place[2], 0.25);  // the ground carries it
}

// Between two trimeshes ODE makes contacts without a triangle's number.
TEST(Ownership, AChassisThatIsATrimesh) {
  for (const bool chassisFirst : {true, false}) {
    OdeWorld ode;
    const OdeMesh mesh(ode.space, roadWithWall(0.0, 1.0, 2));
    Responder responder(ode.world);
    responder.addBarrier(mesh.geom);
    BoxCar car(ode.world);
    Scene shape;
    shape.meshes.push_back({.name = "shape", .material = "", .colour = {0.5F, 0.5F, 0.5F}});
    for (const double side : {-0.9, 0.9}) {
      addQuad(shape, 0, {-2.5, side, -0.2}, {2.1, side, -0.2}, {2.1, side, 0.4}, {-2.5, side, 0.4});
    }
    addQuad(shape, 0, {-2.5, -0.9, -0.2}, {2.1, -0.9, -0.2}, {2.1, 0.9, -0.2}, {-2.5, 0.9, -0.2});
    const OdeMesh body(nullptr, shape);
    dGeomSetBody(body.geom, car.body);
    responder.addVehicle(car.body, car.parameters);
    car.place({0.3, 0.85, 0.55},
              Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitZ()).toRotationMatrix());
    const dGeomID a = chassisFirst ? body.geom : mesh.geom;
    const dGeomID b = chassisFirst ? mesh.geom : body.geom;
    dContact contacts[64] = {};
    const int found = dCollide(a, b, 64, &contacts[0].geom, sizeof(dContact));
    EXPECT_GT(found, 0);
    EXPECT_EQ(responder.keepUnclaimed(a, b, contacts, found), 0);
  }
}

// The wheels are the vehicle's too: their contacts with walls are not ODE's.
TEST(Ownership, WheelsBelongToTheVehicle) {
  OdeWorld ode;
  Responder responder(ode.world);
  const BarrierId barrier =
      responder.addBarrier(straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0), {.space = ode.space});
  Hinge2Car car(ode.world, ode.space, {0.0, 1.0}, 0.0, 0.0, 0.0);
  responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});
  for (const dGeomID tyre : car.tyres) EXPECT_TRUE(responder.claims(tyre, responder.geom(barrier)));
}

}  // namespace
}  // namespace bumper::tests
