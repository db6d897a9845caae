// A lap of the course that stands for Watkins Glen (Figure 9), swerving into the walls on the way.
//
//   course [output folder]          default: out/course

#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "impact_table.h"
#include "path_follower.h"
#include "results.h"
#include "tool.h"

namespace {

using namespace bumper;
using namespace bumper::examples;
using namespace bumper::tools;

constexpr double step = 0.005;            // s
constexpr double speed = 28.0;            // m/s
constexpr double longestLap = 260.0;      // s
constexpr std::size_t linePoints = 1800;  // 3 m apart
constexpr std::size_t swerveEvery = 120;  // points, to the left and right in turn
constexpr std::size_t swerveReach = 36;   // points out, and as many back
constexpr double swerveWidth = 6.4;       // m: with half the car's width 0.3 m beyond the wall
constexpr double straightCosine = 0.97;   // of the bend over a whole swerve, which needs a straight

// The centre line, but on straights now and then out to a wall and back.
std::vector<Eigen::Vector2d> swervingLine() {
  const std::vector<Eigen::Vector2d> centre = courseCentreLine(linePoints);
  const auto ahead = [&](std::size_t i) {
    return Eigen::Vector2d((centre[(i + 1) % linePoints] - centre[i % linePoints]).normalized());
  };
  std::vector<Eigen::Vector2d> line = centre;
  double side = 1.0;
  for (std::size_t first = 0; first < linePoints; first += swerveEvery) {
    if (ahead(first).dot(ahead(first + 2 * swerveReach)) < straightCosine) continue;
    for (std::size_t i = 0; i <= 2 * swerveReach; ++i) {
      const Eigen::Vector2d forward = ahead(first + i);
      const double out = 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) /
                                              static_cast<double>(swerveReach));
      line[(first + i) % linePoints] +=
          side * swerveWidth * out * Eigen::Vector2d(-forward.y(), forward.x());
    }
    side = -side;
  }
  return line;
}

Recording driveLap(dWorldID world, const Scene& scene) {
  YawPlaneCar car(world, nullptr, {}, {0.0, 0.0, 0.55}, 0.0, speed);
  PathFollower driver(swervingLine(), speed);
  Responder responder(world);
  responder.addBarrier(scene);
  const VehicleId vehicle = responder.addVehicle(car.body(), car.design().body, {.name = "car"});

  Recording recording;
  const std::size_t recorded = recording.addVehicle("car", car.design().body);
  recording.addPose(recorded, poseOf(responder, vehicle));
  while (driver.laps() == 0 && responder.time() < longestLap) {
    driver.control(car);
    car.addTyreForces();
    record(responder.step(step), recording);
    dWorldQuickStep(world, step);
    recording.addPose(recorded, poseOf(responder, vehicle));
  }
  return recording;
}

int run(int argc, char** argv) {
  std::filesystem::path folder = "out/course";
  CLI::App app("A lap of the course that stands for Watkins Glen, swerving into the walls.");
  app.add_option("folder", folder, "for tables and pictures")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  dInitODE2(0);
  const dWorldID world = dWorldCreate();  // without gravity: the car stays in its yaw plane
  const Scene scene = course();
  const Recording recording = driveLap(world, scene);
  dWorldDestroy(world);
  dCloseODE();

  std::printf("Course, %zu triangles: %.1f s for the lap, %zu impacts\n", scene.triangles.size(),
              recording.vehicles()[0].poses.back().time, recording.impacts().size());
  printImpacts(recording);
  RunDescription run{.scene = referenceTo(scene)};
  run.scene.builtIn = "course";
  writeResults(folder, scene, recording, "Course, one lap", run);
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return runMain("course", run, argc, argv); }
