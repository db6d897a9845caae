#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "bumper/render/image.h"

namespace bumper::testing {

using ColourTest = std::function<bool(const Rgb&)>;

/// The colour of impact marks and of the numbers beside them.
bool isMarkColour(const Rgb& pixel);

/// The first vehicle's paint in any light, as a solid vehicle wears it.
bool isPaint(const Rgb& pixel);

/// Pixels of a kind that hang together, as their centres.
struct Patch {
  std::vector<Eigen::Vector2d> pixels;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
};

std::vector<Patch> findPatches(const Image& image, const ColourTest& belongs);

/// The convex hull of points: a patch with the gaps in its outline filled.
struct Hull {
  std::vector<Eigen::Vector2d> corners;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  ///< of its area
  double direction = 0.0;  ///< of its longer axis, rad in (−π/2, π/2], y down
};

Hull hullOf(const std::vector<Eigen::Vector2d>& points);

}  // namespace bumper::testing
