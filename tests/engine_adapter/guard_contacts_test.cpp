// Contact joints with which walls take part in the world's own solve where other joints act.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <memory>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/collision_step.h"
#include "bumper/scenes/paper_scenes.h"
#include "hinge2_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

// A wall along y = 0, at right angles to the vehicle that drives at it.
Scene wall() { return straightWall({-60.0, 0.0}, {60.0, 0.0}, 1.0, 1, 1); }

/// A car that heads for the wall, turned by an angle from facing it, its front so far away.
struct Facing {
  explicit Facing(const ResponderOptions& options = {}, double distance = 0.05, double turned = 0.0,
                  const BarrierOptions& barrierOptions = {})
      : responder(ode.world, options), car(ode.world) {
    barrier = responder.addBarrier(wall(), barrierOptions);
    const Eigen::Matrix3d axes =
        Eigen::AngleAxisd(-0.5 * 3.141592653589793 + turned, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    car.place({0.0, 2.1 + distance, 0.55}, axes);
    vehicle = responder.addVehicle(car.body, car.parameters);
  }

  /// A motor that pulls it along a direction of the world, as strong as that, N.
  void addMotor(const Eigen::Vector3d& direction, double force) {
    const dJointID motor = dJointCreateLMotor(ode.world, nullptr);
    dJointAttach(motor, car.body, nullptr);
    dJointSetLMotorNumAxes(motor, 1);
    dJointSetLMotorAxis(motor, 0, 0, direction.x(), direction.y(), direction.z());
    dJointSetLMotorParam(motor, dParamVel, 10.0);
    dJointSetLMotorParam(motor, dParamFMax, force);
  }

  void run(double duration, double step = h) {
    for (double t = 0.0; t < duration; t += step) {
      for (const ImpactEvent& event : responder.step(step)) events.push_back(event.phase);
      most = std::max(most, dBodyGetNumJoints(car.body));
      dWorldStep(ode.world, step);
    }
  }
  [[nodiscard]] long count(EventPhase phase) const {
    return std::count(events.begin(), events.end(), phase);
  }
  /// How far the middle of its front is behind the wall, m.
  [[nodiscard]] double depth() const { return 2.1 - dBodyGetPosition(car.body)[1]; }

  OdeWorld ode;
  Responder responder;
  BoxCar car;
  BarrierId barrier;
  VehicleId vehicle;
  std::vector<EventPhase> events;
  int most = 0;  // joints at the car's body
};

const Eigen::Vector3d towards(0.0, -1.0, 0.0);

TEST(GuardContacts, AFreeBodyGetsNone) {
  Facing run({}, 1.0);
  run.car.move(20.0 * towards, Eigen::Vector3d::Zero());
  run.run(0.5);
  EXPECT_EQ(run.count(EventPhase::impact), 1);
  EXPECT_EQ(run.most, 0);
}

// Beside a motor that is off they change nothing: it is told, solved, and without effect.
TEST(GuardContacts, HaveNoEffectWhereNothingPushes) {
  for (const double step : {0.001, 0.005, 0.0167}) {
    for (const double turned : {0.0, 0.3, 0.7, 1.2}) {
      for (const double yawRate : {0.0, 2.0, -7.0}) {
        Facing with({}, 1.5, turned);
        Facing without({.guardContacts = false}, 1.5, turned);
        for (Facing* run : {&with, &without}) {
          run->addMotor(Eigen::Vector3d::UnitZ(), 0.0);
          run->car.move(25.0 * towards, {0.0, 0.0, yawRate});
          run->run(0.5, step);
        }
        EXPECT_GE(with.most, 2);
        EXPECT_EQ(without.most, 1);
        EXPECT_GE(with.count(EventPhase::impact), 1);
        EXPECT_EQ(with.events, without.events);
        EXPECT_EQ(with.car.velocity(), without.car.velocity()) << step << ' ' << turned;
        EXPECT_EQ(with.car.angularVelocity(), without.car.angularVelocity());
      }
    }
  }
}

TEST(GuardContacts, HoldWhatAMotorPushes) {
  for (const double step : {0.002, 0.005, 0.0167, 0.033}) {
    for (const double acceleration : {2.0, 12.0, 30.0, 200.0}) {
      Facing run;
      run.addMotor(towards, acceleration * run.car.parameters.mass);
      double deepest = -1.0;
      for (int i = 0; i < 5; ++i) {
        run.run(1.0, step);
        deepest = std::max(deepest, run.depth());
      }
      EXPECT_LE(deepest, 2e-4) << step << ' ' << acceleration;
      EXPECT_LE(run.count(EventPhase::impact), 3);
      EXPECT_EQ(run.count(EventPhase::contact_begin), 1);
      EXPECT_EQ(run.count(EventPhase::contact_end), 0);
    }
  }
}

// Why they are there.
TEST(GuardContacts, WithoutThemItSinksIn) {
  Facing run({.guardContacts = false});
  run.addMotor(towards, 30.0 * run.car.parameters.mass);
  run.run(5.0, 0.0167);
  EXPECT_GT(run.depth(), 0.01);
}

// The law's friction at grazing, 0.3 of the load, slows what is pressed against a wall.
TEST(GuardContacts, RubAsTheWallDoes) {
  for (const double force : {5e3, 2e4}) {
    Facing run({}, -2.1 + 0.9, 0.5 * 3.141592653589793);
    run.addMotor(towards, force);
    run.car.move({20.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
    run.run(0.5);
    const double before = run.car.velocity().x();
    run.run(1.0);
    const double slowed = before - run.car.velocity().x();
    EXPECT_NEAR(slowed, 0.3 * force / run.car.parameters.mass, 0.02 * slowed) << force;
    EXPECT_NEAR(run.car.angularVelocity().z(), 0.0, 1e-2);
  }
}

TEST(GuardContacts, AreGoneWithTheNextStep) {
  Facing run;
  run.addMotor(towards, 1e4);
  run.run(0.2);
  EXPECT_GT(run.most, 1);
  run.responder.step(h);
  EXPECT_GT(dBodyGetNumJoints(run.car.body), 1);
  run.car.place({0.0, 40.0, 0.55}, Eigen::Matrix3d::Identity());
  run.responder.step(h);
  EXPECT_EQ(dBodyGetNumJoints(run.car.body), 1);
}

TEST(GuardContacts, OutliveWhatTheyAreAbout) {
  // A vehicle and a barrier that are removed between step() and the world's step.
  for (const bool barrierFirst : {true, false}) {
    Facing run;
    run.addMotor(towards, 1e4);
    run.run(0.2);
    run.responder.step(h);
    if (barrierFirst) run.responder.removeBarrier(run.barrier);
    run.responder.removeVehicle(run.vehicle);
    dWorldStep(run.ode.world, h);
    run.responder.step(h);
    EXPECT_EQ(dBodyGetNumJoints(run.car.body), 1);
  }
}

TEST(GuardContacts, OutliveTheWorld) {
  // ODE says that its world held joints in a group; that is the application's to hear.
  static int messages = 0;
  dMessageFunction* const usual = dGetMessageHandler();
  dSetMessageHandler([](int, const char*, va_list) { ++messages; });
  {
    const dWorldID world = dWorldCreate();
    Responder responder(world);
    responder.addBarrier(wall());
    const dBodyID body = dBodyCreate(world);
    dMass mass;
    dMassSetBoxTotal(&mass, 1500.0, 4.2, 1.8, 0.6);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, 0.0, 1.0, 0.55);
    dJointAttach(dJointCreateBall(world, nullptr), body, nullptr);
    responder.addVehicle(body, parametersFromBodies(body, {}, 2.1, 2.1, 1.8, 0.55));
    responder.step(h);
    EXPECT_GT(dBodyGetNumJoints(body), 1);
    dWorldDestroy(world);
  }
  dSetMessageHandler(usual);
  EXPECT_GT(messages, 0);
}

// A fence that breaks lets a car through on its wheels, as it does without.
TEST(GuardContacts, NotWithWallsThatBreak) {
  ResponseSettings breaking;
  breaking.law = Law::energy;
  breaking.energyRoot = EnergyRoot::break_through;
  Facing run({}, 1.0, 0.0, {.response = breaking});
  run.addMotor(towards, 100.0);
  run.car.move(20.0 * towards, Eigen::Vector3d::Zero());
  run.run(1.0);
  EXPECT_LT(dBodyGetPosition(run.car.body)[1], -0.5);
}

TEST(GuardContacts, AlsoForAParkedCarThatSleeps) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(wall());
  BoxCar car(ode.world, ode.space);
  car.place(
      {0.0, 2.1 + 0.05, 0.55},
      Eigen::AngleAxisd(-0.5 * 3.141592653589793, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  responder.addVehicle(car.body, car.parameters);
  dBodyDisable(car.body);
  const dBodyID ram = dBodyCreate(ode.world);
  dMass mass;
  dMassSetBoxTotal(&mass, 10e3, 2.0, 4.0, 0.7);
  dBodySetMass(ram, &mass);
  const dGeomID geom = dCreateBox(ode.space, 2.0, 4.0, 0.7);
  dGeomSetBody(geom, ram);
  dBodySetPosition(ram, 0.0, 2.1 + 0.05 + 2.5 + 2.0 + 0.5, 0.55);
  dBodySetLinearVel(ram, 0.0, -15.0, 0.0);
  double deepest = -1.0;
  for (int i = 0; i < 60; ++i) {
    ode.step(0.0167, &responder, [&] { responder.step(0.0167); });
    deepest = std::max(deepest, 2.1 - dBodyGetPosition(car.body)[1]);
  }
  EXPECT_GT(deepest, -0.04);
  EXPECT_LE(deepest, 0.02);
}

// ODE wakes all that hang together in one step, also the one that touches nothing that is awake.
TEST(GuardContacts, AlsoForTheFirstOfAChainThatSleeps) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(wall());
  const Eigen::Matrix3d facing =
      Eigen::AngleAxisd(-0.5 * 3.141592653589793, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::array<BoxCar, 2> cars{BoxCar(ode.world, ode.space), BoxCar(ode.world, ode.space)};
  for (std::size_t i = 0; i < cars.size(); ++i) {
    cars[i].place({0.0, 2.1 + 0.02 + 4.599 * static_cast<double>(i), 0.55}, facing);
    responder.addVehicle(cars[i].body, cars[i].parameters);
    dBodyDisable(cars[i].body);
  }
  const dBodyID ram = dBodyCreate(ode.world);
  dMass mass;
  dMassSetBoxTotal(&mass, 20e3, 2.0, 4.0, 0.7);
  dBodySetMass(ram, &mass);
  dGeomSetBody(dCreateBox(ode.space, 2.0, 4.0, 0.7), ram);
  dBodySetPosition(ram, 0.0, 2.1 + 0.02 + 4.6 + 2.5 + 2.0 + 0.1, 0.55);
  dBodySetLinearVel(ram, 0.0, -15.0, 0.0);
  double deepest = -1.0;
  for (int i = 0; i < 60; ++i) {
    ode.step(0.0167, &responder, [&] { responder.step(0.0167); });
    deepest = std::max(deepest, 2.1 - dBodyGetPosition(cars[0].body)[1]);
  }
  EXPECT_GT(deepest, -0.01);
  EXPECT_LE(deepest, 0.05);
}

// A long force pulse lets a vehicle in, and what pushes further; without guards it drives through.
TEST(GuardContacts, HoldAlsoWhereAPulseLasts) {
  ResponseSettings slow;
  slow.contactTime = 0.05;
  Facing run({}, 0.05, 0.0, {.response = slow});
  run.addMotor(towards, 30.0 * run.car.parameters.mass);
  double deepest = -1.0;
  for (int i = 0; i < 1000; ++i) {
    run.run(0.5 * h);
    deepest = std::max(deepest, run.depth());
  }
  // It comes at √(2 · 30 · 0.05) m/s.
  EXPECT_LE(deepest, 2.0 * enteredDepth(std::sqrt(3.0), slow.contactTime));
}

// A pause, and a step too many, while they do all the work.
TEST(GuardContacts, OutliveAPauseAndAreReplacedByAStepTooMany) {
  Facing run;
  run.addMotor(towards, 30.0 * run.car.parameters.mass);
  for (int i = 0; i < 400; ++i) {
    run.responder.step(h);
    if (i % 3 == 0) run.responder.step(0.0);
    if (i % 5 == 4) {
      run.responder.step(h);
      EXPECT_EQ(run.responder.issues(run.vehicle), step_issue::repeated_step) << i;
    }
    dWorldStep(run.ode.world, h);
  }
  EXPECT_LE(run.depth(), 2e-4);
  EXPECT_NEAR(run.responder.time(), 400 * h, 1e-9);
}

// Pressed against a wall a vehicle that leans is not lifted by its guards.
TEST(GuardContacts, AreLevelWhateverTheLean) {
  Facing run;
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(-0.5 * 3.141592653589793, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
      Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  run.car.place({0.0, 2.1 * std::cos(0.2) + 0.05, 0.55}, axes);
  run.addMotor(towards, 1e4);
  run.run(0.3);
  run.responder.step(h);
  const SavedState state = run.responder.save();
  ASSERT_FALSE(state.vehicles.front().guards.empty());
  for (const GuardLoad& load : state.vehicles.front().guards) {
    EXPECT_NEAR((load.normal - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-9);
  }
}

// Both ways of delivery.
TEST(GuardContacts, WithStateResetToo) {
  Facing run({.delivery = Delivery::state_reset}, 1.0);
  run.addMotor(towards, 30.0 * run.car.parameters.mass);
  run.car.move(10.0 * towards, Eigen::Vector3d::Zero());
  run.run(5.0);
  EXPECT_LE(run.depth(), 2e-4);
  EXPECT_GE(run.depth(), -1e-3);
}

// What others have done of an impulse is not done again: a contact joint of the application's with
// the same wall, and the force pulse.
TEST(GuardContacts, AnImpactThatOthersAnswerTooIsAnsweredOnce) {
  for (int i = 0; i < 40; ++i) {
    const double distance = 1.0 + 0.0025 * i;  // another part of a step each time
    Facing run({}, distance);
    run.car.move(20.0 * towards, Eigen::Vector3d::Zero());
    double fastest = 0.0;
    for (int k = 0; k < 60; ++k) {
      dJointGroupEmpty(run.ode.joints);
      if (run.depth() >= -0.02) {
        for (const double x : {-0.9, 0.9}) {
          dContact contact{};
          contact.surface.mode = dContactApprox1;
          contact.geom.pos[0] = x;
          contact.geom.pos[2] = 0.55;
          contact.geom.normal[1] = 1.0;
          contact.geom.depth = std::max(run.depth(), 0.0);
          dJointAttach(dJointCreateContact(run.ode.world, run.ode.joints, &contact), run.car.body,
                       nullptr);
        }
      }
      run.responder.step(h);
      dWorldQuickStep(run.ode.world, h);
      fastest = std::max(fastest, run.car.velocity().y());
    }
    // By the law 1 m/s.
    EXPECT_LE(fastest, 1.2) << distance;
    EXPECT_GE(fastest, 0.5) << distance;
  }
}

}  // namespace
}  // namespace bumper::tests
