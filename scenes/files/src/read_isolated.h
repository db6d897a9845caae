#pragma once

#include <filesystem>

#include "file_scene.h"

namespace bumper {

/// Reads a file with the program bumper-read-scene. Throws Error; whatever happens, the program has
/// ended and the pipe to it is closed on return. `progress` must be callable.
FileScene readIsolated(const std::filesystem::path& file, const LoadOptions& options,
                       const Progress& progress);

}  // namespace bumper
