#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "query_rows.h"
#include "step_rows.h"
#include "table1.h"

namespace bumper::benchmark {

struct PerformanceOptions {
  std::vector<std::string> scenes{"S1", "S2", "S2g", "S3", "S4"};
  std::vector<std::size_t> growth{1000, 3000, 10000, 30000, 300000};  ///< triangles, besides
  QueryOptions queries;
  StepOptions steps;
  int table1Repetitions = 5;
  /// Where countInstructions() left its dumps; none there: instructions stay unknown.
  std::filesystem::path counts;
};

/// A first look that takes seconds.
PerformanceOptions quickOptions();

/// All that performance.json holds.
struct Performance {
  std::vector<DriveShares> drives;
  std::vector<QueryRow> queries;
  std::vector<QueryRow> growth;
  StepMeasurement steps;
  std::vector<Table1Row> table1;
  double allocations = unknown;  ///< of one drive with Bumper after a first one
  bool instructionsCounted = false;
};

/// Measures everything in one run; calls `say` with what begins.
Performance measurePerformance(const PerformanceOptions& options,
                               const std::function<void(const std::string&)>& say);

/// The scenes and schemes whose instructions are counted.
void countAllInstructions(bool quick);

}  // namespace bumper::benchmark
