// step() allocates nothing after warm-up.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "caught_allocations.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

// Drives cars into the L-shaped wall, along it and away, again and again, and returns how often
// memory was allocated within step() after the first rounds.
int allocationsOf(const ResponderOptions& options) {
  OdeWorld ode;
  Responder responder(ode.world, options);
  responder.addBarrier(testRail());
  constexpr int count = 4;
  std::vector<std::unique_ptr<BoxCar>> cars;
  for (int i = 0; i < count; ++i) {
    cars.push_back(std::make_unique<BoxCar>(ode.world));
    responder.addVehicle(cars.back()->body, cars.back()->parameters);
  }
  int allocations = 0;
  std::size_t events = 0;
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < count; ++i) {
      BoxCar& car = *cars[static_cast<std::size_t>(i)];
      const double yaw = 0.1 + 0.05 * i + 0.02 * round;
      car.place({30.0 + 3.0 * i, 3.0 * i - 4.0, car.parameters.massCentreHeight},
                Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix());
      car.move({25.0 * std::cos(yaw), 25.0 * std::sin(yaw), 0.0}, {0.0, 0.0, 0.2 * i});
    }
    for (int step = 0; step < 300; ++step) {
      for (const auto& car : cars) dBodyAddForce(car->body, 2000.0, 500.0, 0.0);
      caught = 0;
      guarded = true;
      events += responder.step(0.005).size();
      guarded = false;
      if (round >= 5) allocations += caught;
      dWorldQuickStep(ode.world, 0.005);
    }
  }
  EXPECT_GT(events, 40U);
  return allocations;
}

class Allocation : public testing::Test {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer has its own malloc";
#endif
  }
};

TEST_F(Allocation, IsNoticedByTheGuard) {
  caught = 0;
  guarded = true;
  const auto memory = std::make_unique<std::vector<int>>(1000);
  guarded = false;
  EXPECT_GE(caught, 2);
  EXPECT_EQ(memory->size(), 1000U);
}

TEST_F(Allocation, NoneInStepAfterWarmUp) {
  EXPECT_EQ(allocationsOf({.vehiclesCollide = false}), 0);
  EXPECT_EQ(allocationsOf({.vehiclesCollide = false, .skipping = false}), 0);
  EXPECT_EQ(allocationsOf({.vehiclesCollide = false, .delivery = Delivery::state_reset}), 0);
}

// Cars in a row that hit each other and a wall, again and again in the same way.
TEST_F(Allocation, NoneAmongVehiclesAfterWarmUp) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(straightWall({30.0, 20.0}, {30.0, -20.0}, 1.0));
  std::vector<std::unique_ptr<BoxCar>> cars;
  for (int i = 0; i < 6; ++i) {
    cars.push_back(std::make_unique<BoxCar>(ode.world));
    responder.addVehicle(cars.back()->body, cars.back()->parameters);
  }
  int allocations = 0;
  std::size_t events = 0;
  const SavedState begin = responder.save();
  for (int round = 0; round < 6; ++round) {
    for (int i = 0; i < 6; ++i) {
      BoxCar& car = *cars[static_cast<std::size_t>(i)];
      car.place({-6.0 * i, 0.2 * i, car.parameters.massCentreHeight}, Eigen::Matrix3d::Identity());
      car.move({25.0, 0.0, 0.0}, {0.0, 0.0, 0.2 * i});
    }
    responder.restore(begin);
    for (int step = 0; step < 600; ++step) {
      caught = 0;
      guarded = true;
      events += responder.step(0.005).size();
      guarded = false;
      if (round >= 2) allocations += caught;
      dWorldQuickStep(ode.world, 0.005);
    }
  }
  EXPECT_GT(events, 60U);
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace bumper::tests
