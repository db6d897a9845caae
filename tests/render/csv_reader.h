#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bumper::testing {

using CsvRow = std::vector<std::string>;

/// The bytes of a file.
std::string readText(const std::filesystem::path& file);

/// The rows of an RFC 4180 text, quoted fields without their quotes.
std::vector<CsvRow> parseCsv(const std::string& text);

}  // namespace bumper::testing
