#pragma once

#include <filesystem>

#include "bumper/base/api.h"
#include "file_scene.h"

namespace BUMPER_INTERNAL bumper {

enum class Formats {
  own,  ///< those of loadTrustedScene(), chosen by the file's ending
  all,  ///< whatever assimp supports, by ending and content
};

/// Reads a file with assimp in this process and converts what it holds. Throws Error. `progress`
/// must be callable.
FileScene readWithAssimp(const std::filesystem::path& file, Formats formats,
                         const SceneBudget& budget, const Progress& progress);

}  // namespace bumper
