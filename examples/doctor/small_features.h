#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "bumper/scenes/walls.h"

namespace bumper::doctor {

/// A place where a wall goes on beside its own line, or after a gap.
struct SmallFeature {
  Eigen::Vector3d place;  ///< m
  double size = 0.0;      ///< m that it stands out, or that it gapes
  bool isGap = false;
  std::size_t wall = 0;  ///< index of the wall that ends there
};

/// The steps and gaps of walls that are smaller than `smallest`, m, but larger than a two-hundredth
/// of it, as sections at every `spacing` of height show them, the largest first. Walls more than
/// 4 m above the foot of their surface are not looked at. Those within a quarter of a metre (ten
/// times `smallest`, if that is less) of a larger one count as one with it.
std::vector<SmallFeature> smallFeatures(const std::vector<Wall>& walls, double smallest,
                                        double spacing);

}  // namespace bumper::doctor
