#pragma once

#include "bumper/scenes/scene.h"
#include "picture.h"

namespace bumper::drawing {

/// Prepares a valid scene for drawing: surfaces in their meshes' colours; edges of what stands
/// upright, where it ends or turns; and upright surfaces once more, for shadows. Throws Error if
/// it has more triangles than OpenGL can count.
SceneModel sceneModel(const Scene& scene);

/// Three vertices with one normal.
void addSurface(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3f& colour,
                bool ground, std::vector<SurfaceVertex>& into);

}  // namespace bumper::drawing
