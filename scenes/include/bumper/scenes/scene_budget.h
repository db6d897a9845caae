#pragma once

#include <cstddef>

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

struct Scene;

/// How much of a file becomes a scene. A small file may hold a mesh that it shows a million times,
/// and what is made of a scene (walls, their plan, a trimesh, a picture) takes time and memory in
/// proportion to its triangles: these limits bound all of it. More is an Error that names the
/// limit. The depth of a file's nodes has none: they are visited without recursion.
struct SceneBudget {
  /// Triangles, each copy of a mesh counted; and vertices, three for each of them. Ten times those
  /// of the largest race tracks; 0.5 GB, and up to 10 s until they are a barrier.
  std::size_t triangles = 5'000'000;
  /// A file's nodes, and the copies of meshes that they show: as many as that have a name each. A
  /// town has 100,000; 0.2 GB.
  std::size_t nodes = 1'000'000;
  /// The names of meshes and materials together, bytes; the same name is kept with each mesh.
  std::size_t names = std::size_t{64} << 20U;
  /// One name, bytes. Far more than a person writes, and no more than matchingMeshes() allows.
  std::size_t nameLength = 1000;
};

/// Throws Error if a scene holds more, naming the scene and the limit.
void validate(const Scene& scene, const SceneBudget& budget);

}  // namespace bumper
