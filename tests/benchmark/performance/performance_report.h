#pragma once

#include <filesystem>

#include "performance_run.h"

namespace bumper::benchmark {

/// Writes the results to `json`, and beside it, with the same stem, tables as Markdown and a
/// gnuplot script that draws the plots there. Throws Error if a file cannot be written.
void writeReport(const Performance& performance, const std::filesystem::path& json);

}  // namespace bumper::benchmark
