#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace bumper::testing {

/// The bytes of a file. Throws std::runtime_error if it cannot be read.
std::string readText(const std::filesystem::path& file);

/// Puts bytes in place of a file. Throws std::runtime_error if it cannot be written.
void writeText(const std::filesystem::path& file, std::string_view text);

}  // namespace bumper::testing
