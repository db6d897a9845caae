#pragma once

#include <algorithm>
#include <cmath>

#include "car_world.h"
#include "schemes.h"
#include "yaw_plane_car.h"

namespace bumper::benchmark {

/// What all schemes on ODE share: the car, its tyres, the loop and the clock.
class OdeScheme : public Scheme {
 public:
  explicit OdeScheme(Setting setting) : setting_(setting) {}

  RunResult run(const Run& run) final {
    const ImpactCase& impact = *run.impactCase;
    examples::YawPlaneCar car(ode_.world, ode_.space, impact.car, Eigen::Vector3d::Zero(), 0.0,
                              0.0);
    place(car, impact.start);
    car.steer(impact.steering);
    dRandSetSeed(1);
    begin(run, car);
    const VehicleParameters& body = impact.car.body;
    const double energy = yawPlaneEnergy(impact.start, body.mass, body.yawInertia);
    double most = energy;
    const double clock = cpuTime();
    const auto steps = static_cast<int>(std::lround(run.reference->duration / run.step));
    for (int k = 0; k < steps; ++k) {
      if (setting_ == Setting::tyres) car.addTyreForces();
      step(run, k);
      if (run.watchEnergy) {
        most = std::max(most, yawPlaneEnergy(motionOf(car), body.mass, body.yawInertia));
      }
    }
    RunResult result;
    result.cpuTime = cpuTime() - clock;
    result.energyGain = most / energy - 1.0;
    result.end = motionOf(car);
    finish();
    return result;
  }

 protected:
  virtual void begin(const Run& run, const examples::YawPlaneCar& car) = 0;
  virtual void step(const Run& run, int index) = 0;
  virtual void finish() {}

  [[nodiscard]] const CarWorld& ode() const { return ode_; }

 private:
  Setting setting_;
  CarWorld ode_;
};

}  // namespace bumper::benchmark
