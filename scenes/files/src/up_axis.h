#pragma once

#include <Eigen/Core>
#include <string>

#include "bumper/scenes/scene_files.h"

namespace bumper {

/// A vector of a file in a scene's axes, if `up` is the file's axis that points up.
Eigen::Vector3d turned(const Eigen::Vector3d& v, UpAxis up);

/// Of a scene in metres that was turned by `up`: what speaks for another axis. Empty if nothing
/// does. What speaks is ground, walls beside it, more than twice the area that faces along either
/// other axis, and a third of the height: a hall on its side, land that stands like a wall. Walls
/// without ground may be right either way.
std::string upContradiction(const Scene& scene, UpAxis up);

}  // namespace bumper
