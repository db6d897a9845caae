#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "bumper/engine_adapter/responder.h"
#include "bumper/render/recording.h"
#include "bumper/render/run_description.h"
#include "bumper/render/vehicle_meshes.h"
#include "bumper/scenes/scene.h"
#include "yaw_plane_car.h"

namespace bumper::examples {

/// A vehicle's state for a recording, at the responder's time.
RecordedPose poseOf(const Responder& responder, VehicleId vehicle);

/// Keeps the impacts of a step; contacts that only lean or scrape are left out.
void record(std::span<const ImpactEvent> events, Recording& recording);

/// Writes run.jsonl (the recording, which the tools read), events.csv, trajectory.csv, snapshot.png
/// and top_view.png into a folder, and says so.
void writeResults(const std::filesystem::path& folder, const Scene& scene,
                  const Recording& recording, const std::string& title, const RunDescription& run,
                  const VehicleMeshes& meshes = {});

}  // namespace bumper::examples
