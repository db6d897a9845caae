#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "query_rows.h"

namespace bumper::benchmark {

/// Under valgrind --tool=callgrind --instr-atstart=no --collect-atstart=no: queries of each scheme
/// along the drive, the counters of each kind of pose dumped apart. Throws Error elsewhere.
void countInstructions(const NamedScene& scene, const std::vector<std::string>& schemes);

/// Reads what such a run dumped to a folder and writes the instructions per query into the rows of
/// the same scene and scheme. Without the folder nothing is known. Throws Error if a file in it is
/// not such a dump.
void readInstructionCounts(const std::filesystem::path& folder, std::vector<QueryRow>& rows);

}  // namespace bumper::benchmark
