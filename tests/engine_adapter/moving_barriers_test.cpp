#include <gtest/gtest.h>
#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/response/outline.h"
#include "bumper/scenes/paper_scenes.h"
#include "ode_world.h"

/// Barriers that move: with a body of ODE's, or as the application moves their geom.
namespace bumper::tests {
namespace {

using Eigen::Vector3d;

constexpr double height = 0.55;

/// A box across the x axis, 8 m wide, whose near face is at its place's x − 0.5.
dGeomID makeGate(dSpaceID space) { return dCreateBox(space, 1.0, 8.0, 2.0); }

/// The gate of a run: who moves it, and how its velocity is known.
enum class By { kinematic_body, successive_places, given_velocity, nobody };

struct Approach {
  double carSpeed = 0.0;
  double gateSpeed = 0.0;  ///< towards the car
  double offset = 0.0;
  double heading = 0.0;
  double h = 0.005;
  bool isPost = false;
};

struct Result {
  double time = 0.0;  ///< of the first impact
  Vector3d velocity = Vector3d::Zero();
  double yawRate = 0.0;
  int impacts = 0;
};

/// A car along x against a gate 6 m ahead that comes to meet it.
Result run(const Approach& approach, By by) {
  OdeWorld ode;
  BoxCar car(ode.world, ode.space);
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(approach.heading, Vector3d::UnitZ()).toRotationMatrix();
  car.place({0.0, approach.offset, height}, axes);
  car.move({approach.carSpeed, 0.0, 0.0}, Vector3d::Zero());
  const dGeomID gate = approach.isPost ? dCreateCylinder(ode.space, 0.3, 3.0) : makeGate(ode.space);
  double place = 6.0;
  const auto put = [&](double x) { dGeomSetPosition(gate, x, 0.0, 1.0); };
  put(place);
  dBodyID body = nullptr;
  if (by == By::kinematic_body) {
    body = dBodyCreate(ode.world);
    dBodySetKinematic(body);
    dBodySetPosition(body, place, 0.0, 1.0);
    dBodySetLinearVel(body, -approach.gateSpeed, 0.0, 0.0);
    dGeomSetBody(gate, body);
  }
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(gate);
  const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
  Result result;
  const double until = 7.0 / (approach.carSpeed + approach.gateSpeed);
  for (double time = 0.0; time < until; time += approach.h) {
    if (by == By::successive_places) responder.updateBarrier(barrier);
    if (by == By::given_velocity) {
      responder.updateBarrier(barrier, {.linear = {-approach.gateSpeed, 0.0, 0.0}});
    }
    ode.step(approach.h, &responder, [&] {
      for (const ImpactEvent& event : responder.step(approach.h)) {
        if (event.phase != EventPhase::impact) continue;
        if (result.impacts++ == 0) result.time = event.time;
      }
    });
    EXPECT_TRUE(ode.contacts.empty());
    place -= approach.h * approach.gateSpeed;
    if (by == By::successive_places || by == By::given_velocity) put(place);
  }
  result.velocity = responder.velocity(vehicle);
  result.yawRate = responder.yawRate(vehicle);
  if (body != nullptr) dBodyDestroy(body);
  return result;
}

TEST(MovingBarriers, AreHitAsStandingOnesByACarThatIsFasterByTheirSpeed) {
  int hits = 0;
  for (const double gateSpeed : {0.5, 5.0, 40.0}) {
    for (const double h : {0.001, 0.005, 0.0167}) {
      for (const bool isPost : {false, true}) {
        for (const double heading : {0.0, 0.3, -0.7}) {
          const Approach moving{.carSpeed = 3.0,
                                .gateSpeed = gateSpeed,
                                .offset = isPost ? 0.2 : 0.0,
                                .heading = heading,
                                .h = h,
                                .isPost = isPost};
          Approach standing = moving;
          standing.carSpeed += gateSpeed;
          standing.gateSpeed = 0.0;
          const Result reference = run(standing, By::nobody);
          EXPECT_GE(reference.impacts, 1);
          for (const By by : {By::kinematic_body, By::successive_places, By::given_velocity}) {
            const Result result = run(moving, by);
            const std::string what = std::to_string(gateSpeed) + " m/s, " + std::to_string(h) +
                                     " s, " + std::to_string(heading) + ", by " +
                                     std::to_string(static_cast<int>(by));
            EXPECT_EQ(result.impacts, reference.impacts) << what;
            EXPECT_NEAR(result.time, reference.time, 1e-9) << what;
            EXPECT_NEAR(result.velocity.x() + gateSpeed, reference.velocity.x(), 1e-8) << what;
            EXPECT_NEAR(result.velocity.y(), reference.velocity.y(), 1e-8) << what;
            EXPECT_NEAR(result.yawRate, reference.yawRate, 1e-8) << what;
            ++hits;
          }
        }
      }
    }
  }
  EXPECT_EQ(hits, 3 * 3 * 2 * 3 * 3);
}

TEST(MovingBarriers, AGatePushesACarThatStandsAndDoesNotPassIt) {
  for (const double speed : {0.3, 1.0, 5.0}) {
    for (const double h : {0.002, 0.005, 0.0167}) {
      OdeWorld ode;
      BoxCar car(ode.world, ode.space);
      const double heading = speed > 1.0 ? 0.2 : 0.0;
      car.place({0.0, 0.4, height},
                Eigen::AngleAxisd(heading, Vector3d::UnitZ()).toRotationMatrix());
      const dGeomID gate = makeGate(ode.space);
      double place = 4.0;
      dGeomSetPosition(gate, place, 0.0, 1.0);
      Responder responder(ode.world);
      const BarrierId barrier = responder.addBarrier(gate);
      const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
      double fastest = 0.0;
      for (double time = 0.0; time < 8.0 / speed; time += h) {
        responder.updateBarrier(barrier);
        ode.step(h, &responder, [&] { responder.step(h); });
        place -= h * speed;
        dGeomSetPosition(gate, place, 0.0, 1.0);
        fastest = std::max(fastest, responder.velocity(vehicle).norm());
        const Eigen::Quaterniond turn = responder.orientation(vehicle);
        for (const Vector2& corner : Outline(car.parameters).corners()) {
          const Vector3d at =
              responder.position(vehicle) + turn * Vector3d(corner.x(), corner.y(), 0.0);
          // It is hit from within the step before: its pulse lasts for one more.
          EXPECT_LE(at.x(), place - 0.5 + 1.2 * speed * h) << speed << " " << h << " " << time;
        }
      }
      // One that it turns first has, as seen from the gate, no more energy than before.
      EXPECT_LE(fastest, (heading == 0.0 ? 1.05 : 2.0) * speed + 1e-9) << speed << " " << h;
      EXPECT_GE(fastest, 0.9 * speed) << speed << " " << h;
    }
  }
}

TEST(MovingBarriers, ASleepingCarMovesInTheStepThatHitsIt) {
  OdeWorld ode;
  BoxCar car(ode.world, ode.space);
  car.place({0.0, 0.0, height}, Eigen::Matrix3d::Identity());
  const dGeomID gate = makeGate(ode.space);
  dBodyID body = dBodyCreate(ode.world);
  dBodySetKinematic(body);
  dGeomSetBody(gate, body);
  dBodySetPosition(body, 2.1 + 0.5 + 0.02, 0.0, 1.0);
  dBodySetLinearVel(body, -5.0, 0.0, 0.0);
  Responder responder(ode.world);
  responder.addBarrier(gate);
  responder.addVehicle(car.body, car.parameters);
  dBodyDisable(car.body);
  const auto events = responder.step(0.005);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].time, 0.004, 1e-9);
  EXPECT_NEAR(events[0].approachSpeed, 5.0, 1e-9);
  EXPECT_EQ(dBodyIsEnabled(car.body), 1);
  dWorldQuickStep(ode.world, 0.005);
  EXPECT_LT(car.velocity().x(), -0.5);
  dBodyDestroy(body);
}

TEST(MovingBarriers, OneThatForcesMoveTakesTheOppositeImpulse) {
  OdeWorld ode;
  BoxCar car(ode.world, ode.space);
  car.place({0.0, 0.0, height}, Eigen::Matrix3d::Identity());
  car.move({10.0, 0.0, 0.0}, Vector3d::Zero());
  const dGeomID geom = makeGate(ode.space);
  dBodyID container = dBodyCreate(ode.world);
  dMass mass;
  dMassSetBoxTotal(&mass, 40'000.0, 1.0, 8.0, 2.0);
  dBodySetMass(container, &mass);
  dGeomSetBody(geom, container);
  dBodySetPosition(container, 4.0, 0.0, height);
  dBodySetLinearVel(container, -2.0, 0.0, 0.0);
  Responder responder(ode.world);
  responder.addBarrier(geom);
  const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
  const double before = 1500.0 * 10.0 - 40'000.0 * 2.0;
  for (int i = 0; i < 100; ++i) ode.step(0.005, &responder, [&] { responder.step(0.005); });
  const double after =
      1500.0 * responder.velocity(vehicle).x() + 40'000.0 * dBodyGetLinearVel(container)[0];
  EXPECT_LT(responder.velocity(vehicle).x(), -2.0);
  EXPECT_NEAR(after, before, 1e-6);
  dBodyDestroy(container);
}

TEST(MovingBarriers, AGateThatSwingsHitsWithItsOwnSpeedThere) {
  for (const double h : {0.002, 0.0167}) {
    OdeWorld ode;
    BoxCar car(ode.world, ode.space);
    car.place({0.0, 0.0, height}, Eigen::Matrix3d::Identity());
    // Hinged at (2.6, −4), a leaf of 4 m that points along x swings towards the car's front.
    const dGeomID leaf = dCreateBox(ode.space, 4.0, 0.02, 2.0);
    dBodyID body = dBodyCreate(ode.world);
    dBodySetKinematic(body);
    dBodySetFiniteRotationMode(body, 1);
    dBodySetPosition(body, 2.6, -4.0, 1.0);
    dGeomSetBody(leaf, body);
    dGeomSetOffsetPosition(leaf, 2.0, 0.0, 0.0);
    dBodySetAngularVel(body, 0.0, 0.0, 2.0);
    Responder responder(ode.world);
    responder.addBarrier(leaf);
    const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
    double speed = 0.0;
    double when = 0.0;
    for (double time = 0.0; time < 1.2 && speed == 0.0; time += h) {
      ode.step(h, &responder, [&] {
        for (const ImpactEvent& event : responder.step(h)) {
          if (speed == 0.0) speed = event.approachSpeed, when = event.time;
        }
      });
    }
    // The leading edge of its end, 4 m from the hinge and 1 cm before the line through it, meets
    // the front at x = 2.1.
    double angle = 0.5 * std::numbers::pi;
    for (int i = 0; i < 50; ++i) angle = std::acos((0.01 * std::sin(angle) - 0.5) / 4.0);
    EXPECT_NEAR(when, angle / 2.0, 1e-6) << h;
    EXPECT_GT(speed, 7.5) << h;
    EXPECT_LT(speed, 8.0) << h;
    for (double time = 0.0; time < 0.05; time += h) {
      ode.step(h, &responder, [&] { responder.step(h); });
    }
    EXPECT_LT(responder.velocity(vehicle).x(), -0.3);
    dBodyDestroy(body);
  }
}

TEST(MovingBarriers, AreNotReadAnewAndLeaveWithoutATrace) {
  OdeWorld ode;
  const dGeomID gate = makeGate(ode.space);
  dGeomSetPosition(gate, 20.0, 0.0, 1.0);
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(gate);
  const WallReport* read = &responder.report(barrier);
  dGeomSetPosition(gate, 19.0, 0.0, 1.0);
  responder.updateBarrier(barrier);
  EXPECT_EQ(&responder.report(barrier), read);
  dGeomBoxSetLengths(gate, 1.0, 4.0, 2.0);
  responder.updateBarrier(barrier);
  EXPECT_NE(&responder.report(barrier), read);
  responder.removeBarrier(barrier);
  BoxCar car(ode.world);
  car.place({17.5, 0.0, height}, Eigen::Matrix3d::Identity());
  car.move({30.0, 0.0, 0.0}, Vector3d::Zero());
  responder.addVehicle(car.body, car.parameters);
  EXPECT_TRUE(responder.step(0.02).empty());
}

TEST(MovingBarriers, ThatAreMovedOnceDoNotPush) {
  OdeWorld ode;
  BoxCar car(ode.world, ode.space);
  car.place({0.0, 0.0, height}, Eigen::Matrix3d::Identity());
  const dGeomID gate = makeGate(ode.space);
  dGeomSetPosition(gate, 20.0, 0.0, 1.0);
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(gate);
  const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
  responder.step(0.005);
  dWorldQuickStep(ode.world, 0.005);
  // 10 cm into the front.
  dGeomSetPosition(gate, 2.5, 0.0, 1.0);
  responder.updateBarrier(barrier);
  for (int i = 0; i < 200; ++i) {
    ode.step(0.005, &responder, [&] { EXPECT_TRUE(responder.step(0.005).empty()); });
    EXPECT_LE(responder.velocity(vehicle).norm(), 1e-12);
  }
  EXPECT_LT(responder.position(vehicle).x(), -0.09);
}

TEST(MovingBarriers, OfASceneMoveWithTheirOwnGeom) {
  OdeWorld ode;
  BoxCar car(ode.world, ode.space);
  car.place({0.0, 0.0, height}, Eigen::Matrix3d::Identity());
  Responder responder(ode.world);
  const BarrierId barrier =
      responder.addBarrier(straightWall({6.0, -4.0}, {6.0, 4.0}, 2.0), {.space = ode.space});
  responder.addVehicle(car.body, car.parameters);
  EXPECT_THROW(responder.updateBarrier(barrier), Error);
  const dGeomID geom = responder.geom(barrier);
  const Vector3d from = Eigen::Map<const Vector3d>(dGeomGetPosition(geom));
  double hitAt = 0.0;
  double speed = 0.0;
  for (int i = 1; i < 200 && hitAt == 0.0; ++i) {
    dGeomSetPosition(geom, from.x() - 0.05 * i, from.y(), from.z());
    responder.updateBarrier(barrier);
    ode.step(0.005, &responder, [&] {
      for (const ImpactEvent& event : responder.step(0.005)) {
        hitAt = event.contact.x();
        speed = event.approachSpeed;
      }
    });
  }
  EXPECT_NEAR(hitAt, 2.1, 1e-9);
  EXPECT_NEAR(speed, 10.0, 1e-9);
}

TEST(MovingBarriers, OfASceneMoveWithABodyThatTheirGeomGets) {
  OdeWorld ode;
  BoxCar car(ode.world, ode.space);
  car.place({0.0, 0.0, height}, Eigen::Matrix3d::Identity());
  Responder responder(ode.world);
  const BarrierId barrier =
      responder.addBarrier(straightWall({6.0, -4.0}, {6.0, 4.0}, 2.0), {.space = ode.space});
  responder.addVehicle(car.body, car.parameters);
  const dGeomID geom = responder.geom(barrier);
  const Vector3d stands = Eigen::Map<const Vector3d>(dGeomGetPosition(geom));
  dBodyID body = dBodyCreate(ode.world);
  dBodySetKinematic(body);
  dBodySetPosition(body, 7.0, 1.0, 0.0);
  dBodySetLinearVel(body, -10.0, 0.0, 0.0);
  dGeomSetBody(geom, body);
  dGeomSetOffsetWorldPosition(geom, stands.x(), stands.y(), stands.z());
  responder.updateBarrier(barrier);
  double when = 0.0;
  double speed = 0.0;
  for (int i = 0; i < 100 && when == 0.0; ++i) {
    ode.step(0.005, &responder, [&] {
      for (const ImpactEvent& event : responder.step(0.005)) {
        when = event.time;
        speed = event.approachSpeed;
      }
    });
  }
  EXPECT_NEAR(when, 0.39, 1e-9);
  EXPECT_NEAR(speed, 10.0, 1e-9);
  // Without it, it stands still where it is.
  dGeomSetBody(geom, nullptr);
  dBodyDestroy(body);
  responder.updateBarrier(barrier);
  EXPECT_NO_THROW(responder.step(0.005));
}

TEST(MovingBarriers, AreSavedAndRestored) {
  OdeWorld ode;
  BoxCar car(ode.world, ode.space);
  const dGeomID gate = makeGate(ode.space);
  Responder responder(ode.world);
  dGeomSetPosition(gate, 4.0, 0.0, 1.0);
  const BarrierId barrier = responder.addBarrier(gate);
  const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
  double place = 4.0;
  const auto drive = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      place -= 0.05;
      dGeomSetPosition(gate, place, 0.0, 1.0);
      responder.updateBarrier(barrier);
      ode.step(0.005, &responder, [&] { responder.step(0.005); });
    }
  };
  car.place({0.0, 0.3, height}, Eigen::Matrix3d::Identity());
  drive(20);
  const SavedState saved = responder.save();
  ASSERT_EQ(saved.barriers.size(), 1U);
  const double then = place;
  const Vector3d position = responder.position(vehicle);
  drive(60);
  const Vector3d after = responder.velocity(vehicle);
  EXPECT_LT(after.x(), -5.0);
  place = then;
  dGeomSetPosition(gate, place, 0.0, 1.0);
  car.place(position, Eigen::Matrix3d::Identity());
  car.move(Vector3d::Zero(), Vector3d::Zero());
  responder.restore(saved);
  drive(60);
  EXPECT_EQ(after, responder.velocity(vehicle));
}

TEST(MovingBarriers, BadCallsNameThem) {
  OdeWorld ode;
  const dGeomID gate = makeGate(ode.space);
  const dGeomID plane = dCreatePlane(ode.space, 1.0, 0.0, 0.0, -50.0);
  Responder responder(ode.world);
  const BarrierId barrier = responder.addBarrier(gate, {.name = "gate"});
  const BarrierId side = responder.addBarrier(plane, {.name = "side"});
  const auto messageOf = [&](BarrierId which, const BarrierVelocity& velocity) -> std::string {
    try {
      responder.updateBarrier(which, velocity);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(messageOf(barrier, {.linear = {std::nan(""), 0.0, 0.0}}).find("gate"),
            std::string::npos);
  EXPECT_NE(messageOf(side, {.linear = {1.0, 0.0, 0.0}}).find("side"), std::string::npos);
  EXPECT_NE(messageOf(BarrierId{99}, {}).find("99"), std::string::npos);
  dBodyID body = dBodyCreate(ode.world);
  dGeomSetBody(gate, body);
  EXPECT_NE(messageOf(barrier, {}).find("has a body"), std::string::npos);
  dGeomSetBody(gate, nullptr);
  dBodyDestroy(body);
}

}  // namespace
}  // namespace bumper::tests
