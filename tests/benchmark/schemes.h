#pragma once

#include <memory>
#include <string>
#include <vector>

#include "car_world.h"
#include "case_reference.h"

namespace bumper::benchmark {

/// How a run ended.
struct RunResult {
  PlanarMotion end;
  double energyGain = 0.0;  ///< most energy at the end of a step, over that of the start, minus 1
  double cpuTime = 0.0;     ///< of the steps alone, s
};

/// What is to be run.
struct Run {
  const ImpactCase* impactCase = nullptr;
  const CaseReference* reference = nullptr;  ///< of that case
  double step = 0.0;                         ///< s
  bool watchEnergy = true;                   ///< off while time is taken
};

/// One way of simulating a case, with its world and wall ready.
class Scheme {
 public:
  Scheme() = default;
  virtual ~Scheme() = default;
  Scheme(const Scheme&) = delete;
  Scheme& operator=(const Scheme&) = delete;
  Scheme(Scheme&&) = delete;
  Scheme& operator=(Scheme&&) = delete;

  virtual RunResult run(const Run& run) = 0;
};

/// The schemes by the names of accuracy.json:
///   bumper, paper                    the library; Method::paper
///   ode_contacts                     the library's law at the mean of dCollide's contacts
///   ode_quickstep, ode_worldstep     ODE's contact joints as dCollide gives them
///   ode_quickstep_true_normal        with every contact's normal replaced by the wall's
///   reference_impulses               ODE given the reference's impulses and times: tyres only
///   bullet                           if it was found
/// Throws Error for another name.
std::unique_ptr<Scheme> makeScheme(const std::string& name, Setting setting, int triangles);

/// All of them that this program has, in that order.
std::vector<std::string> schemeNames(Setting setting);

/// CPU time of this thread, s.
double cpuTime();

}  // namespace bumper::benchmark
