#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "bumper/scenes/walls.h"
#include "subject.h"

namespace bumper::doctor {

/// Steep triangles that Bumper does not take for walls, for one reason.
struct DroppedGroup {
  std::string reason;
  std::size_t triangles = 0;
  /// The largest of them: its middle, m, its index in Scene::triangles and the name of its mesh.
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::size_t largest = 0;
  std::string mesh{};
  bool isGuess = false;  ///< WallReport::droppedOnGuess: a vehicle may have to hit them
};

/// The groups that are not empty.
std::vector<DroppedGroup> droppedGroups(const Subject& subject, const Walls& walls);

}  // namespace bumper::doctor
