#include "performance_run.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "allocations.h"
#include "instruction_counts.h"
#include "query_scheme.h"

namespace bumper::benchmark {

namespace {

/// Allocations of Bumper's steps over a drive that it has gone before.
double allocationsOfDrive(std::size_t poses) {
  const NamedScene scene = makeScene("S2g");
  const Drive drive = makeDrive(scene.scene, poses);
  const std::unique_ptr<QueryScheme> scheme = makeQueryScheme("bumper", scene.scene);
  scheme->ask(drive.poses);
  const std::size_t before = allocationCount();
  scheme->ask(drive.poses);
  return static_cast<double>(allocationCount() - before);
}

// Of larger scenes what takes too long is cut short.
constexpr std::size_t large = 500000;  // triangles

QueryOptions optionsFor(std::size_t triangles, QueryOptions options) {
  if (triangles > large) options.builds = std::min(options.builds, 2);
  return options;
}

std::vector<std::string> schemesFor(std::size_t triangles) {
  std::vector<std::string> names = querySchemeNames();
  names.insert(names.begin() + 1, "bumper_teleport");
  if (triangles > large) std::erase(names, "osg_flat_shuffled");  // half a second a query
  return names;
}

}  // namespace

PerformanceOptions quickOptions() {
  PerformanceOptions options;
  options.scenes = {"S1", "S2g"};
  options.growth = {1000};
  options.queries = {.poses = 6000, .repetitions = 2, .builds = 1, .budget = 4.0};
  options.steps = {.repetitions = 1, .fleets = {1, 10}};
  options.table1Repetitions = 1;
  return options;
}

Performance measurePerformance(const PerformanceOptions& options,
                               const std::function<void(const std::string&)>& say) {
  Performance result;
  for (const std::string& name : options.scenes) {
    const NamedScene scene = makeScene(name);
    const std::size_t triangles = scene.scene.triangles.size();
    say("queries on " + name + ", " + std::to_string(triangles) + " triangles");
    QueryMeasurement measured =
        measureQueries(scene, schemesFor(triangles), optionsFor(triangles, options.queries));
    result.drives.push_back(measured.drive);
    std::ranges::move(measured.rows, std::back_inserter(result.queries));
  }
  for (const std::size_t triangles : options.growth) {
    say("growth, " + std::to_string(triangles) + " triangles");
    QueryMeasurement measured =
        measureQueries(courseOfSize(triangles),
                       {"bumper", "ode_contacts", "ode_contacts_walls", "grid_limit", "grid_sweep"},
                       options.queries);
    std::ranges::move(measured.rows, std::back_inserter(result.growth));
  }
  // Two of the scenes are of the same kind.
  std::ranges::copy_if(result.queries, std::back_inserter(result.growth), [&](const QueryRow& row) {
    return (row.scene == "S3" || row.scene == "S4") &&
           std::ranges::any_of(result.growth,
                               [&](const QueryRow& other) { return other.scheme == row.scheme; });
  });
  std::ranges::stable_sort(result.growth, {}, &QueryRow::triangles);
  say("whole steps and fleets");
  result.steps = measureSteps(options.steps);
  say("the paper's Table 1");
  result.table1 = measureTable1(options.table1Repetitions);
  result.allocations = allocationsOfDrive(options.queries.poses);
  readInstructionCounts(options.counts, result.queries);
  result.instructionsCounted = std::ranges::any_of(
      result.queries, [](const QueryRow& row) { return !std::isnan(row.instructions[0]); });
  return result;
}

void countAllInstructions(bool quick) {
  const std::vector<std::string> all = {"bumper", "ode_contacts", "ode_contacts_walls",
                                        "grid_limit", "grid_sweep"};
  for (const char* name : {"S1", "S2g"}) countInstructions(makeScene(name), all);
  if (quick) return;
  for (const char* name : {"S2", "S3"}) countInstructions(makeScene(name), all);
  // Under valgrind ODE would build its tree for minutes.
  countInstructions(makeScene("S4"), {"bumper", "grid_limit", "grid_sweep"});
}

}  // namespace bumper::benchmark
