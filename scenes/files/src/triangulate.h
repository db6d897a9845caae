#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace bumper {

/// Polygons with more corners than this are cut only if they are convex: the time for others grows
/// with the cube of it.
inline constexpr std::size_t maxConcaveCorners = 1000;

/// Cuts a polygon, convex or not, into triangles of the same winding: three indices into `polygon`
/// each, always two less than it has corners. False if it has too many corners.
bool triangulate(const std::vector<Eigen::Vector3d>& polygon,
                 std::vector<std::array<std::size_t, 3>>& triangles);

}  // namespace bumper
