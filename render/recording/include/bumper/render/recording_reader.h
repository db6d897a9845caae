#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/render/recording.h"
#include "bumper/render/recording_limits.h"
#include "bumper/render/run_description.h"

namespace BUMPER_API bumper {

/// A part of a recording file.
struct RecordingSpan {
  double from = -std::numeric_limits<double>::infinity();  ///< s
  double to = std::numeric_limits<double>::infinity();     ///< s, ≥ from
  /// s, ≥ 0: of each vehicle, poses that follow its last one sooner are left out, but for those at
  /// the span's two ends. 0: all.
  double poseSpacing = 0.0;
};

/// Opens a recording file at any time without reading all of it: an instant is found by bisection,
/// the impacts by the file's index. A file that grows is read up to where it ended when it was
/// opened.
///
/// Throws Error, naming the file, if it cannot be read, and with the line's number if it is no
/// recording, of a newer format, damaged or beyond a limit. Only lines that are read are checked.
/// One thread at a time.
class RecordingReader {
 public:
  explicit RecordingReader(const std::filesystem::path& file, const RecordingLimits& limits = {});
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;
  RecordingReader(RecordingReader&& other) noexcept;
  RecordingReader& operator=(RecordingReader&& other) noexcept;
  ~RecordingReader();

  [[nodiscard]] const RunDescription& run() const;
  /// Names, dimensions and settings; without poses.
  [[nodiscard]] std::span<const RecordedVehicle> vehicles() const;
  /// Of the Bumper that wrote the file: "0.1.0".
  [[nodiscard]] const std::string& libraryVersion() const;

  /// Times of the first and the last pose; nothing without poses.
  [[nodiscard]] std::optional<double> firstTime() const;
  [[nodiscard]] std::optional<double> lastTime() const;

  /// Whether the file has its last line. Without it the application did not close the file, or it
  /// was truncated; what there is of it is read all the same.
  [[nodiscard]] bool isComplete() const;

  /// All vehicles, the poses of the span with the nearest lines before and after it (so that
  /// poseAt() answers all over the span), and the impacts within it. Takes memory for what it
  /// returns. Throws Error too if the span is out of its range.
  Recording read(const RecordingSpan& span = {});

  /// The impacts of the span alone, `from` and `to` included, in the order in which they were
  /// added.
  std::vector<RecordedImpact> impacts(const RecordingSpan& span = {});

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The whole of a file; `run`, if given, receives its description. Throws Error as RecordingReader
/// does.
Recording readRecording(const std::filesystem::path& file, RunDescription* run = nullptr,
                        const RecordingLimits& limits = {});

}  // namespace bumper
