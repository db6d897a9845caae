// Collide, own forces, step(h), world step of the same h: what happens if an application does it
// otherwise, and that all ways of doing it right lead to the same motion.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "hinge2_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

/// A car that is about to hit a wall along y = 0 with its front right corner.
struct Approach {
  explicit Approach(const ResponderOptions& options = {}, double distance = 0.3)
      : responder(ode.world, options), car(ode.world) {
    responder.addBarrier(straightWall({-60.0, 0.0}, {60.0, 0.0}, 1.0, 20, 1));
    const Eigen::Matrix3d axes =
        Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Vector3d corner = axes * Eigen::Vector3d(2.1, -0.9, 0.0);
    car.place({0.0, distance - corner.y(), 0.55}, axes);
    car.move(20.0 * axes.col(0), Eigen::Vector3d::Zero());
    vehicle = responder.addVehicle(car.body, car.parameters);
  }

  [[nodiscard]] Eigen::Vector3d position() const {
    return Eigen::Map<const Eigen::Vector3d>(dBodyGetPosition(car.body));
  }

  OdeWorld ode;
  Responder responder;
  BoxCar car;
  VehicleId vehicle;
};

struct Motion {
  Eigen::Vector3d position;
  Eigen::Vector3d velocity;
  double yawRate = 0.0;
};

Motion motionOf(const Approach& run) {
  return {run.position(), run.responder.velocity(run.vehicle), run.responder.yawRate(run.vehicle)};
}

void expectSame(const Motion& a, const Motion& b, double tolerance) {
  EXPECT_LE((a.position - b.position).norm(), tolerance);
  EXPECT_LE((a.velocity - b.velocity).norm(), tolerance);
  EXPECT_NEAR(a.yawRate, b.yawRate, tolerance);
}

constexpr int steps = 80;

/// The motion after 0.4 s in steps of h; the car has hit the wall twice by then.
Motion reference() {
  Approach run;
  std::size_t impacts = 0;
  for (int i = 0; i < steps; ++i) {
    impacts += run.responder.step(h).size();
    EXPECT_EQ(run.responder.issues(), step_issue::none);
    dWorldQuickStep(run.ode.world, h);
  }
  EXPECT_GE(impacts, 2U);
  return motionOf(run);
}

TEST(StepContract, AnyStepSizesLeadToTheSameMotion) {
  const Motion expected = reference();
  for (const std::vector<double>& sizes : std::vector<std::vector<double>>{
           {0.0005}, {0.02}, {0.001, 0.007, 0.002}, {0.009, 0.0, 0.001}, {0.05}}) {
    Approach run;
    double time = 0.0;
    for (std::size_t i = 0; time < steps * h - 1e-9; ++i) {
      const double step = std::min(sizes[i % sizes.size()], steps * h - time);
      run.responder.step(step);
      EXPECT_EQ(run.responder.issues(), step_issue::none);
      if (step > 0.0) dWorldQuickStep(run.ode.world, step);
      time += step;
    }
    expectSame(motionOf(run), expected, 1e-9);
  }
}

TEST(StepContract, AStateResetLeadsToTheSameMotion) {
  Approach run({.delivery = Delivery::state_reset});
  for (int i = 0; i < steps; ++i) {
    run.responder.step(h);
    EXPECT_EQ(run.responder.issues(), step_issue::none);
    EXPECT_EQ(dBodyGetForce(run.car.body)[0], 0.0);
    dWorldQuickStep(run.ode.world, h);
  }
  expectSame(motionOf(run), reference(), 1e-9);
}

TEST(StepContract, AStepTooManyIsTakenBack) {
  for (const Delivery delivery : {Delivery::force_pulse, Delivery::state_reset}) {
    Approach run({.delivery = delivery});
    unsigned noticed = 0;
    for (int i = 0; i < steps; ++i) {
      run.responder.step(h);
      for (int again = 0; again < i % 3; ++again) {
        run.responder.step(h);
        noticed |= run.responder.issues(run.vehicle);
      }
      dWorldQuickStep(run.ode.world, h);
    }
    EXPECT_EQ(noticed, step_issue::repeated_step);
    expectSame(motionOf(run), reference(), 1e-9);
  }
}

// The wrong step moves the car otherwise; but no part of an impulse is lost or doubled.
TEST(StepContract, AWorldStepOfAnotherSizeLosesNothing) {
  for (const double size : {0.5, 1.5, 2.0}) {
    Approach run;
    Eigen::Vector3d promised = Eigen::Vector3d::Zero();
    while (promised.isZero()) {
      for (const ImpactEvent& event : run.responder.step(h)) promised = event.velocityAfter;
      EXPECT_EQ(run.responder.issues(), step_issue::none);
      dWorldQuickStep(run.ode.world, promised.isZero() ? h : size * h);
    }
    EXPECT_TRUE(run.responder.step(h).empty()) << size;
    EXPECT_EQ(run.responder.issues(), step_issue::other_step_size) << size;
    dWorldQuickStep(run.ode.world, h);
    run.responder.step(h);
    EXPECT_LE((run.responder.velocity(run.vehicle) - promised).norm(), 1e-9) << size;
    dWorldQuickStep(run.ode.world, h);
    EXPECT_LE((run.car.velocity() - promised).norm(), 1e-9) << size;
  }
}

TEST(StepContract, ATeleportDropsWhatIsPending) {
  Approach run;
  while (run.responder.step(h).empty()) dWorldQuickStep(run.ode.world, h);
  dWorldQuickStep(run.ode.world, h);
  run.car.place({0.0, 30.0, 0.55}, Eigen::Matrix3d::Identity());
  run.car.move({5.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
  run.responder.step(h);
  EXPECT_EQ(run.responder.issues(run.vehicle), step_issue::moved);
  dWorldQuickStep(run.ode.world, h);
  EXPECT_EQ(run.car.velocity(), Eigen::Vector3d(5.0, 0.0, 0.0));
}

// Faster or slower along the same way it is no world step of another size.
TEST(StepContract, AVelocityThatIsScaledDropsWhatIsPending) {
  for (const double factor : {0.5, 0.9, 0.999, 1.001, 1.5, 4.0}) {
    Approach run;
    while (run.responder.step(h).empty()) dWorldQuickStep(run.ode.world, h);
    dWorldQuickStep(run.ode.world, h);
    const Eigen::Vector3d scaled = factor * run.car.velocity();
    run.car.move(scaled, run.car.angularVelocity());
    run.responder.step(h);
    EXPECT_EQ(run.responder.issues(run.vehicle), step_issue::moved) << factor;
  }
}

// A shortcut of games: one step() for several steps of the world. The force acts in the first of
// them; the rest of the impulse follows.
TEST(StepContract, SeveralWorldStepsForOneLoseNothing) {
  for (const int parts : {2, 3, 10}) {
    Approach run;
    Eigen::Vector3d promised = Eigen::Vector3d::Zero();
    const auto stepWorld = [&] {
      for (int k = 0; k < parts; ++k) dWorldQuickStep(run.ode.world, h / parts);
    };
    while (promised.isZero()) {
      for (const ImpactEvent& event : run.responder.step(h)) promised = event.velocityAfter;
      stepWorld();
    }
    run.responder.step(h);
    EXPECT_EQ(run.responder.issues(run.vehicle), step_issue::other_step_size) << parts;
    dWorldQuickStep(run.ode.world, h);
    EXPECT_LE((run.responder.velocity(run.vehicle) - promised).norm(), 1e-9) << parts;
  }
}

TEST(StepContract, TimeGoesOnForAVehicleAtRest) {
  for (const double depth : {-0.002, 0.0, 5e-5, 0.02}) {
    Approach run;
    run.car.place({0.0, 0.9 - depth, 0.55}, Eigen::Matrix3d::Identity());
    run.car.move(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    for (int i = 0; i < 200; ++i) {
      run.responder.step(h);
      EXPECT_EQ(run.responder.issues(), step_issue::none) << depth << ' ' << i;
      dWorldQuickStep(run.ode.world, h);
    }
    EXPECT_NEAR(run.responder.time(), 200 * h, 1e-12) << depth;
  }
}

// Pushed, held, and let go: at rest exactly, then.
TEST(StepContract, TimeGoesOnAfterAPushEnds) {
  Approach run;
  run.car.place({0.0, 0.9 + 0.01, 0.55}, Eigen::Matrix3d::Identity());
  run.car.move({0.0, -1.0, 0.0}, Eigen::Vector3d::Zero());
  for (int i = 0; i < 600; ++i) {
    if (i < 200) dBodyAddForce(run.car.body, 0.0, -6000.0, 0.0);
    run.responder.step(h);
    EXPECT_EQ(run.responder.issues(), step_issue::none) << i;
    dWorldQuickStep(run.ode.world, h);
  }
  EXPECT_NEAR(run.responder.time(), 600 * h, 1e-12);
}

// Moved by the application from now on: no force can.
TEST(StepContract, AVehicleMadeKinematicIsNoticed) {
  Approach run;
  while (run.responder.step(h).empty()) dWorldQuickStep(run.ode.world, h);
  dWorldQuickStep(run.ode.world, h);
  dBodySetKinematic(run.car.body);
  run.responder.step(h);
  EXPECT_EQ(run.responder.issues(run.vehicle), step_issue::kinematic);
  EXPECT_EQ(dBodyGetForce(run.car.body)[0], 0.0);
  dBodySetDynamic(run.car.body);
  run.responder.step(h);
  EXPECT_EQ(run.responder.issues(run.vehicle), step_issue::none);
}

// Put 30 m on in the direction in which it goes it looks as after a world step of two seconds.
TEST(StepContract, ATeleportAlongTheWayIsNoLongStep) {
  Approach run;
  while (run.responder.step(h).empty()) dWorldQuickStep(run.ode.world, h);
  const dReal* from = dBodyGetPosition(run.car.body);
  run.car.place({from[0] - 30.0, from[1], from[2]}, Eigen::Matrix3d::Identity());
  run.car.move({-15.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
  dBodySetForce(run.car.body, 0.0, 0.0, 0.0);
  run.responder.step(h);
  EXPECT_EQ(run.responder.issues(run.vehicle), step_issue::moved);
  dWorldQuickStep(run.ode.world, h);
  EXPECT_EQ(run.car.velocity(), Eigen::Vector3d(-15.0, 0.0, 0.0));
}

TEST(StepContract, APauseChangesNothing) {
  Approach run;
  for (int i = 0; i < steps; ++i) {
    run.responder.step(h);
    dWorldQuickStep(run.ode.world, h);
    for (int pause = 0; pause < 3; ++pause) EXPECT_TRUE(run.responder.step(0.0).empty());
  }
  expectSame(motionOf(run), reference(), 0.0);
}

TEST(StepContract, ASavedStateContinuesBitForBit) {
  Approach run;
  // Between the two halves of a pulse.
  while (run.responder.step(h).empty()) dWorldQuickStep(run.ode.world, h);
  dWorldQuickStep(run.ode.world, h);
  const SavedState saved = run.responder.save();
  const Eigen::Vector3d position = run.position();
  const Eigen::Vector3d velocity = run.car.velocity();
  const Eigen::Vector3d turning = run.car.angularVelocity();
  const Eigen::Vector4d turn = Eigen::Map<const Eigen::Vector4d>(dBodyGetQuaternion(run.car.body));
  const auto goOn = [&] {
    for (int i = 0; i < 20; ++i) {
      run.responder.step(h);
      dWorldQuickStep(run.ode.world, h);
    }
    return motionOf(run);
  };
  const Motion first = goOn();
  dBodySetPosition(run.car.body, position.x(), position.y(), position.z());
  dBodySetQuaternion(run.car.body, turn.data());
  run.car.move(velocity, turning);
  run.responder.restore(saved);
  EXPECT_EQ(run.responder.time(), saved.time);
  expectSame(goOn(), first, 0.0);
}

TEST(StepContract, ASavedStateOfOthersIsRefused) {
  Approach run;
  SavedState saved = run.responder.save();
  saved.vehicles.clear();
  EXPECT_THROW(run.responder.restore(saved), Error);
  saved = run.responder.save();
  saved.vehicles[0].passable.push_back({.barrier = {.value = 7}});
  EXPECT_THROW(run.responder.restore(saved), Error);
  saved = run.responder.save();
  saved.vehicles[0].contacts.push_back({.with = {.barrier = {.value = 0}}, .wall = 40});
  EXPECT_THROW(run.responder.restore(saved), Error);
}

// A force over a contact time of several steps delivers the same impulse, later.
TEST(StepContract, ALongContactTimeDeliversTheImpulse) {
  ResponderOptions options;
  options.response.contactTime = 0.04;
  Approach run(options);
  Eigen::Vector3d promised = Eigen::Vector3d::Zero();
  int running = 0;
  for (int i = 0; i < 30 && running < 9; ++i) {
    for (const ImpactEvent& event : run.responder.step(h)) {
      if (promised.isZero()) promised = event.velocityAfter;
    }
    if (!promised.isZero()) ++running;
    if (running == 4) {
      EXPECT_GT((run.car.velocity() - promised).norm(), 0.5);
    }
    dWorldQuickStep(run.ode.world, h);
  }
  EXPECT_LE((run.responder.velocity(run.vehicle) - promised).norm(), 1e-9);
  EXPECT_LE((run.car.velocity() - promised).norm(), 1e-9);
}

// Why a second call must be noticed: the same force twice sends the car back as fast as it came.
TEST(StepContract, WithoutNoticeTheImpulseWouldDouble) {
  OdeWorld ode;
  const BoxCar car(ode.world);
  dBodySetLinearVel(car.body, 20.0, 0.0, 0.0);
  for (int call = 0; call < 2; ++call) {
    dBodyAddForce(car.body, -20.0 * car.parameters.mass / h, 0.0, 0.0);
  }
  dWorldQuickStep(ode.world, h);
  EXPECT_NEAR(car.velocity().x(), -20.0, 1e-9);
}

// Far from all walls a step is a comparison; a roll-over is told all the same.
TEST(StepContract, RollingOverFarFromWallsIsTold) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(straightWall({100.0, -50.0}, {100.0, 50.0}, 1.0));
  BoxCar car(ode.world);
  const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
  const auto lean = [&](double angle) {
    car.place({0.0, 0.0, 0.55}, Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).matrix());
    responder.step(0.005);
    return responder.issues(vehicle);
  };
  EXPECT_EQ(lean(0.0), step_issue::none);
  EXPECT_EQ(lean(0.0), step_issue::none);
  EXPECT_EQ(lean(1.5), step_issue::tilted);
  EXPECT_EQ(lean(0.0), step_issue::none);
}

}  // namespace
}  // namespace bumper::tests
