#pragma once

#include <assimp/scene.h>

#include <filesystem>

#include "file_scene.h"

namespace bumper {

/// Copies what assimp read into the plain arrays of `result.scene`, whose format is known: node
/// transforms applied, polygons cut into triangles. Trusts none of it: throws Error, naming `file`
/// and the mesh.
void convert(const std::filesystem::path& file, const aiScene& source, FileScene& result,
             const Progress& progress);

}  // namespace bumper
