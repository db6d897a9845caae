#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <string>

#include "bumper/render/recording.h"
#include "bumper/render/recording_reader.h"
#include "bumper/scenes/scene.h"

namespace bumper::tools {

/// Which recording a tool reads, and where its scene is.
struct RecordedRunOptions {
  std::filesystem::path recording;
  std::filesystem::path scene;  ///< empty: the one that the recording names
  std::string up;               ///< "x", "y", "z"; empty: as in the recording
  double scale = 0.0;           ///< 0: as in the recording
  RecordingSpan span;
  RecordingLimits limits;
};

/// Adds --scene, --up, --scale, --from, --to and --most-seconds.
void addRecordedRunOptions(CLI::App& command, RecordedRunOptions& options);

struct RecordedRun {
  Recording recording;
  RunDescription description;
  Scene scene;
};

/// The recording's part between --from and --to. Warns on standard error if the file is incomplete.
Recording readRecordedPart(const RecordedRunOptions& options, RunDescription& description);

/// The recording with its scene: one of the paper's, or a mesh file, beside the recording unless
/// its path is absolute, read in a process of its own. Warns on standard error if the scene has
/// changed since. Throws Error, saying how to name the scene, if it is not found.
RecordedRun readRecordedRun(const RecordedRunOptions& options);

/// What --vehicle names. Throws Error, listing the names, if there is no such vehicle.
std::size_t vehicleIndex(const Recording& recording, const std::string& name);

}  // namespace bumper::tools
