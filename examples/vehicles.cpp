// Vehicles that hit each other: an intersection, a rear-end chain of five, a pile-up of thirty into
// a wall on the motorway, and a gate that the application moves.
//
//   vehicles [output folder] [--only NAME]          default: out/vehicles

#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bumper/scenes/scene_files.h"
#include "impact_table.h"
#include "results.h"
#include "tool.h"
#include "vehicle_scenes.h"

namespace {

using namespace bumper;
using namespace bumper::examples;
using namespace bumper::tools;

void show(const VehicleScene& scene, const std::filesystem::path& folder) {
  // Beside the recording, by which the tools find them again.
  std::filesystem::create_directories(folder);
  saveScene(scene.scene, folder / "scene.glb");
  VehicleScene loaded = scene;
  loaded.scene = loadTrustedScene(folder / "scene.glb");
  loaded.scene.name = scene.name;
  RunDescription described{.scene = referenceTo(loaded.scene)};
  described.scene.file = "scene.glb";
  VehicleMeshes meshes;
  if (scene.gate) {
    meshes["gate"] = std::make_shared<const Scene>(meshOf(*scene.gate));
    saveScene(*meshes["gate"], folder / "gate.glb");
  }

  const VehicleRun run = runVehicleScene(loaded);
  std::printf("\n%s\n", scene.title.c_str());
  printImpacts(run.recording, 12);
  std::printf(
      "  %d impacts of two vehicles; a pair's momentum changed by %.1e of the impulse at "
      "most, outlines overlapped by %.0f mm at most\n",
      run.hits, run.momentumChange, 1000.0 * run.deepestOverlap);
  writeResults(folder, loaded.scene, run.recording, scene.title, described, meshes);
}

int run(int argc, char** argv) {
  std::filesystem::path folder = "out/vehicles";
  const std::vector<VehicleScene> scenes = vehicleScenes();
  std::vector<std::string> names;
  for (const VehicleScene& scene : scenes) names.push_back(scene.name);
  std::string only;
  CLI::App app("Vehicles that hit each other, and a gate.");
  app.add_option("folder", folder, "for tables and pictures, one folder a scene")
      ->capture_default_str();
  app.add_option("--only", only, "one scene instead of all")->check(CLI::IsMember(names));
  CLI11_PARSE(app, argc, argv);
  dInitODE2(0);
  for (const VehicleScene& scene : scenes) {
    if (only.empty() || scene.name == only) show(scene, folder / scene.name);
  }
  dCloseODE();
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return runMain("vehicles", run, argc, argv); }
