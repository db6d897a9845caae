#pragma once

#include <span>
#include <utility>

#include "bumper/response/collision_step.h"
#include "bumper/response/force_pulse.h"
#include "bumper/response/vehicle_parameters.h"

namespace bumper::examples {

/// A car of an engine of one's own, here a few lines: a mass and a yaw inertia that move by
/// v ← v + h F/m, x ← x + h v, in steps of any size. The response is asked in each of them, by
/// either of the paper's two ways, and nothing else is needed.
class OwnCar {
 public:
  OwnCar(const VehicleParameters& parameters, PlanarMotion start)
      : parameters_(parameters), motion_(std::move(start)) {}

  /// Tyres, motor, wind: acts in the next step. N, N m, in the world.
  void push(const PlanarForce& force) { own_ = force; }

  /// The first way: a constant force over the time of one step from the impact on, in the part of
  /// it that lies in this step.
  void stepByForce(std::span<const WallSegment> walls, double h);

  /// The second way: the state at the step's end, with the velocity after the impact.
  void stepByReset(std::span<const WallSegment> walls, double h);

  /// Where it is, and how it moves after the last impact: with what of the force is still to come.
  [[nodiscard]] PlanarMotion motion() const;

 private:
  /// As it would move in this step if there were no walls.
  [[nodiscard]] PlanarMotion unhindered(const PlanarImpulse& due, double h) const;

  VehicleParameters parameters_;
  PlanarMotion motion_;
  PlanarForce own_;
  CollisionStep collision_;
  ForcePulse pulse_;  // what impacts have still to deliver, of the first way
};

}  // namespace bumper::examples
