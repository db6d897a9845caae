#pragma once

#include <ode/ode.h>

#include "impact_cases.h"

namespace bumper::benchmark {

/// An ODE world without gravity, and its space.
struct CarWorld {
  CarWorld() : world(dWorldCreate()), space(dSimpleSpaceCreate(nullptr)) {}
  ~CarWorld() {
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }
  CarWorld(const CarWorld&) = delete;
  CarWorld& operator=(const CarWorld&) = delete;
  CarWorld(CarWorld&&) = delete;
  CarWorld& operator=(CarWorld&&) = delete;

  dWorldID world;
  dSpaceID space;
};

/// Puts a car into a motion in the plane.
void place(examples::YawPlaneCar& car, const PlanarMotion& motion);
PlanarMotion motionOf(const examples::YawPlaneCar& car);

/// The tyres' force on a case's car, as a field for the reference.
ForceField tyreForces(const ImpactCase& impactCase);

}  // namespace bumper::benchmark
