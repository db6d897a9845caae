#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "places.h"
#include "rig.h"

namespace bumper::doctor {

/// The largest fall of speed within a short time.
struct SpeedLoss {
  double loss = 0.0;                                ///< m/s
  std::size_t step = 0;                             ///< in which it was steepest
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< of the contact that did it, m
};

/// `within`: s.
SpeedLoss suddenLoss(const DriveTrace& trace, const TestDrive& drive, double step, double within);

/// The largest kinetic energy after the first contact, as a ratio to that at the start; 0 without a
/// contact.
double mostEnergy(const DriveTrace& trace);

/// Whether the mass centre went across a wall of the place.
bool wentThrough(const DriveTrace& trace, const Place& place);

}  // namespace bumper::doctor
