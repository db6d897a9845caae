// Where a vehicle is, as a recording takes it, and whether forces move it.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "hinge2_car.h"
#include "ode_world.h"
#include "vehicle_bodies.h"

namespace bumper::tests {
namespace {

TEST(VehiclePose, IsThatOfTheCommonMassCentre) {
  OdeWorld ode;
  Responder responder(ode.world);
  Hinge2Car car(ode.world, ode.space, {3.0, -2.0}, 0.5, 0.7, 0.0);
  const VehicleId vehicle =
      responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});
  EXPECT_LT((responder.position(vehicle) - car.massCentre()).norm(), 1e-12);
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  EXPECT_LT(responder.orientation(vehicle).angularDistance(expected), 1e-12);
  EXPECT_THROW((void)responder.position({.value = 1}), Error);
  EXPECT_THROW((void)responder.orientation({.value = 1}), Error);
}

TEST(VehiclePose, LeadsFromTheVehiclesAxesToTheWorlds) {
  OdeWorld ode;
  Responder responder(ode.world);
  BoxCar car(ode.world);
  const VehicleId vehicle = responder.addVehicle(car.body, car.parameters);
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.1, -0.2, 1.0).normalized()).toRotationMatrix();
  car.place({5.0, 6.0, 0.7}, axes);
  EXPECT_EQ(responder.position(vehicle), Eigen::Vector3d(5.0, 6.0, 0.7));
  EXPECT_LT((responder.orientation(vehicle) * Eigen::Vector3d::UnitX() - axes.col(0)).norm(),
            1e-12);
  EXPECT_NEAR(responder.orientation(vehicle).norm(), 1.0, 1e-12);
}

TEST(VehiclePose, OneKinematicBodyIsEnough) {
  OdeWorld ode;
  Hinge2Car car(ode.world, ode.space, {0.0, 0.0}, 0.0, 0.0, 0.0);
  const VehicleBodies bodies({car.chassis, car.wheels[0], car.wheels[3]});
  EXPECT_FALSE(bodies.anyKinematic());
  dBodySetKinematic(car.wheels[3]);
  EXPECT_TRUE(bodies.anyKinematic());
  dBodySetDynamic(car.wheels[3]);
  EXPECT_FALSE(bodies.anyKinematic());
}

}  // namespace
}  // namespace bumper::tests
