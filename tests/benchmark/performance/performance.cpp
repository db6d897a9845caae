#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "performance_report.h"
#include "performance_targets.h"
#include "query_scheme.h"

/// What a query and a step cost: Bumper and its peers over the same drives, in one run.
namespace {

/// A line of progress with the seconds since the start.
void say(const std::string& line) {
  static const auto start = std::chrono::steady_clock::now();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  std::printf("%4.0f s  %s\n", elapsed.count(), line.c_str());
  std::fflush(stdout);
}

void drop(int /*number*/, const char* /*format*/, va_list /*values*/) {}

}  // namespace

int main(int argc, char** argv) try {
  using namespace bumper::benchmark;
  bool quick = false;
  bool count = false;
  std::filesystem::path counts;
  std::filesystem::path out = "out/benchmark/performance.json";
  CLI::App app("What a query and a step cost: Bumper and its peers over the same drives");
  app.add_option("--out", out, "The JSON file; tables and plots go beside it");
  app.add_option("--counts", counts, "Folder with the dumps of an earlier run with --count");
  app.add_flag("--quick", quick, "Fewer scenes and repetitions, for a first look");
  app.add_flag("--count", count,
               "Under valgrind --tool=callgrind --instr-atstart=no --collect-atstart=no: dumps "
               "instructions per query, measures nothing else");
  CLI11_PARSE(app, argc, argv);
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  dSetMessageHandler(drop);
  if (count) {
    countAllInstructions(quick);
  } else {
    PerformanceOptions options = quick ? quickOptions() : PerformanceOptions{};
    options.counts = counts;
    const Performance performance = measurePerformance(options, say);
    writeReport(performance, out);
    say("written to " + out.string());
  }
  dCloseODE();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
