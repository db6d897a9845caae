#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace bumper::testing {

using CsvRow = std::vector<std::string>;

/// The rows of an RFC 4180 text, quoted fields without their quotes.
std::vector<CsvRow> parseCsv(std::string_view text);

/// A row's fields by their columns' names.
using CsvRecord = std::map<std::string, std::string>;

/// The rows of a file whose first row names the columns. Throws std::runtime_error if it cannot be
/// read or a row has another number of fields than the first.
std::vector<CsvRecord> readCsv(const std::filesystem::path& file);

}  // namespace bumper::testing
