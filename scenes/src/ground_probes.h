#pragma once

#include <Eigen/Core>
#include <vector>

#include "bumper/response/planar_motion.h"
#include "bumper/scenes/scene.h"
#include "triangle.h"

namespace bumper {

/// What is steeper than 45° carries no vehicle.
inline constexpr double minGroundNormalUp = 0.707;

/// A place where ground goes on if there is a triangle in nearly the same plane.
struct GroundProbe {
  Eigen::Vector3d place;   ///< m
  Eigen::Vector3d normal;  ///< unit, upward
};

/// Which probes lie on triangles of the scene that are flat and no walls; by probe. All of them if
/// the search takes too long.
std::vector<bool> onGround(const std::vector<GroundProbe>& probes, const Scene& scene,
                           const std::vector<bool>& isWall);

/// Whether a triangle covers a place in plan, edges included.
bool covers(const TriangleCorners& triangle, const Vector2& place);

/// The unit normal of a triangle of either winding that points up.
Eigen::Vector3d upwardNormal(const TriangleCorners& triangle);

/// The height, m, of a plane through a point at a place.
double heightOfPlane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                     const Vector2& place);

}  // namespace bumper
