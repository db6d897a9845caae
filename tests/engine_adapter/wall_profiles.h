#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "bumper/scenes/scene.h"

namespace bumper::tests {

/// A wall as its cross-section: points (x, z), m, from the road, which lies at z = 0, to its top.
/// The wall faces the road, −x.
struct WallProfile {
  std::string name;
  std::vector<Eigen::Vector2d> points;
  double faceX = 0.0;      ///< where its face is at the height that cars hit
  double groundZ = 0.0;    ///< of what a car at the face stands on
  std::size_t ground = 0;  ///< pieces, from the road on, that are ground to a car at the face
};

/// Flush, with plinths, concrete barriers, behind a sidewalk, with a rocky base.
std::vector<WallProfile> wallProfiles();

/// Such a wall, 16 m long, with its road.
struct ProfileScene {
  static constexpr std::size_t road = 0;  ///< the piece that is the road

  Scene scene;
  std::vector<std::size_t> pieceOf;  ///< by triangle: 0 the road, from 1 on the profile's

  /// In quads no larger than `fineness`, m, and placed by `place`.
  ProfileScene(const WallProfile& profile, double fineness, const Eigen::Isometry3d& place);
};

}  // namespace bumper::tests
