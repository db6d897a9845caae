// The paper's test: 60 mph into an L-shaped wall (Figures 4, 6, 7 and 8), by both laws.
//
//   test_rail [output folder]          default: out/test_rail

#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "impact_table.h"
#include "plots.h"
#include "results.h"
#include "test_rail_run.h"
#include "tool.h"

namespace {

using namespace bumper;
using namespace bumper::examples;
using namespace bumper::tools;

void runLaw(const std::filesystem::path& folder, Law law) {
  ResponseSettings settings;
  settings.law = law;
  const std::string name(toString(law));
  const Scene scene = testRail();
  const Recording recording = runTestRail(scene, settings);

  std::printf("\nTest rail, %zu triangles, law: %s\n", scene.triangles.size(), name.c_str());
  printImpacts(recording);
  RunDescription run{.scene = referenceTo(scene), .parameters = {{"law", name}}};
  run.scene.builtIn = "test_rail";
  writeResults(folder / name, scene, recording, "Test rail, " + name + " law, 60 mph", run);
  if (!havePlotter()) {
    std::printf("  gnuplot is not installed: no curves.png\n");
    return;
  }
  const std::filesystem::path curves = folder / name / "curves.png";
  plotCurves(settings, {}, curves);
  std::printf("  %s\n", curves.string().c_str());
}

int run(int argc, char** argv) {
  std::filesystem::path folder = "out/test_rail";
  CLI::App app("The paper's test: 60 mph into an L-shaped wall, by both laws.");
  app.add_option("folder", folder, "for tables and pictures")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  dInitODE2(0);
  runLaw(folder, Law::restitution);
  runLaw(folder, Law::energy);
  dCloseODE();
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return runMain("test_rail", run, argc, argv); }
