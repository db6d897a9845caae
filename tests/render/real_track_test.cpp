#include <gtest/gtest.h>

#include <filesystem>

#include "bumper/render/image_compare.h"
#include "bumper/render/snapshot_renderer.h"
#include "bumper/scenes/scene_files.h"
#include "synthetic_run.h"

namespace bumper {
namespace {

/// The share of pixels in which Mesa's two libraries may differ.
constexpr double backendTolerance = 0.001;

TEST(RealTrack, isDrawnAlikeByBothBackends) {
  const std::filesystem::path file =
      std::filesystem::path(TRACKS_FOLDER) / "road/aalborg/aalborg.acc";
  if (builtBackends().size() < 2) GTEST_SKIP() << "bumper was built with one backend";
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << file << " is missing: examples/fetch_tracks.sh puts it there";
  const Scene track = loadTrustedScene(file, {.up = UpAxis::y});
  SnapshotRenderer osmesa(track, OffscreenBackend::osmesa);
  SnapshotRenderer egl(track, OffscreenBackend::egl);
  const Eigen::Vector3d place = track.corner(track.triangles.front(), 0);
  const Recording run = testing::standingVehicle(place.head<2>(), 0.0);
  for (const SnapshotView view : {SnapshotView::top, SnapshotView::chase, SnapshotView::orbit}) {
    SnapshotOptions options;
    options.view = view;
    options.orbit.distance = 300.0;
    const auto comparison = compareImages(osmesa.draw(run, options), egl.draw(run, options));
    EXPECT_LE(comparison.differingShare, backendTolerance) << static_cast<int>(view);
  }
}

}  // namespace
}  // namespace bumper
