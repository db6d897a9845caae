#include "performance_report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "performance_plots.h"
#include "performance_targets.h"
#include "text_file.h"

namespace bumper::benchmark {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isnan(value) ? Json() : Json(value); }

Json asJson(const QueryRow& row) {
  return {{"scene", row.scene},
          {"triangles", row.triangles},
          {"scheme", row.scheme},
          {"far_ns", number(row.nanoseconds[0])},
          {"near_ns", number(row.nanoseconds[1])},
          {"touch_ns", number(row.nanoseconds[2])},
          {"path_mean_ns", number(row.pathMean)},
          {"build_ms", number(row.buildTime)},
          {"memory_mb", number(row.memory)},
          {"instructions_far", number(row.instructions[0])},
          {"instructions_near", number(row.instructions[1])},
          {"instructions_touch", number(row.instructions[2])},
          {"found_touching", row.foundTouching},
          {"found_far", row.foundFar}};
}

Json asJson(const StepRow& row) {
  return {{"scene", row.scene},   {"scheme", row.scheme},    {"vehicles", row.vehicles},
          {"bodies", row.bodies}, {"free_ns", row.freeTime}, {"contact_ns", row.contactTime}};
}

// A fleet's whole step: the world's, and the responder's after it.
Json asJson(const FleetRow& row) {
  const auto count = static_cast<double>(row.vehicles);
  return {{"scene", row.scene},
          {"scheme", "bumper"},
          {"vehicles", row.vehicles},
          {"bodies", 5},
          {"free_ns", row.worldStep + count * row.afterWorldStep},
          {"contact_ns", row.worldStep + count * row.inContact},
          {"world_step_ns", row.worldStep},
          {"far_car_warm_ns", row.warm},
          {"far_car_after_world_step_ns", row.afterWorldStep},
          {"far_car_cold_ns", row.cold},
          {"car_in_contact_ns", row.inContact}};
}

Json asJson(const Table1Row& row) {
  return {{"scene", row.scene},
          {"law", row.law},
          {"scheme", row.scheme},
          {"update_us", row.update},
          {"no_collision_us", row.withoutCollision}};
}

Json asJson(const DriveShares& drive) {
  return {{"scene", drive.scene},
          {"far", drive.shares[0]},
          {"near", drive.shares[1]},
          {"touching", drive.shares[2]}};
}

Json asJson(const Target& target) {
  return {{"target", target.target},
          {"reached", target.reached},
          {"met", target.met ? Json(*target.met) : Json()}};
}

template <class Rows>
Json arrayOf(const Rows& rows) {
  Json array = Json::array();
  for (const auto& row : rows) array.push_back(asJson(row));
  return array;
}

Json asJson(const Performance& performance) {
  Json steps = arrayOf(performance.steps.steps);
  for (const FleetRow& row : performance.steps.fleets) steps.push_back(asJson(row));
  return {{"drives", arrayOf(performance.drives)},
          {"queries", arrayOf(performance.queries)},
          {"growth", arrayOf(performance.growth)},
          {"steps", steps},
          {"table1", arrayOf(performance.table1)},
          {"response_ns",
           {{"energy", number(performance.steps.responseEnergy)},
            {"restitution", number(performance.steps.responseRestitution)}}},
          {"allocations_over_a_drive", number(performance.allocations)},
          {"targets", arrayOf(targetsOf(performance))}};
}

void writeQueries(std::ostream& out, const std::vector<QueryRow>& rows) {
  out << "| scene | triangles | scheme | far, ns | near | touching | mean over the drive | build, "
         "ms "
         "| memory, MB | instructions: far | near | touching |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const QueryRow& row : rows) {
    out << "| " << row.scene << " | " << row.triangles << " | " << row.scheme;
    for (const double time : row.nanoseconds) out << " | " << shortNumber(time);
    out << " | " << shortNumber(row.pathMean) << " | " << shortNumber(row.buildTime) << " | "
        << shortNumber(row.memory);
    for (const double count : row.instructions) out << " | " << shortNumber(count);
    out << " |\n";
  }
  out << '\n';
}

void writeSteps(std::ostream& out, const StepMeasurement& steps) {
  out << "## Whole steps\n\nOne vehicle on S2g, collide, respond and step the world, ns. In "
         "contact: "
         "pressed on the wall with 3 kN, sliding along it at 20 m/s.\n\n"
         "| bodies | scheme | free | in contact |\n|---|---|---|---|\n";
  for (const StepRow& row : steps.steps) {
    out << "| " << row.bodies << " | " << row.scheme << " | " << shortNumber(row.freeTime) << " | "
        << shortNumber(row.contactTime) << " |\n";
  }
  out << "\nFive-body cars on S2g. `step()`, ns a car: far from walls with nothing but motion in "
         "between, after a world step, with cold caches; and leaning on a wall.\n\n"
         "| cars | world step, µs | warm | after a world step | cold | leaning | share of the "
         "world "
         "step |\n|---|---|---|---|---|---|---|\n";
  for (const FleetRow& row : steps.fleets) {
    const double share = static_cast<double>(row.vehicles) * row.afterWorldStep / row.worldStep;
    out << "| " << row.vehicles << " | " << shortNumber(1e-3 * row.worldStep) << " | "
        << shortNumber(row.warm) << " | " << shortNumber(row.afterWorldStep) << " | "
        << shortNumber(row.cold) << " | " << shortNumber(row.inContact) << " | "
        << shortNumber(100.0 * share) << " % |\n";
  }
  out << '\n';
}

void writeTable1(std::ostream& out, const std::vector<Table1Row>& rows) {
  out << "## The paper's Table 1\n\nAn update with collision, and without, µs. The paper, on a "
         "Pentium II of 300 MHz: test rail 2520 (energy) and 2600 (restitution), course 4690 and "
         "4640, regrouped 3880 and 3900, no collision 990.\n\n"
         "| scene | law | scheme | update | without collision |\n|---|---|---|---|---|\n";
  for (const Table1Row& row : rows) {
    out << "| " << row.scene << " | " << row.law << " | " << row.scheme << " | "
        << shortNumber(row.update) << " | " << shortNumber(row.withoutCollision) << " |\n";
  }
  out << '\n';
}

std::string markdown(const Performance& performance) {
  std::ostringstream out;
  out << "# Query and step cost\n\n## Targets\n\n| target | reached | met |\n|---|---|---|\n";
  for (const Target& target : targetsOf(performance)) {
    out << "| " << target.target << " | " << target.reached << " | "
        << (!target.met   ? "–"
            : *target.met ? "yes"
                          : "**no**")
        << " |\n";
  }
  if (!performance.instructionsCounted) out << "\nInstructions were not counted.\n";
  out << "\n## Drives\n\n| scene | far | near | touching |\n|---|---|---|---|\n";
  for (const DriveShares& drive : performance.drives) {
    out << "| " << drive.scene;
    for (const double share : drive.shares) out << " | " << shortNumber(100.0 * share) << " %";
    out << " |\n";
  }
  out << "\n## Queries\n\n";
  writeQueries(out, performance.queries);
  writeSteps(out, performance.steps);
  writeTable1(out, performance.table1);
  out << "## Growth with triangles\n\n";
  writeQueries(out, performance.growth);
  return out.str();
}

}  // namespace

void writeReport(const Performance& performance, const std::filesystem::path& json) {
  writeFile(json, asJson(performance).dump(2) + '\n');
  writeFile(std::filesystem::path(json).replace_extension(".md"), markdown(performance));
  writeFile(std::filesystem::path(json).replace_extension(".gp"),
            plotScript(performance, json.stem().string()));
}

}  // namespace bumper::benchmark
