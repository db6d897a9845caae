#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/render/image.h"
#include "bumper/render/recording.h"
#include "bumper/render/snapshot.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// How a replay's time maps to the recording's.
struct ReplayTiming {
  double framesPerSecond = 30.0;  ///< 1 to 240
  double speed = 1.0;             ///< seconds of the run in one of the replay, 0.001 to 1000
  double slowMotion = 4.0;        ///< how many times slower around impacts, 1 (not at all) to 100
  double slowReach = 0.25;        ///< s of the run before and after an impact, 0 to 100
  std::optional<double> from{};   ///< s; nothing: the first pose of all
  std::optional<double> to{};     ///< s; nothing: the last pose of all
  /// More are an Error: a few poses far apart in time would make a film without end. Two hours at
  /// 30 a second.
  std::size_t mostFrames = 216000;
};

/// How a replay looks and what it costs.
struct ReplayOptions {
  ReplayTiming timing;
  /// Of every frame; `moment` is set by the replay. 960 × 540 pixels: a frame takes about 45 ms of
  /// processor time with its encoding, a half more at 1280 × 720. A top view shows the whole run
  /// all the time.
  SnapshotOptions picture = [] {
    SnapshotOptions chasing;
    chasing.view = SnapshotView::chase;
    chasing.width = 960;
    chasing.height = 540;
    return chasing;
  }();
  /// Frames that are drawn in parallel, 1 to 64, each by a renderer of its own. More than there are
  /// processors is no gain.
  std::size_t renderers = 2;
  double patience = 120.0;  ///< s: that of VideoWriter
};

/// Called after each frame, on the thread that called: frames done, frames in all.
using ReplayProgress = std::function<void(std::size_t, std::size_t)>;

/// The instants that the frames show, s, in ascending order, from the first to about the last;
/// never empty. Slow motion begins and ends gradually, over slowReach. Impacts below a tenth of the
/// hardest impact's Δv do not slow it. Throws Error if a value lies outside its range, there is no
/// pose between `from` and `to`, there would be more than `mostFrames`, or the times are so large
/// that a frame's step is lost in their rounding.
std::vector<double> replayTimes(const Recording& recording, const ReplayTiming& timing = {});

/// Draws the frames in several threads and hands them over in order, on the thread that called.
/// Throws Error as replayTimes() and renderSnapshot() do; what `take` throws ends it too.
void drawReplay(const Scene& scene, const Recording& recording, const ReplayOptions& options,
                const std::function<void(const Image&)>& take);

/// Writes frame_00001.png, frame_00002.png, … into a folder, which is made if it does not exist;
/// files of these names are replaced, others left. Throws Error as drawReplay() does or, naming the
/// file, if one cannot be written.
void writeReplayFrames(const Scene& scene, const Recording& recording,
                       const std::filesystem::path& folder, const ReplayOptions& options = {},
                       const ReplayProgress& progress = {});

/// Makes a film; kinds of file and the program that it takes are those of VideoWriter. Frames are
/// drawn while others are encoded. Throws Error as drawReplay() and VideoWriter do; nothing
/// half-done then remains.
void writeReplayVideo(const Scene& scene, const Recording& recording,
                      const std::filesystem::path& file, const ReplayOptions& options = {},
                      const ReplayProgress& progress = {});

}  // namespace bumper
