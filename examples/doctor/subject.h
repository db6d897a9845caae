#pragma once

#include <string>

#include "bumper/response/response_settings.h"
#include "bumper/response/vehicle_parameters.h"
#include "bumper/scenes/scene.h"
#include "bumper/scenes/walls.h"

namespace bumper::doctor {

/// What is examined: a mesh, and who drives through it how.
struct Subject {
  Scene scene;
  std::string scenery{};  ///< meshes that no vehicle hits; WallSelection::scenery
  VehicleParameters vehicle{};
  double step = 0.005;          ///< s
  double speed = 25.0;          ///< m/s, of the test drives
  ResponseSettings response{};  ///< contact joints get its e and μ too

  [[nodiscard]] double length() const {
    return vehicle.massCentreToFront + vehicle.massCentreToRear;
  }
  /// What stands out of a wall by less does not catch a vehicle, m; never 0.
  [[nodiscard]] double smallestFeature() const {
    return length() * (response.smallestFeature > 0.0 ? response.smallestFeature : 1e-4);
  }
  /// What a slide needs beside a wall, m.
  [[nodiscard]] double roomBeside() const { return 1.3 * vehicle.width; }
  [[nodiscard]] WallSelection selection() const { return {.scenery = scenery}; }
};

/// Of the box that stands for a vehicle, m, with the mass centre in its middle: as high above the
/// ground as a car's.
inline double boxHeight(const VehicleParameters& vehicle) {
  return 1.28 * vehicle.massCentreHeight;
}

}  // namespace bumper::doctor
