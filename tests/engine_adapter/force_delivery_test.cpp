// What arrives at ODE's bodies after one world step.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/contact_solve.h"
#include "bumper/response/restitution_law.h"
#include "bumper/scenes/paper_scenes.h"
#include "hinge2_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double h = 0.005;

// The impulse that the restitution law gives for what the event says of the situation.
ContactImpulse lawOf(const ImpactEvent& event, const VehicleParameters& car,
                     const Vector2& normalInVehicle, const Vector2& velocityBefore) {
  const ContactBody body{.inverseMass = 1.0 / car.mass,
                         .inverseYawInertia = 1.0 / car.yawInertia,
                         .arm = event.arm,
                         .velocity = velocityBefore,
                         .yawRate = event.yawRateBefore};
  return solveRestitution(contactMobility(body, {}, normalInVehicle),
                          contactVelocity(body, {}, normalInVehicle), event.restitution,
                          {.value = event.friction})
      .impulse;
}

class ForceDelivery : public ::testing::TestWithParam<Stepper> {
 protected:
  static void stepWorld(dWorldID world) {
    if (GetParam() == Stepper::quick) {
      dWorldQuickStep(world, h);
    } else {
      dWorldStep(world, h);
    }
  }
};

TEST_P(ForceDelivery, OneBodyGetsTheImpulse) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    OdeWorld ode;
    Responder responder(ode.world);
    responder.addBarrier(straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0, 7, 2));
    BoxCar car(ode.world);
    const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
    const double heading = -(5.0 + 80.0 * uniform(random)) * degree;
    const double speed = 3.0 + 30.0 * uniform(random);
    const Eigen::Matrix3d axes =
        Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    // The front right corner touches somewhere in the coming step.
    const Eigen::Vector3d corner = axes * Eigen::Vector3d(2.1, -0.9, 0.0);
    const double yawRateBefore = 0.2 * (uniform(random) - 0.5);
    const double approach = speed * std::sin(-heading) - yawRateBefore * corner.x();
    car.place({0.0, -corner.y() + 0.9 * approach * h * uniform(random), 0.55}, axes);
    car.move(speed * axes.col(0), {0.0, 0.0, yawRateBefore});

    const Eigen::Vector3d before = car.velocity();
    const auto events = responder.step(h);
    ASSERT_GE(events.size(), 1U);
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
    double moment = 0.0;
    for (const ImpactEvent& event : events) {
      const Eigen::Vector3d tangent = Eigen::Vector3d::UnitZ().cross(event.normal);
      const Eigen::Vector3d each =
          event.impulseNormal * event.normal + event.impulseTangent * tangent;
      impulse += each;
      moment += event.yawRateAfter - event.yawRateBefore;
    }
    moment *= car.parameters.yawInertia;
    const Eigen::Vector3d promised = events.back().velocityAfter;
    const double promisedYawRate = events.back().yawRateAfter;
    const Eigen::Matrix3d axesThen =
        Eigen::AngleAxisd(heading + yawRateBefore * events[0].time, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    const ContactImpulse law =
        lawOf(events[0], car.parameters, (axesThen.transpose() * events[0].normal).head<2>(),
              (axesThen.transpose() * before).head<2>());
    EXPECT_NEAR(events[0].impulseNormal, law.normal, 1e-9 * law.normal);
    EXPECT_NEAR(events[0].impulseTangent, law.tangent, 1e-9 * law.normal);
    stepWorld(ode.world);
    // A part is still to be delivered, and the responder knows it.
    EXPECT_LE((responder.velocity(vehicle) - promised).norm(), 1e-9 * promised.norm());
    EXPECT_NEAR(responder.yawRate(vehicle), promisedYawRate, 1e-9);
    EXPECT_EQ(responder.step(h).size(), 0U);
    stepWorld(ode.world);
    const Eigen::Vector3d gained = car.parameters.mass * (car.velocity() - before);
    EXPECT_LE((gained - impulse).norm(), 1e-9 * impulse.norm());
    EXPECT_LE((car.velocity() - promised).norm(), 1e-9 * promised.norm());
    EXPECT_NEAR(car.parameters.yawInertia * (car.angularVelocity().z() - yawRateBefore), moment,
                1e-9 * impulse.norm());
    EXPECT_NEAR(car.angularVelocity().z(), promisedYawRate, 1e-9);
    EXPECT_LE(car.angularVelocity().head<2>().norm(), 1e-9);
  }
}

TEST_P(ForceDelivery, Hinge2CarMovesAsOne) {
  for (const double headingDegrees : {-8.0, -20.0, -45.0, -70.0, -88.0}) {
    OdeWorld ode;  // no gravity: what moves the car comes from the wall
    Responder responder(ode.world);
    responder.addBarrier(straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0, 3, 1));
    const double heading = headingDegrees * degree;
    const Eigen::Rotation2Dd rotation(heading);
    const Eigen::Vector2d corner = rotation * Eigen::Vector2d(Hinge2Car::front, -0.9);
    Hinge2Car car(ode.world, nullptr, {0.0, -corner.y() + 0.001}, 0.0, heading, 20.0);
    responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});

    const Eigen::Vector3d before = car.velocity();
    const auto events = responder.step(h);
    ASSERT_GE(events.size(), 1U);
    const Eigen::Vector3d promised = events.back().velocityAfter;
    const double promisedYawRate = events.back().yawRateAfter;
    stepWorld(ode.world);
    // Later the spinning wheels tilt a car that yaws, as they should.
    const dReal* angular = dBodyGetAngularVel(car.chassis);
    EXPECT_LE(std::hypot(angular[0], angular[1]), 2e-4 * std::abs(promisedYawRate) + 1e-4)
        << headingDegrees << "°";
    responder.step(h);
    stepWorld(ode.world);
    const double deltaV = (promised - before).norm();
    EXPECT_LE((car.velocity() - promised).norm(), 2e-4 * deltaV) << headingDegrees << "°";
    EXPECT_NEAR(dBodyGetAngularVel(car.chassis)[2], promisedYawRate,
                2e-4 * std::abs(promisedYawRate) + 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Steppers, ForceDelivery, ::testing::Values(Stepper::quick, Stepper::exact),
                         [](const auto& each) {
                           return each.param == Stepper::quick ? "QuickStep" : "WorldStep";
                         });

TEST(ForceDelivery, ATiltedChassisGetsNoRollAndNoPitch) {
  for (const double tilt : {5.0, 12.0, 25.0}) {
    for (const double direction : {0.0, 40.0, 90.0, 160.0, 250.0, 330.0}) {
      OdeWorld ode;
      Responder responder(ode.world);
      responder.addBarrier(straightWall({-30.0, 0.0}, {30.0, 0.0}, 3.0, 3, 1));
      BoxCar car(ode.world);
      responder.addVehicle(car.body, car.parameters);
      const Eigen::Vector3d hinge(std::cos(direction * degree), std::sin(direction * degree), 0.0);
      const Eigen::Matrix3d axes =
          Eigen::AngleAxisd(tilt * degree, hinge).toRotationMatrix() *
          Eigen::AngleAxisd(-0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      const Eigen::Vector3d corner = axes * Eigen::Vector3d(2.1, -0.9, 0.0);
      car.place({0.0, -corner.y() + 0.001, 1.2}, axes);
      car.move(20.0 * axes.col(0), Eigen::Vector3d::Zero());
      ASSERT_GE(responder.step(h).size(), 1U);
      dWorldQuickStep(ode.world, h);
      // What this step's force has done; the rest comes with the next, in the axes that it finds.
      const Eigen::Vector3d rates = axes.transpose() * car.angularVelocity();
      EXPECT_GT(std::abs(rates.z()), 0.1);
      EXPECT_LE(rates.head<2>().norm(), 1e-9 * std::abs(rates.z()));
    }
  }
}

// Why the torque acts about the body's own axis: about the world's, the same moment rolls the car.
TEST(ForceDelivery, ATorqueAboutTheWorldsAxisWouldRollIt) {
  OdeWorld ode;
  BoxCar car(ode.world);
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(5.0 * degree, Eigen::Vector3d::UnitY()).toRotationMatrix();
  car.place({0.0, 0.0, 0.0}, axes);
  dBodyAddTorque(car.body, 0.0, 0.0, 4.0 * car.parameters.yawInertia / h);
  dWorldQuickStep(ode.world, h);
  const Eigen::Vector3d rates = axes.transpose() * car.angularVelocity();
  EXPECT_GT(std::abs(rates.x()), 0.1);
}

TEST(ForceDelivery, ASleepingPartIsWokenAndASleepingCarIsNot) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(straightWall({-30.0, 0.0}, {30.0, 0.0}, 1.0));
  Hinge2Car car(ode.world, nullptr, {0.0, 0.901}, 0.0, 0.0, 0.0);
  responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});
  dBodySetLinearVel(car.chassis, 0.0, -3.0, 0.0);
  for (const dBodyID wheel : car.wheels) dBodySetLinearVel(wheel, 0.0, -3.0, 0.0);

  dBodyDisable(car.chassis);
  for (const dBodyID wheel : car.wheels) dBodyDisable(wheel);
  EXPECT_TRUE(responder.step(h).empty());
  EXPECT_EQ(dBodyIsEnabled(car.chassis), 0);

  dBodyEnable(car.wheels[0]);
  ASSERT_FALSE(responder.step(h).empty());
  EXPECT_NE(dBodyIsEnabled(car.chassis), 0);
  dWorldQuickStep(ode.world, h);
  responder.step(h);
  dWorldQuickStep(ode.world, h);
  EXPECT_GT(car.velocity().y(), 0.0);
}

}  // namespace
}  // namespace bumper::tests
