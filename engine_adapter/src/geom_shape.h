#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <cstdint>

namespace bumper {

/// A check sum of a geom's class and size, of a trimesh of all its triangles: equal for a geom that
/// was only moved.
std::uint64_t shapeOf(dGeomID geom);

/// One of how it leans, to a thousandth of a radian.
std::uint64_t leanOf(dGeomID geom, const Eigen::Vector3d& up);

}  // namespace bumper
