#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "examination.h"

namespace bumper::doctor {

/// A place to look at.
struct WorstPlace {
  std::string kind;                                    ///< one word, for names of files
  std::string words;                                   ///< what happens there
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  /// What happened; empty if the mesh alone is to be seen.
  std::optional<TestDrive> drive{};
  bool isStanding = false;  ///< the drive is a pose: dCollide's normals are of interest
  std::optional<std::size_t> triangle{};  ///< of the scene, if it is about one
  /// Unit, from the place to where it is seen from.
  Eigen::Vector3d out = Eigen::Vector3d::UnitX();
};

/// At most `most` of them, of all kinds, the worst of each kind first; places of a kind are at
/// least half a length of the vehicle apart.
std::vector<WorstPlace> worstPlaces(const Subject& subject, const Examination& examination,
                                    std::size_t most);

}  // namespace bumper::doctor
