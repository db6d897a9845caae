#pragma once

#include <filesystem>

#include "file_scene.h"

namespace bumper {

enum class Formats {
  safe,  ///< those that the calling process can be trusted with, chosen by the file's ending
  all,   ///< whatever assimp supports, by ending and content
};

/// Reads a file with assimp in this process and converts what it holds. Throws Error. `progress`
/// must be callable.
FileScene readWithAssimp(const std::filesystem::path& file, Formats formats,
                         const Progress& progress);

}  // namespace bumper
