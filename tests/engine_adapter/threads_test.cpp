// Several worlds on several threads: each as if it were alone, and far steps wait for nobody.

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <future>
#include <mutex>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/engine_adapter/trimesh_lock.h"
#include "bumper/scenes/paper_scenes.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

// Worlds share ODE's default job queue, which is not thread safe: on several threads each needs one
// of its own.
class OwnJobs {
 public:
  explicit OwnJobs(dWorldID world)
      : world_(world), jobs_(dThreadingAllocateSelfThreadedImplementation()) {
    dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(jobs_),
                                         jobs_);
  }
  ~OwnJobs() {
    dWorldSetStepThreadingImplementation(world_, nullptr, nullptr);
    dThreadingFreeImplementation(jobs_);
  }
  OwnJobs(const OwnJobs&) = delete;
  OwnJobs& operator=(const OwnJobs&) = delete;
  OwnJobs(OwnJobs&&) = delete;
  OwnJobs& operator=(OwnJobs&&) = delete;

 private:
  dWorldID world_;
  dThreadingImplementationID jobs_;
};

// A car that drives into the L-shaped wall at an angle; where it is in each step.
std::vector<std::array<double, 3>> drive(double yaw) {
  OdeWorld ode;
  const OwnJobs jobs(ode.world);
  Responder responder(ode.world);
  responder.addBarrier(testRail());
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  car.place({30.0, 0.0, car.parameters.massCentreHeight},
            Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  car.move({25.0 * std::cos(yaw), 25.0 * std::sin(yaw), 0.0}, {0.0, 0.0, 0.0});
  std::vector<std::array<double, 3>> path;
  for (int i = 0; i < 2000; ++i) {
    dBodyAddForce(car.body, 500.0 * std::sin(0.01 * i), 800.0, 0.0);
    responder.step(h);
    dWorldQuickStep(ode.world, h);
    const dReal* position = dBodyGetPosition(car.body);
    path.push_back({position[0], position[1], position[2]});
  }
  return path;
}

TEST(Threads, EachWorldRunsAsIfAlone) {
  const std::vector<std::array<double, 3>> alone[] = {drive(0.1), drive(0.2)};
  const auto onThread = [](double yaw) {
    return std::async(std::launch::async, [yaw] {
      dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
      auto path = drive(yaw);
      dCleanupODEAllDataForThread();
      return path;
    });
  };
  auto first = onThread(0.1);
  auto second = onThread(0.2);
  EXPECT_EQ(first.get(), alone[0]);
  EXPECT_EQ(second.get(), alone[1]);
}

TEST(Threads, AFarStepDoesNotWaitForTheTrimeshLock) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(testRail());
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  car.place({0.0, -60.0, car.parameters.massCentreHeight}, Eigen::Matrix3d::Identity());
  car.move({20.0, 0.0, 0.0}, {0.0, 0.0, 0.1});
  std::unique_lock guard(trimeshLock());
  auto far = std::async(std::launch::async, [&] {
    for (int i = 0; i < 500; ++i) {
      responder.step(h);
      dWorldQuickStep(ode.world, h);
    }
  });
  const auto outcome = far.wait_for(std::chrono::seconds(60));
  guard.unlock();
  far.wait();
  EXPECT_EQ(outcome, std::future_status::ready);
}

}  // namespace
}  // namespace bumper::tests
