#include "test_rail_run.h"

#include <ode/ode.h>

#include "bumper/engine_adapter/responder.h"
#include "results.h"
#include "yaw_plane_car.h"

namespace bumper::examples {

namespace {

constexpr double sixtyMph = 26.8224;  // m/s
constexpr double step = 0.005;        // s
constexpr int steps = 800;

void drive(dWorldID world, const Scene& scene, const ResponseSettings& settings,
           Recording& recording) {
  YawPlaneCar car(world, nullptr, {}, {0.0, 0.0, 0.55}, 0.0, sixtyMph);
  Responder responder(world, {.response = settings});
  responder.addBarrier(scene);
  const VehicleId vehicle = responder.addVehicle(car.body(), car.design().body, {.name = "car"});
  const std::size_t recorded = recording.addVehicle("car", car.design().body);

  recording.addPose(recorded, poseOf(responder, vehicle));
  for (int i = 0; i < steps; ++i) {
    car.addTyreForces();
    record(responder.step(step), recording);
    dWorldQuickStep(world, step);
    recording.addPose(recorded, poseOf(responder, vehicle));
  }
}

}  // namespace

Recording runTestRail(const Scene& scene, const ResponseSettings& settings) {
  Recording recording;
  const dWorldID world = dWorldCreate();  // without gravity: the car stays in its yaw plane
  drive(world, scene, settings, recording);
  dWorldDestroy(world);
  return recording;
}

}  // namespace bumper::examples
