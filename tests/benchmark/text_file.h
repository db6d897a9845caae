#pragma once

#include <filesystem>
#include <string>

namespace bumper::benchmark {

/// Writes a whole file, and the folder that it lies in. Throws Error if it cannot.
void writeFile(const std::filesystem::path& path, const std::string& text);

}  // namespace bumper::benchmark
