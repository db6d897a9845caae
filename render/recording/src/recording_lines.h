#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bumper/render/recording.h"
#include "bumper/render/recording_limits.h"
#include "bumper/render/run_description.h"

namespace bumper {

// The lines of a recording file, render/README.md: what they look like stands here alone.

/// An impact's time, s, and the byte at which its line begins.
using IndexedImpact = std::pair<double, std::uint64_t>;

// Writing. What is appended ends with a line break unless stated otherwise.

/// Throws Error if the description does not fit into a file.
void appendHeader(std::string& text, const RunDescription& run,
                  std::span<const RecordedVehicle> vehicles);
/// Without end: further poses may be appended, then poseLineEnd.
void appendPoseLineBegin(std::string& text, double time);
void appendPose(std::string& text, std::size_t vehicle, const RecordedPose& pose, bool first);
inline constexpr std::string_view poseLineEnd = "]}\n";
void appendImpact(std::string& text, const ImpactEvent& event);
void appendIndex(std::string& text, std::optional<std::uint64_t> previous,
                 std::span<const IndexedImpact> impacts);
void appendEnd(std::string& text, std::optional<std::uint64_t> index, std::uint64_t impacts);

/// Throws Error unless the name is UTF-8.
void requireUtf8(const std::string& name);

// Reading. All throw Error if the line is not what it should be or beyond a limit; the caller adds
// its number.

enum class LineKind { poses, impact, index, end };
struct LineStart {
  LineKind kind = LineKind::poses;
  double time = 0.0;  ///< s; 0 where the line has none
};
/// Looks no further than it must: a line of poses as the writer makes it is not parsed.
LineStart startOf(std::string_view line, const RecordingLimits& limits);
bool isWhole(std::string_view line);  ///< a JSON object from its first to its last byte

struct HeaderLine {
  RunDescription run;
  std::vector<RecordedVehicle> vehicles;
  std::string libraryVersion;
};
HeaderLine parseHeader(std::string_view line, const RecordingLimits& limits);

/// The poses of a line, each with its vehicle's index.
using PoseLine = std::vector<std::pair<std::size_t, RecordedPose>>;
PoseLine parsePoses(std::string_view line, const RecordingLimits& limits);

RecordedImpact parseImpact(std::string_view line, const RecordingLimits& limits);

struct IndexLine {
  std::optional<std::uint64_t> previous;
  std::vector<IndexedImpact> impacts;
};
IndexLine parseIndex(std::string_view line, const RecordingLimits& limits);

struct EndLine {
  std::optional<std::uint64_t> index;
  std::uint64_t impacts = 0;
};
EndLine parseEnd(std::string_view line, const RecordingLimits& limits);

}  // namespace bumper
