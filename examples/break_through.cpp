// What the paper has its energy method for: two cars at 60 mph break through a fence, one straight
// on and one at 30°, with the energy that the fence leaves them; the wall behind it stops them.
//
//   break_through [output folder]          default: out/break_through

#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "impact_table.h"
#include "results.h"
#include "scene_parts.h"
#include "tool.h"

namespace {

using namespace bumper;
using namespace bumper::examples;
using namespace bumper::tools;

constexpr double step = 0.005;  // s
constexpr int steps = 600;
constexpr double sixtyMph = 26.8224;  // m/s

// The smaller root of Eq. 32: the fence takes 35 % of the energy of a car that drives straight into
// it, less at smaller angles.
ResponseSettings fenceSettings() {
  ResponseSettings settings;
  settings.law = Law::energy;
  settings.energyRoot = EnergyRoot::break_through;
  settings.energyRemaining = AngleCurve::cosine(1.0, 0.65);
  return settings;
}

/// A fence along y and a wall 14 m behind it, in one scene: they differ by their material.
Scene yard() {
  Scene scene;
  scene.name = "yard";
  addPart(straightWall({20.0, -12.0}, {20.0, 45.0}, 1.0, 19, 1),
          {.name = "fence", .material = "wood", .colour = {0.72F, 0.53F, 0.30F}}, scene);
  addPart(straightWall({34.0, -12.0}, {34.0, 70.0}, 1.2, 20, 1),
          {.name = "wall", .material = "concrete", .colour = {0.72F, 0.70F, 0.66F}}, scene);
  addPart(level({-20, -25}, {50, 85}),
          {.name = "ground", .material = "gravel", .colour = {0.45F, 0.46F, 0.44F}}, scene);
  return scene;
}

Recording drive(dWorldID world, const Scene& scene) {
  constexpr double alongTheWall = std::numbers::pi / 3.0;  // 30° to the fence
  YawPlaneCar straight(world, nullptr, {}, {0.0, -4.0, 0.55}, 0.0, sixtyMph);
  YawPlaneCar slanting(world, nullptr, {}, {10.0, 4.0, 0.55}, alongTheWall, sixtyMph);
  Responder responder(world);
  responder.addBarrier(scene, {.materials = {{"wood", fenceSettings()}}});
  Recording recording;
  YawPlaneCar* const cars[] = {&straight, &slanting};
  const char* const names[] = {"straight", "slanting"};
  VehicleId vehicles[2];
  for (int i = 0; i < 2; ++i) {
    vehicles[i] = responder.addVehicle(cars[i]->body(), cars[i]->design().body, {.name = names[i]});
    recording.addPose(recording.addVehicle(names[i], cars[i]->design().body),
                      poseOf(responder, vehicles[i]));
  }
  for (int i = 0; i < steps; ++i) {
    for (YawPlaneCar* car : cars) car->addTyreForces();
    record(responder.step(step), recording);
    dWorldQuickStep(world, step);
    for (std::size_t k = 0; k < 2; ++k) {
      recording.addPose(k, poseOf(responder, vehicles[k]));
    }
  }
  return recording;
}

int run(int argc, char** argv) {
  std::filesystem::path folder = "out/break_through";
  CLI::App app("Two cars break through a fence; the wall behind it stops them.");
  app.add_option("folder", folder, "for tables and pictures")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  // In a file beside the recording, by which the tools find it again.
  std::filesystem::create_directories(folder);
  saveScene(yard(), folder / "yard.glb");
  const Scene scene = loadTrustedScene(folder / "yard.glb");
  RunDescription described{.scene = referenceTo(scene)};
  described.scene.file = "yard.glb";

  dInitODE2(0);
  const dWorldID world = dWorldCreate();  // without gravity: the cars stay in their yaw plane
  const Recording recording = drive(world, scene);
  dWorldDestroy(world);
  dCloseODE();

  std::printf("Break-through, %zu triangles\n", scene.triangles.size());
  printImpacts(recording);
  for (const RecordedImpact& impact : recording.impacts()) {
    const ImpactEvent event = impact.event();
    if (event.material != "wood") continue;
    std::printf("  %.8s: %.4f of the energy asked, %.4f left\n", event.vehicle.data(),
                event.energyAsked, event.energyRatio);
  }
  writeResults(folder, scene, recording, "Through a fence at 60 mph", described);
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return runMain("break_through", run, argc, argv); }
