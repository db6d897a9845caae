#pragma once

#include <Eigen/Core>

#include "bumper/scenes/scene.h"

namespace bumper::examples {

/// Adds a part that is one mesh.
void addPart(const Scene& part, const SceneMesh& mesh, Scene& scene);

/// A level rectangle at z = 0 with these corners, m.
Scene level(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

/// A closed box with these corners, m.
Scene block(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

}  // namespace bumper::examples
