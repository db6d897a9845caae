// Examines a mesh for what it would do to a vehicle, with contact joints and with Bumper.
//
//   bumper-doctor track.obj --up z --vehicle car --step 0.005 --speed 25 --pictures doctor
//
// What is measured are real drives in ODE along and into the walls.

#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "bumper/base/output_file.h"
#include "bumper/base/printing.h"
#include "bumper/response/error.h"
#include "bumper/response/presets.h"
#include "checks.h"
#include "examination.h"
#include "place_pictures.h"
#include "report.h"
#include "scene_loading.h"
#include "tool.h"
#include "vehicle_presets.h"
#include "worst_places.h"

namespace {

using namespace bumper;
using namespace bumper::doctor;
using namespace bumper::tools;

constexpr int healthy = 0;
constexpr int problemsFound = 1;
constexpr int notExamined = 2;

struct Arguments {
  std::filesystem::path file;
  std::string up;
  double scale = 1.0;
  std::string scenery;
  std::string vehicle = "car";
  VehicleChanges changes{};
  std::string preset = "paper";
  double step = 0.005;  // s
  double speed = 25.0;  // m/s
  std::size_t places = 100;
  std::size_t worst = 8;
  std::filesystem::path pictures;
  std::filesystem::path json;
  std::vector<std::string> failOn;
};

std::vector<std::string> textsOf(std::span<const std::string_view> names) {
  return {names.begin(), names.end()};
}

Subject subjectOf(const Arguments& arguments, LoadReport& load) {
  Subject subject{.scene = tools::loadScene(arguments.file, "--up",
                                            {.up = upAxis(arguments.up), .scale = arguments.scale},
                                            &load)};
  subject.scenery = arguments.scenery;
  subject.vehicle = changed(*findVehicle(arguments.vehicle), arguments.changes);
  subject.step = arguments.step;
  subject.speed = arguments.speed;
  subject.response = *findPreset(arguments.preset);
  return subject;
}

std::vector<std::string> askedFor(const Arguments& arguments) {
  if (arguments.failOn.empty()) return textsOf(usualChecks());
  if (std::ranges::find(arguments.failOn, "all") != arguments.failOn.end())
    return textsOf(checkNames());
  return arguments.failOn;
}

int examineFile(const Arguments& arguments) {
  dInitODE2(0);
  LoadReport load;
  const Subject subject = subjectOf(arguments, load);
  ProgressLine line("examining");
  const Examination examination = examine(subject, load, arguments.places, [&](Stage stage) {
    line(static_cast<std::size_t>(stage), static_cast<std::size_t>(Stage::tunnelling) + 1);
  });
  Report report{.file = arguments.file.filename().string(),
                .vehicle = arguments.vehicle,
                .subject = subject,
                .examination = examination,
                .checks = checksOf(subject, examination),
                .problems = {},
                .worst = worstPlaces(subject, examination, arguments.worst),
                .pictures = {}};
  const std::vector<std::string> asked = askedFor(arguments);
  report.problems = problemsAmong(report.checks, asked);
  if (!arguments.pictures.empty())
    report.pictures = drawPlaces(subject, examination, report.worst, arguments.pictures);
  if (!arguments.json.empty()) {
    OutputFile file(arguments.json);
    file.write({jsonOf(report)});
    file.moveToPlace();
  }
  printTable(report);
  dCloseODE();
  return report.problems.empty() ? healthy : problemsFound;
}

void addOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("file", arguments.file, "mesh file, any format that assimp reads")->required();
  tools::addUpAndScale(app, arguments.up, arguments.scale);
  app.add_option("--scenery", arguments.scenery,
                 "meshes that no vehicle hits, by name or material: a regular expression");
  app.add_option("--vehicle", arguments.vehicle, "what the following is not said of")
      ->check(CLI::IsMember(textsOf(vehicleNames())))
      ->capture_default_str();
  const auto addChange = [&](const char* name, std::optional<double>& value, const char* words) {
    app.add_option(name, value, words)->check(numberIn(1e-6, 1e9));
  };
  addChange("--length", arguments.changes.length, "m");
  addChange("--width", arguments.changes.width, "m");
  addChange("--mass", arguments.changes.mass, "kg");
  addChange("--yaw-inertia", arguments.changes.yawInertia, "kg m²");
  addChange("--mass-centre-to-front", arguments.changes.massCentreToFront, "m");
  addChange("--mass-centre-height", arguments.changes.massCentreHeight, "above the ground, m");
  app.add_option("--preset", arguments.preset, "how the walls respond; contact joints get its e, μ")
      ->check(CLI::IsMember(textsOf(presetNames())))
      ->capture_default_str();
  app.add_option("--step", arguments.step, "of the simulation, s")
      ->check(numberIn(1e-4, 0.05))
      ->capture_default_str();
  app.add_option("--speed", arguments.speed, "of the drives, m/s")
      ->check(numberIn(0.1, 200.0))
      ->capture_default_str();
  app.add_option("--places", arguments.places, "on walls, at which is driven: more take longer")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--worst", arguments.worst, "places that are listed, at most")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.add_option("--pictures", arguments.pictures, "folder for a picture of each of those");
  app.add_option("--json", arguments.json, "file for the same as JSON");
  std::vector<std::string> checks = textsOf(checkNames());
  checks.emplace_back("all");
  app.add_option("--fail-on", arguments.failOn,
                 "checks that make the exit code 1 (default: up,dropped,catches,energy,through)")
      ->delimiter(',')
      ->check(CLI::IsMember(checks));
  app.footer(
      "\nChecks: up: walls and ground contradict the up axis; dropped: much that may be a wall is\n"
      "none for Bumper; catches, energy, through: what Bumper does in the drives; mesh: triangles\n"
      "without area, twice or flipped; features: steps and gaps that are too small to catch with\n"
      "Bumper; joints: what contact joints do in the drives.\n\n"
      "Exit codes: 0 healthy, 1 problems found (the last line names the checks), 2 not examined: "
      "a\n"
      "wrong command line, a file that cannot be read or has no walls, a result that cannot be\n"
      "written (the reason is on standard error).");
}

int runDoctor(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Examines what a mesh would do to a vehicle, with contact joints and with Bumper.",
               "bumper-doctor");
  addOptions(app, arguments);
  int code = healthy;
  const int parsed = runTool(app, argc, argv, [&] { code = examineFile(arguments); });
  return parsed != 0 ? parsed : code;
}

}  // namespace

int main(int argc, char** argv) {
  return runMain("bumper-doctor", runDoctor, argc, argv, notExamined);
}
