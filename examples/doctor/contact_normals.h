#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "places.h"
#include "rig.h"

namespace bumper::doctor {

/// A contact normal is wrong if it is off by more than this, rad.
inline constexpr double wrongNormal = 10.0 * degree;

/// Contacts of ODE's collider with faces that are parallel to the wall.
struct NormalCount {
  std::size_t contacts = 0;
  std::size_t wrong = 0;
  std::size_t poses = 0;
  std::size_t posesWithoutRight = 0;  ///< poses in which every normal is wrong

  /// The worst pose: the most wrong normals.
  std::size_t worstPlace = 0;  ///< index
  TestDrive worstPose;
  std::size_t worstWrong = 0;

  [[nodiscard]] double share() const {
    return contacts == 0 ? 0.0 : static_cast<double>(wrong) / static_cast<double>(contacts);
  }
};

/// The right normal of a contact: that of its face, on the side of `inside`, a point of the
/// vehicle.
Eigen::Vector3d trueNormal(const Wall& wall, const Eigen::Vector3d& inside);

/// Whether a face with such a normal belongs to the wall along a plane's x axis, to 15°.
bool isOfWall(const Eigen::Vector3d& trueNormal, const DrivingPlane& plane);

/// At each place the vehicle stands in the wall as deep as a step takes it, at five angles from 2°
/// to 90°.
NormalCount countNormals(const Subject& subject, std::span<const Place> places,
                         const std::vector<Wall>& walls, JointRig& rig);

}  // namespace bumper::doctor
