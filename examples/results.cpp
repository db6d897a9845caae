#include "results.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include "bumper/render/csv_export.h"
#include "bumper/render/image.h"
#include "bumper/render/recording_writer.h"
#include "bumper/render/snapshot.h"

namespace bumper::examples {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

// Which end and side of the car was hit.
std::string placeOf(const Vector2& arm, const VehicleParameters& car) {
  std::string place;
  if (arm.x() > 0.5 * car.massCentreToFront) place = "front";
  if (arm.x() < -0.5 * car.massCentreToRear) place = "rear";
  const bool atSide = std::abs(arm.y()) > 0.15 * car.width;
  if (!atSide) return place.empty() ? "middle" : place;
  if (!place.empty()) place += ' ';
  return place + (arm.y() > 0.0 ? "left" : "right");
}

}  // namespace

RecordedPose poseOf(const Responder& responder, VehicleId vehicle) {
  return {.time = responder.time(),
          .position = responder.position(vehicle),
          .orientation = responder.orientation(vehicle),
          .velocity = responder.velocity(vehicle),
          .yawRate = responder.yawRate(vehicle)};
}

void record(std::span<const ImpactEvent> events, Recording& recording) {
  for (const ImpactEvent& event : events) {
    if (event.phase == EventPhase::impact) recording.addImpact(event);
  }
}

void writeResults(const std::filesystem::path& folder, const Scene& scene,
                  const Recording& recording, const std::string& title, const RunDescription& run,
                  const VehicleMeshes& meshes) {
  writeCsv(recording, folder);
  writeRecording(recording, folder / "run.jsonl", run);
  SnapshotOptions options;
  options.title = title;
  options.vehicleMeshes = meshes;
  options.view = SnapshotView::three_quarter;
  writePng(renderSnapshot(scene, recording, options), folder / "snapshot.png");
  options.view = SnapshotView::top;
  writePng(renderSnapshot(scene, recording, options), folder / "top_view.png");
  for (const char* file :
       {"run.jsonl", "snapshot.png", "top_view.png", "events.csv", "trajectory.csv"}) {
    std::printf("  %s\n", (folder / file).string().c_str());
  }
}

void printImpacts(const Recording& recording, std::size_t most) {
  if (recording.impacts().empty()) {
    std::printf("  no impact\n");
    return;
  }
  std::vector<double> changes;
  for (const RecordedImpact& each : recording.impacts()) changes.push_back(each.event().deltaV);
  std::sort(changes.begin(), changes.end(), std::greater<>());
  const double least = changes.size() > most ? changes[most - 1] : 0.0;
  if (changes.size() > most) {
    std::printf("  the %zu hardest of %zu impacts:\n", most, changes.size());
  }
  std::printf("  %3s %8s  %-12s %-14s %7s %9s %9s %10s %17s %15s\n", "#", "time s", "where", "wall",
              "angle °", "closing", "Δv m/s", "impulse Ns", "yaw rate °/s", "speed m/s");
  int number = 0;
  for (const RecordedImpact& each : recording.impacts()) {
    ++number;
    const ImpactEvent event = each.event();
    if (event.deltaV < least) continue;
    const VehicleParameters* car = nullptr;
    for (const RecordedVehicle& vehicle : recording.vehicles()) {
      if (vehicle.name == event.vehicle) car = &vehicle.parameters;
    }
    const std::string wall(event.material.empty() ? event.barrier : event.material);
    std::printf(
        "  %3d %8.3f  %-12s %-14.14s %7.1f %9.2f %9.2f %10.0f %7.0f → %7.0f %6.2f → %6.2f\n",
        number, event.time, placeOf(event.arm, *car).c_str(), wall.c_str(),
        event.angles.contactVelocity * degrees, event.approachSpeed, event.deltaV,
        std::hypot(event.impulseNormal, event.impulseTangent), event.yawRateBefore * degrees,
        event.yawRateAfter * degrees, event.speedBefore, event.speedAfter);
  }
}

}  // namespace bumper::examples
