#pragma once

#include <filesystem>

#include "accuracy_rows.h"

namespace bumper::benchmark {

/// Writes the results to `json`, and beside it, with the same stem, a table as Markdown and a
/// gnuplot script that draws the plots there. Throws Error if a file cannot be written.
void writeReport(const Results& results, const std::filesystem::path& json);

}  // namespace bumper::benchmark
