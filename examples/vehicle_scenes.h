#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bumper/render/recording.h"
#include "bumper/scenes/scene.h"

namespace bumper::examples {

/// A car as a scene begins, and its driver.
struct Driver {
  std::string name;
  Eigen::Vector2d place;  ///< of the mass centre, m
  double yaw = 0.0;       ///< rad
  double speed = 0.0;     ///< m/s
  double brakesAt = 0.0;  ///< s: from then on, and from the first impact on
};

/// A gate that slides along y: its body is moved by the application, whatever it hits.
struct SlidingGate {
  Eigen::Vector2d place;                    ///< of its middle as the scene begins, m
  double length = 6.0;                      ///< m
  double closedAt = 0.0;                    ///< y of its middle at which it stops, m
  double speed = 2.0;                       ///< m/s
  static constexpr double thickness = 0.2;  ///< m
  static constexpr double height = 1.4;     ///< m
};

/// A scene in which vehicles hit each other.
struct VehicleScene {
  std::string name;
  std::string title;
  Scene scene{};
  std::vector<Driver> drivers{};
  std::optional<SlidingGate> gate = std::nullopt;
  double duration = 4.0;  ///< s
};

/// An intersection, a rear-end chain of five, a pile-up of thirty on the motorway, a gate.
std::vector<VehicleScene> vehicleScenes();

/// What a gate looks like, in its own frame.
Scene meshOf(const SlidingGate& gate);

/// What a run did, and how well it kept to what must hold.
struct VehicleRun {
  Recording recording;
  int hits = 0;  ///< of two vehicles
  /// Of those without the gate: what a pair's momentum changed by, over the impulse.
  double momentumChange = 0.0;
  double deepestOverlap = 0.0;  ///< of two outlines at the end of any step, m
};

/// Steps of 5 ms; every second pose is recorded.
VehicleRun runVehicleScene(const VehicleScene& scene);

}  // namespace bumper::examples
