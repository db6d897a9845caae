#include "performance_targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

namespace bumper::benchmark {

namespace {

using Figure = std::function<double(const QueryRow&)>;

double farOf(const QueryRow& row) { return row.nanoseconds[0]; }
double touchOf(const QueryRow& row) { return row.nanoseconds[2]; }

std::vector<std::string> scenesOf(const Performance& performance) {
  std::vector<std::string> scenes;
  for (const DriveShares& drive : performance.drives) scenes.push_back(drive.scene);
  return scenes;
}

/// "S1 0.31, S2 0.30": a figure for each scene that has it, and whether all are at most `limit`.
class PerScene {
 public:
  PerScene(const Performance& performance, std::vector<std::string> scenes)
      : performance_(performance), scenes_(std::move(scenes)) {}

  [[nodiscard]] Target ratio(const std::string& target, const Figure& figure,
                             const std::string& peer, std::optional<double> limit) const {
    return evaluate(target, limit, [&](const std::string& scene) {
      const QueryRow* own = rowOf(performance_, scene, "bumper");
      const QueryRow* other = rowOf(performance_, scene, peer);
      return own == nullptr || other == nullptr ? unknown : figure(*own) / figure(*other);
    });
  }

  [[nodiscard]] Target value(const std::string& target, const Figure& figure, double limit) const {
    return evaluate(target, limit, [&](const std::string& scene) {
      const QueryRow* own = rowOf(performance_, scene, "bumper");
      return own == nullptr ? unknown : figure(*own);
    });
  }

 private:
  Target evaluate(const std::string& target, std::optional<double> limit,
                  const std::function<double(const std::string&)>& figure) const {
    Target result{.target = target, .reached = ""};
    for (const std::string& scene : scenes_) {
      const double value = figure(scene);
      if (std::isnan(value)) continue;
      result.reached += (result.reached.empty() ? "" : ", ") + scene + " " + shortNumber(value);
      if (limit) result.met = result.met.value_or(true) && value <= *limit;
    }
    if (result.reached.empty()) result.reached = "not measured";
    return result;
  }

  const Performance& performance_;
  std::vector<std::string> scenes_;
};

Target single(const std::string& target, double value, const std::string& reached, double limit) {
  if (std::isnan(value)) return {.target = target, .reached = "not measured"};
  return {.target = target, .reached = reached, .met = value <= limit};
}

}  // namespace

const QueryRow* rowOf(const Performance& performance, const std::string& scene,
                      const std::string& scheme) {
  const auto found = std::ranges::find_if(performance.queries, [&](const QueryRow& row) {
    return row.scene == scene && row.scheme == scheme;
  });
  return found == performance.queries.end() ? nullptr : &*found;
}

std::string shortNumber(double value) {
  if (std::isnan(value)) return "–";
  std::array<char, 32> text{};
  const double size = std::abs(value);
  const char* format = size >= 100.0 ? "%.0f" : size >= 10.0 ? "%.1f" : "%.2f";
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::vector<Target> targetsOf(const Performance& performance) {
  const PerScene allScenes(performance, scenesOf(performance));
  const PerScene smallScenes(performance, {"S1", "S2", "S2g"});
  const PerScene largeScenes(performance, {"S3", "S4"});
  std::vector<Target> targets = {
      allScenes.ratio("far step ≤ 0.05 of dWorldQuickStep of one free body", farOf, "world_step",
                      0.05),
      allScenes.value(
          "far step ≤ 100 instructions", [](const QueryRow& row) { return row.instructions[0]; },
          100.0),
      smallScenes.ratio("touching step ≤ ODE's dCollide with 8 contacts", touchOf, "ode_contacts",
                        1.0),
      largeScenes.ratio("touching step ≤ 0.25 of it", touchOf, "ode_contacts", 0.25),
      allScenes.ratio("beside: touching step over dCollide with the walls alone", touchOf,
                      "ode_contacts_walls", std::nullopt),
      allScenes.ratio(
          "mean over the drive ≤ a hand-written grid with the same sweep",
          [](const QueryRow& row) { return row.pathMean; }, "grid_sweep", 1.0),
      allScenes.ratio(
          "memory ≤ 1.25 of ODE's mesh of the walls alone",
          [](const QueryRow& row) { return row.memory; }, "ode_contacts_walls", 1.25),
      PerScene(performance, {"S4"})
          .ratio(
              "building S4 ≤ ODE's building of the whole mesh",
              [](const QueryRow& row) { return row.buildTime; }, "ode_contacts", 1.0)};

  const std::vector<FleetRow>& fleets = performance.steps.fleets;
  const auto thousand = std::ranges::find(fleets, std::size_t{1000}, &FleetRow::vehicles);
  const FleetRow fleet = thousand == fleets.end() ? FleetRow{} : *thousand;
  targets.push_back(single("1,000 five-body cars: ≤ 30 ns a far car, warm", fleet.warm,
                           shortNumber(fleet.warm) + " ns; " + shortNumber(fleet.afterWorldStep) +
                               " ns after a world step, " + shortNumber(fleet.cold) + " ns cold",
                           30.0));
  const double share = 1000.0 * fleet.afterWorldStep / fleet.worldStep;
  targets.push_back(
      single("1,000 five-body cars: ≤ 0.05 of the world step", share, shortNumber(share), 0.05));
  targets.push_back(single("no allocation in step() after warm-up", performance.allocations,
                           shortNumber(performance.allocations) + " over a drive", 0.0));
  const double response =
      std::max(performance.steps.responseEnergy, performance.steps.responseRestitution);
  targets.push_back(single("response ≤ 30 ns", response,
                           shortNumber(performance.steps.responseEnergy) + " ns energy law, " +
                               shortNumber(performance.steps.responseRestitution) +
                               " ns restitution law",
                           30.0));
  return targets;
}

}  // namespace bumper::benchmark
