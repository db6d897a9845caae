#include "results.h"

#include <cstdio>

#include "bumper/base/printing.h"
#include "bumper/render/csv_export.h"
#include "bumper/render/image.h"
#include "bumper/render/recording_writer.h"
#include "bumper/render/snapshot.h"

namespace bumper::examples {

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
    std::printf("  %s\n", printable((folder / file).string()).c_str());
  }
}

}  // namespace bumper::examples
