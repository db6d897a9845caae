#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <string>

#include "file_scene.h"

namespace bumper {

/// Sets the up axis and the unit of `result`, whose format is known, where the format's standard or
/// the file states them. Throws Error on an axis or a unit that does not exist.
void readConventions(const std::filesystem::path& file, const aiScene& source, FileScene& result);

/// Whether the root node's transform is the importer's own and no part of the file: from 5.4 on
/// assimp turns and scales the root of FBX files by the axes and the unit that they state. They
/// state them still, so readConventions() is right by either version if that is left out.
bool rootIsImporters(const std::string& format);

}  // namespace bumper
