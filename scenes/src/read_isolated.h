#pragma once

#include <filesystem>

#include "file_scene.h"

namespace bumper {

/// Reads a file with the program bumper-read-scene. Throws Error; whatever happens, the program has
/// ended and the pipe to it is closed on return.
FileScene readIsolated(const std::filesystem::path& file, const LoadOptions& options);

}  // namespace bumper
