#pragma once

#include <ode/ode.h>

namespace bumper {

/// How long a world has stepped since it was last looked at.
struct WorldSteps {
  double total = 0.0;  ///< s, of all steps; 0: none was taken
  double first = 0.0;  ///< s, of the first: the forces added before act in that one only
};

/// Measures the world's steps, which ODE does not record, by a body of its own without contacts,
/// gravity and damping. It moves at 1 m/s, so its distance is the time; and a force of 1 N on its 1
/// kg, which ODE clears after one step, makes its lateral speed that step's size.
class WorldClock {
 public:
  explicit WorldClock(dWorldID world);
  /// The world may have been destroyed before.
  ~WorldClock();
  WorldClock(const WorldClock&) = delete;
  WorldClock& operator=(const WorldClock&) = delete;
  WorldClock(WorldClock&&) = delete;
  WorldClock& operator=(WorldClock&&) = delete;

  /// From now on.
  void start();
  /// Costs the world's steps nothing until the next start().
  void stop();
  [[nodiscard]] bool isRunning() const { return running_; }
  /// Since start(), while it is running.
  [[nodiscard]] WorldSteps read() const;

 private:
  dBodyID body_;
  // ODE detaches it from the body when that is destroyed with its world.
  dGeomID marker_;
  bool running_ = false;
};

}  // namespace bumper
