#pragma once

#include <Eigen/Core>
#include <array>
#include <set>
#include <vector>

#include "bumper/scenes/walls.h"

namespace bumper::tests {

/// A box that stands on ground: the volume that a vehicle's outline sweeps over its band.
struct StandingCar {
  Eigen::Vector3d middle;  ///< of the box
  Eigen::Matrix3d axes;    ///< forward, left, up
  Eigen::Vector3d half;    ///< m
};

/// The box of a car whose wheels stand at these places: front left, front right, rear left, rear
/// right; `overhang` beyond the wheels, the band's heights above them, m.
StandingCar carOn(const std::array<Eigen::Vector3d, 4>& wheels, double overhang, double bottom,
                  double top);

/// Whether any point of a triangle lies in the box, by clipping the triangle with its six sides.
bool touches(const StandingCar& car, const std::array<Eigen::Vector3d, 3>& triangle);

/// The places of the walls that touch, each once, whatever their order and winding.
std::set<std::vector<double>> touchingWalls(const StandingCar& car, const std::vector<Wall>& walls);

}  // namespace bumper::tests
