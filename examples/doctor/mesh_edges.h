#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "bumper/scenes/scene.h"

namespace bumper::doctor {

/// The edges of one kind, and the middle of the longest one, m.
struct EdgeCount {
  std::size_t count = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double longest = 0.0;  ///< m
};

/// How a scene's triangles hang together.
struct MeshEdges {
  EdgeCount open;         ///< of one triangle alone: a border, or a hole
  EdgeCount flipped;      ///< of two triangles of one mesh, one of which has the wrong winding
  EdgeCount nonManifold;  ///< of three triangles and more
};

/// `scene` has its corners welded, as loadScene() leaves them.
MeshEdges examineEdges(const Scene& scene);

}  // namespace bumper::doctor
