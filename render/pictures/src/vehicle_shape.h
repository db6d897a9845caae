#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/render/recording.h"
#include "bumper/render/vehicle_meshes.h"
#include "bumper/response/vehicle_parameters.h"

namespace BUMPER_INTERNAL bumper {
namespace drawing {

/// A triangle of a drawn vehicle in the vehicle's frame (x forward, y left, z up, origin at the
/// mass centre).
struct ShapeTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  Eigen::Vector3f colour;
};

/// A car of the given paint that fills the vehicle's outline and stands on the ground: body, cabin
/// with windows, wheels, pale lamps in front, red ones behind.
std::vector<ShapeTriangle> vehicleShape(const VehicleParameters& vehicle,
                                        const Eigen::Vector3f& paint);

/// A mesh where VehicleMeshes places it.
std::vector<ShapeTriangle> vehicleShape(const VehicleParameters& vehicle, const Scene& mesh);

/// The vehicle with an index in the recording: its own mesh if it has one, else a car.
std::vector<ShapeTriangle> vehicleShape(const RecordedVehicle& vehicle, std::size_t index,
                                        const VehicleMeshes& meshes);

/// As many can be told apart, by the colour-blind too.
inline constexpr std::size_t paintCount = 8;

/// The paint of the vehicle with an index in the recording, the same in every picture. The first
/// ones differ; then they come again.
Eigen::Vector3f paintOf(std::size_t vehicle);

}  // namespace drawing
}  // namespace bumper
