#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "schemes.h"
#include "vehicle_reference.h"

namespace bumper::benchmark {

struct VehicleRun {
  std::vector<PlanarMotion> end;
  double energyGain = 0.0;  ///< most energy at the end of a step, over that of the start, minus 1
  double cpuTime = 0.0;     ///< of the steps alone, s
};

/// What is to be run: a case for some seconds in steps of so many.
struct VehicleTask {
  const VehicleCase* vehicleCase = nullptr;
  double duration = 0.0;
  double step = 0.0;
  bool watchEnergy = true;  ///< off while time is taken
};

/// One way of simulating a case. Bumper can do all of them, the others those without walls.
struct VehicleScheme {
  const char* name;
  VehicleRun (*run)(const VehicleTask& task);
};

/// bumper, ode_quickstep and ode_worldstep (contact joints as dCollide gives them), and, if they
/// were found, bullet and box2d.
std::vector<VehicleScheme> vehicleSchemes();

/// The energy of all vehicles of a case in other motions than its own, J.
double energyOf(const VehicleCase& vehicleCase, const std::vector<PlanarMotion>& motions);

/// Runs a task by an engine's `step()`, with the `motions()` of its vehicles.
template <typename Step, typename Motions>
VehicleRun runSteps(const VehicleTask& task, const Step& step, const Motions& motions) {
  VehicleRun run;
  const double energy = energyOf(*task.vehicleCase, motions());
  double most = energy;
  const auto steps = static_cast<int>(std::lround(task.duration / task.step));
  const double clock = cpuTime();
  for (int k = 0; k < steps; ++k) {
    step();
    if (task.watchEnergy) most = std::max(most, energyOf(*task.vehicleCase, motions()));
  }
  run.cpuTime = cpuTime() - clock;
  run.energyGain = most / energy - 1.0;
  run.end = motions();
  return run;
}

}  // namespace bumper::benchmark
