#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <cstdint>

namespace bumper {

/// A check sum of a geom's class, size, and, where that decides what is a wall, of how it leans; of
/// a trimesh of all its triangles. Equal for a geom that was only moved.
std::uint64_t shapeOf(dGeomID geom, const Eigen::Vector3d& up);

}  // namespace bumper
