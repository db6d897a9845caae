#pragma once

#include <functional>
#include <span>

#include "ode_car.h"
#include "plan.h"

namespace bumper::tests {

/// What plain ODE makes of a car and walls: contact joints of dCollide's contacts with a trimesh,
/// QuickStep.
struct JointSetting {
  double step = 0.005;    ///< s
  double duration = 1.0;  ///< s
  double friction = 0.3;  ///< ODE's coefficient
  double bounce = 0.05;   ///< ODE's restitution
  double wallHeight = 1.0;
  std::size_t panels = 1;  ///< each wall's quads along it
  std::size_t rows = 1;    ///< … and upwards
};

struct JointRun {
  PlanarMotion end;
  double mostEnergy = 0.0;   ///< largest kinetic energy, as a ratio to that at the start
  double topSpeed = 0.0;     ///< m/s
  double topRise = 0.0;      ///< largest speed upwards or downwards, m/s
  double largestLoss = 0.0;  ///< of speed in one step, m/s
  double deepest = 0.0;      ///< largest intrusion of a wall into the outline, m
  bool ledThrough = false;   ///< the mass centre went through a wall
};

/// `forces` acts on the car before each step.
JointRun runWithJoints(std::span<const Line> plan, const PlanarMotion& start,
                       const JointSetting& setting,
                       const std::function<void(BoxCar&)>& forces = {});

}  // namespace bumper::tests
