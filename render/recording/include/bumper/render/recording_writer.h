#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/render/recording.h"
#include "bumper/render/run_description.h"

namespace BUMPER_API bumper {

/// Writes a recording file while the run goes on: the same calls as Recording's, but nothing is
/// kept in memory (about 100 kB and, for the index, 16 bytes for each of the last 1024 impacts).
/// The format, JSON Lines, is described in render/README.md. A file that was not closed is readable
/// up to where it ends.
///
/// Lines reach the operating system when 64 kB have come together, at flush() and at close(): a
/// crash of the application loses what came since.
///
/// Every call throws Error, naming the file, if the file cannot be written (a full disk). What was
/// written before remains readable; every later call then throws too.
class RecordingWriter {
 public:
  /// Makes the file, in place of one of the same name; the folder must exist. Throws Error if that
  /// cannot be done, or if the scene's `up` is none of "", "x", "y", "z" or its scale is not finite
  /// and positive.
  explicit RecordingWriter(const std::filesystem::path& file, RunDescription run = {});

  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  RecordingWriter(RecordingWriter&&) = delete;
  RecordingWriter& operator=(RecordingWriter&&) = delete;
  /// Closes the file; only close() reports whether that succeeds.
  ~RecordingWriter();

  /// As Recording::addVehicle(). Throws Error too once there is a pose or an impact, or if the name
  /// is not UTF-8.
  std::size_t addVehicle(std::string name, const VehicleParameters& parameters,
                         RunParameters settings = {});

  /// As Recording::addPose(). Throws Error too if the time lies before that of the last pose of any
  /// vehicle. Poses of the same time that follow each other stand in one line.
  void addPose(std::size_t vehicle, const RecordedPose& pose);

  /// As Recording::addImpact(). In the names of barrier and material, bytes that are not UTF-8
  /// become U+FFFD; of the numbers that need not be finite, an infinite one becomes NaN.
  void addImpact(const ImpactEvent& event);

  /// Passes all that was added to the operating system.
  void flush();

  /// Completes the file: index and last line, and waits until it has reached the disk. Nothing can
  /// be added any more. Does nothing if the file is closed already.
  void close();

 private:
  /// Times of a vehicle's last pose and impact, s.
  struct LastTimes {
    std::optional<double> pose;
    std::optional<double> impact;
  };

  /// Writes a file under another path than the one that messages name.
  RecordingWriter(std::filesystem::path file, const std::filesystem::path& path,
                  RunDescription run);
  friend void writeRecording(const Recording& recording, const std::filesystem::path& file,
                             const RunDescription& run);

  void requireOpen() const;
  void requireWritten();
  void writeHeader();
  void endPoseLine();
  void endLine();
  void writeIndex();
  void handOver();
  [[nodiscard]] std::uint64_t offset() const { return written_ + text_.size(); }

  std::filesystem::path file_;
  std::ofstream stream_;
  RunDescription run_;
  std::vector<RecordedVehicle> vehicles_;  ///< without poses
  std::vector<LastTimes> last_;            ///< of each vehicle
  std::string text_;                       ///< whole lines, not yet written
  std::uint64_t written_ = 0;              ///< bytes
  std::string poseLine_;                   ///< without its end; empty: none begun
  double poseTime_ = -std::numeric_limits<double>::infinity();  ///< of the last pose, s
  std::vector<std::pair<double, std::uint64_t>> index_;  ///< impacts since the last index line
  std::optional<std::uint64_t> lastIndex_;               ///< where the last one with impacts is
  std::uint64_t indexedTo_ = 0;                          ///< where the last one ends
  std::uint64_t impacts_ = 0;
  bool hasHeader_ = false;
  bool failed_ = false;
};

/// Writes a whole recording. Throws Error as RecordingWriter does; what stood in the file's place
/// before is then still there.
void writeRecording(const Recording& recording, const std::filesystem::path& file,
                    const RunDescription& run = {});

}  // namespace bumper
