#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "accuracy_report.h"
#include "accuracy_rows.h"
#include "hinge2_runs.h"
#include "schemes.h"

/// Run time against error: every scheme over many impacts with a wall, against the same law
/// computed exactly.
namespace bumper::benchmark {
namespace {

struct Options {
  std::size_t cases = 10000;     // of Bumper's rows in free flight
  std::size_t tyreCases = 1000;  // … and with tyres
  std::size_t plain = 240;       // of every scheme's rows: the first ones of these
  std::size_t timed = 40;        // the first of them again, for the clock
  std::size_t hinge2Cases = 200;
  int repetitions = 5;
  std::uint64_t seed = 20030601;
  std::filesystem::path out = "out/benchmark/accuracy.json";
};

void makeQuick(Options& options) {
  options.cases = 600;
  options.tyreCases = 120;
  options.plain = 60;
  options.timed = 10;
  options.hinge2Cases = 20;
}

/// A line of progress with the seconds since the start.
void say(const std::string& line) {
  static const auto start = std::chrono::steady_clock::now();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  std::printf("%4.0f s  %s\n", elapsed.count(), line.c_str());
  std::fflush(stdout);
}

std::string nameOf(Setting setting, int triangles) {
  return std::string(nameOf(setting)) + ", " + std::to_string(triangles) + " triangles: ";
}

/// Messages of ODE's solver, which would drown the progress: counted.
std::size_t solverMessages = 0;
void countMessage(int /*number*/, const char* /*format*/, va_list /*values*/) { ++solverMessages; }

/// The cases of a setting and their references.
struct Batch {
  Setting setting = Setting::free_flight;
  std::vector<ImpactCase> cases;
  std::vector<CaseReference> references;
};

Batch makeBatch(Setting setting, const Options& options, std::size_t count) {
  say(std::string(nameOf(setting)) + ": references of " + std::to_string(count) + " cases");
  Batch batch{.setting = setting,
              .cases = makeCases(readCars(BUMPER_VEHICLES), std::min(options.plain, count), count,
                                 options.seed + static_cast<std::uint64_t>(setting)),
              .references = {}};
  for (const ImpactCase& one : batch.cases) batch.references.push_back(referenceOf(one, setting));
  return batch;
}

Apart apartOf(const Batch& batch) {
  const auto count = [&](auto&& is) {
    return static_cast<std::size_t>(std::ranges::count_if(batch.references, is));
  };
  return {
      .count = batch.cases.size(),
      .sensitive = count([](const CaseReference& r) { return r.sensitive && !r.flight.lasting; }),
      .lasting = count([](const CaseReference& r) { return r.flight.lasting; })};
}

/// Bumper and what it is measured by run all cases, the others those that all can do.
bool runsAll(const std::string& scheme) {
  return scheme == "bumper" || scheme == "reference_impulses";
}

/// The rows of one setting but for their time.
void measureErrors(const Batch& batch, const Options& options, Results& results) {
  for (const int triangles : wallMeshes) {
    for (const std::string& name : schemeNames(batch.setting)) {
      say(nameOf(batch.setting, triangles) + name);
      const std::unique_ptr<Scheme> scheme = makeScheme(name, batch.setting, triangles);
      std::vector<RowMaker> rows(std::size(stepSizes));
      std::vector<RowMaker> lasting(std::size(stepSizes));
      const std::size_t count = runsAll(name) ? batch.cases.size() : options.plain;
      for (std::size_t k = 0; k < count; ++k) {
        const CaseReference& reference = batch.references[k];
        if (reference.sensitive && !reference.flight.lasting) continue;
        for (std::size_t i = 0; i < std::size(stepSizes); ++i) {
          const RunResult result = scheme->run(
              {.impactCase = &batch.cases[k], .reference = &reference, .step = stepSizes[i]});
          (reference.flight.lasting ? lasting : rows)[i].add(
              errorOf(batch.cases[k], reference, result.end), result.energyGain);
        }
      }
      for (std::size_t i = 0; i < std::size(stepSizes); ++i) {
        results.rows.push_back(rows[i].row(batch.setting, name, triangles, stepSizes[i]));
        if (name == "bumper") {
          results.lasting.push_back(lasting[i].row(batch.setting, name, triangles, stepSizes[i]));
        }
      }
    }
  }
}

/// The time of the rows: the least of several repetitions of the same cases, scheme by scheme in
/// turn.
void measureTimes(const Batch& batch, const Options& options, Results& results) {
  for (const int triangles : wallMeshes) {
    std::vector<std::unique_ptr<Scheme>> schemes;
    for (const std::string& name : schemeNames(batch.setting)) {
      schemes.push_back(makeScheme(name, batch.setting, triangles));
    }
    say(nameOf(batch.setting, triangles) + "time");
    for (const double h : stepSizes) {
      std::vector<double> least(schemes.size(), std::numeric_limits<double>::infinity());
      for (int repetition = 0; repetition < options.repetitions; ++repetition) {
        for (std::size_t s = 0; s < schemes.size(); ++s) {
          double time = 0.0;
          double simulated = 0.0;
          for (std::size_t k = 0; k < options.timed; ++k) {
            time += schemes[s]
                        ->run({.impactCase = &batch.cases[k],
                               .reference = &batch.references[k],
                               .step = h,
                               .watchEnergy = false})
                        .cpuTime;
            simulated += batch.references[k].duration;
          }
          least[s] = std::min(least[s], 1e6 * time / simulated);
        }
      }
      const std::vector<std::string> names = schemeNames(batch.setting);
      for (Row& row : results.rows) {
        if (row.setting != batch.setting || row.wallTriangles != triangles || row.step != h)
          continue;
        const auto which = std::ranges::find(names, row.scheme) - names.begin();
        row.cpuPerSimulatedTime = least[static_cast<std::size_t>(which)];
      }
    }
  }
}

/// How much the tyres' reference changes when its step is halved, m.
double tyreReferenceError(const Batch& batch, std::size_t count) {
  double largest = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const ImpactCase& one = batch.cases[k];
    const Flight finer =
        forcedFlight(one.car.body, one.start, theWall(), one.law.settings,
                     batch.references[k].duration, tyreForces(one), 0.5 * tyreReferenceStep);
    largest =
        std::max(largest, (finer.end.position - batch.references[k].flight.end.position).norm());
  }
  return largest;
}

void run(const Options& options) {
  Results results;
  results.seed = options.seed;
  const auto measure = [&](Setting setting, std::size_t count, Apart& apart) {
    const Batch batch = makeBatch(setting, options, count);
    apart = apartOf(batch);
    say("counted apart of " + std::to_string(apart.count) +
        " cases: " + std::to_string(apart.lasting) + " lasting contacts, " +
        std::to_string(apart.sensitive) + " sensitive ones");
    measureErrors(batch, options, results);
    measureTimes(batch, options, results);
    if (setting == Setting::tyres) {
      results.tyreReferenceError = tyreReferenceError(batch, options.plain);
    }
  };
  measure(Setting::free_flight, options.cases, results.freeFlight);
  measure(Setting::tyres, options.tyreCases, results.tyres);
  say("hinge2 car");
  std::ranges::copy(hinge2Rows(options.hinge2Cases, options.seed + 2, options.repetitions),
                    std::back_inserter(results.rows));
  results.solverMessages = solverMessages;
  writeReport(results, options.out);
  say("written to " + options.out.string());
}

}  // namespace
}  // namespace bumper::benchmark

int main(int argc, char** argv) try {
  using namespace bumper::benchmark;
  Options options;
  bool quick = false;
  CLI::App app("Run time against error: Bumper and its peers on impacts of one car with one wall");
  CLI::Option* cases =
      app.add_option("--cases", options.cases, "Cases of Bumper's rows in free flight")
          ->check(CLI::Range(std::size_t{60}, std::size_t{1000000}));
  app.add_option("--seed", options.seed, "Seed of the cases");
  app.add_option("--out", options.out, "The JSON file; table and plots go beside it");
  app.add_flag("--quick", quick, "Fewer cases, for a first look")->excludes(cases);
  CLI11_PARSE(app, argc, argv);
  if (quick) makeQuick(options);
  options.plain = std::min(options.plain, options.cases);
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  dSetMessageHandler(countMessage);
  run(options);
  dCloseODE();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
