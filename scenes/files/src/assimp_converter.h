#pragma once

#include <assimp/scene.h>

#include <filesystem>

#include "file_scene.h"

namespace bumper {

/// Copies what assimp read into the plain arrays of `result.scene`, whose format is known: node
/// transforms applied, polygons cut into triangles. Trusts none of it: throws Error, naming `file`
/// and the mesh. Counts what it would
/// make before it makes anything: Error if that is above `budget`.
void convert(const std::filesystem::path& file, const aiScene& source, const SceneBudget& budget,
             FileScene& result, const Progress& progress);

}  // namespace bumper
