#pragma once

#include <string>
#include <vector>

#include "query_rows.h"

namespace bumper::benchmark {

/// A whole step of one vehicle, as an application has it: collide, respond, step the world.
struct StepRow {
  std::string scene;
  std::string scheme;  ///< "world" (nothing collides), "bumper", "ode_contacts" (contact joints)
  std::size_t vehicles = 1;
  int bodies = 1;                ///< of each vehicle
  double freeTime = unknown;     ///< ns, in the middle of the road
  double contactTime = unknown;  ///< ns, leaning on a wall with 3 kN and sliding along it
};

/// A step of many five-body cars in the middle of the road.
struct FleetRow {
  std::string scene;
  std::size_t vehicles = 1;
  double worldStep = unknown;  ///< ns, all of them
  /// Responder::step(), ns for each car: nothing but the cars' motion in between; after a world
  /// step; after all caches were filled with other data.
  double warm = unknown;
  double afterWorldStep = unknown;
  double cold = unknown;
  double inContact = unknown;  ///< after a world step, all leaning on walls
};

struct StepMeasurement {
  std::vector<StepRow> steps;
  std::vector<FleetRow> fleets;
  double responseEnergy = unknown;       ///< ns of respond() by the energy law
  double responseRestitution = unknown;  ///< … and by the restitution law
};

struct StepOptions {
  int repetitions = 5;
  std::vector<std::size_t> fleets = {1, 10, 100, 1000};
};

/// On the course with its ground, S2g.
StepMeasurement measureSteps(const StepOptions& options);

}  // namespace bumper::benchmark
