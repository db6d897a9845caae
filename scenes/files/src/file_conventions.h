#pragma once

#include <assimp/scene.h>

#include <filesystem>

#include "file_scene.h"

namespace bumper {

/// Sets the up axis and the unit of `result`, whose format is known, where the format's standard or
/// the file states them. Throws Error on an axis or a unit that does not exist.
void readConventions(const std::filesystem::path& file, const aiScene& source, FileScene& result);

}  // namespace bumper
