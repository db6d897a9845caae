#include "bumper/render/recording_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <sstream>
#include <utility>

#include "bumper/response/error.h"
#include "line_file.h"
#include "recording_lines.h"

namespace bumper {

namespace {

/// Halving ends when so many bytes are left, which are then read through.
constexpr std::uint64_t nearEnough = std::uint64_t{64} << 10U;
/// Of the pose spacing: what the rounding of times may take away.
constexpr double spacingSlack = 1e-6;

Recording withVehicles(std::span<const RecordedVehicle> vehicles) {
  Recording recording;
  for (const RecordedVehicle& vehicle : vehicles) {
    recording.addVehicle(vehicle.name, vehicle.parameters, vehicle.settings);
  }
  return recording;
}

void check(const RecordingSpan& span) {
  if (!(span.from <= span.to)) {
    throw Error("RecordingSpan: from " + std::to_string(span.from) + " to " +
                std::to_string(span.to) + " s is no span; the second must not be less");
  }
  if (!(span.poseSpacing >= 0.0)) {
    throw Error("RecordingSpan::poseSpacing is " + std::to_string(span.poseSpacing) +
                " s: it must not be negative");
  }
}

bool contains(const RecordingSpan& span, double time) {
  return time >= span.from && time <= span.to;
}

}  // namespace

class BUMPER_HIDDEN RecordingReader::Implementation {
 public:
  Implementation(const std::filesystem::path& file, const RecordingLimits& limits)
      : file_(file), limits_(limits), lines_(file, limits.lineBytes) {
    readHeader();
    findEnd();
    findTimes();
  }

  [[nodiscard]] const HeaderLine& header() const { return header_; }
  [[nodiscard]] std::optional<double> firstTime() const { return firstTime_; }
  [[nodiscard]] std::optional<double> lastTime() const { return lastTime_; }
  [[nodiscard]] bool isComplete() const { return end_.has_value(); }

  Recording read(const RecordingSpan& span) {
    check(span);
    Recording recording = withVehicles(header_.vehicles);
    addPoses(span, recording);
    checkDuration(recording);
    addImpacts(span, recording);
    return recording;
  }

  std::vector<RecordedImpact> impacts(const RecordingSpan& span) {
    check(span);
    Recording recording = withVehicles(header_.vehicles);
    addImpacts(span, recording);
    return {recording.impacts().begin(), recording.impacts().end()};
  }

 private:
  struct PoseLineStart {
    std::uint64_t begin;
    double time;
  };

  /// Calls what reads the line that begins at `begin`; an Error gets file and line.
  template <typename Reading>
  auto naming(std::uint64_t begin, const Reading& read) {
    try {
      return read();
    } catch (const Error& error) {
      throw Error(file_.string() + ", line " + std::to_string(lines_.numberOf(begin)) + ": " +
                  error.what());
    }
  }

  void readHeader() {
    const auto line = lines_.lineAt(0);
    header_ = naming(0, [&] {
      if (!line) throw Error("the file is empty; a recording has a first line");
      return parseHeader(line->text, limits_);
    });
    naming(0, [&] { return withVehicles(header_.vehicles); });
    bodyBegin_ = line->end;
    bodyEnd_ = lines_.size();
  }

  void findEnd() {
    if (bodyEnd_ == bodyBegin_) return;
    const std::uint64_t begin = lines_.beginBefore(bodyEnd_);
    const auto last = lines_.lineAt(begin);
    if (!last->hasBreak && !isWhole(last->text)) {
      bodyEnd_ = begin;  // cut within this line
      return;
    }
    end_ = naming(begin, [&]() -> std::optional<EndLine> {
      if (startOf(last->text, limits_).kind != LineKind::end) return {};
      return parseEnd(last->text, limits_);
    });
  }

  void findTimes() {
    const auto first = firstPosesFrom(bodyBegin_, bodyEnd_);
    if (!first) return;
    firstTime_ = first->time;
    std::uint64_t begin = bodyEnd_;
    LineStart start;
    do {
      begin = lines_.beginBefore(begin);
      start = startAt(*lines_.lineAt(begin));
    } while (start.kind != LineKind::poses);
    lastTime_ = start.time;
  }

  LineStart startAt(const LineFile::Line& line) {
    return naming(line.begin, [&] { return startOf(line.text, limits_); });
  }

  /// The first line of poses that begins in [begin, end), where `begin` is a line's beginning.
  std::optional<PoseLineStart> firstPosesFrom(std::uint64_t begin, std::uint64_t end) {
    while (begin < end) {
      const auto line = lines_.lineAt(begin);
      const LineStart start = startAt(*line);
      if (start.kind == LineKind::poses) return PoseLineStart{.begin = begin, .time = start.time};
      begin = line->end;
    }
    return {};
  }

  /// Where the last line of poses before `time` begins; without one, somewhere before the first.
  std::uint64_t lastPosesBefore(double time) {
    std::uint64_t low = bodyBegin_;
    std::uint64_t high = bodyEnd_;
    while (high - low > nearEnough) {
      const std::uint64_t middle = low + (high - low) / 2;
      const auto poses = firstPosesFrom(lines_.beginFrom(middle), high);
      if (poses && poses->time < time) {
        low = poses->begin;
      } else {
        high = middle;
      }
    }
    std::uint64_t begin = low;
    while (const auto poses = firstPosesFrom(begin, bodyEnd_)) {
      if (poses->time >= time) break;
      low = poses->begin;
      begin = lines_.lineAt(low)->end;
    }
    return low;
  }

  void checkDuration(const Recording& recording) const {
    double first = std::numeric_limits<double>::infinity();
    double last = -first;
    for (const RecordedVehicle& vehicle : recording.vehicles()) {
      if (vehicle.poses.empty()) continue;
      first = std::min(first, vehicle.poses.front().time);
      last = std::max(last, vehicle.poses.back().time);
    }
    if (!(last - first > limits_.seconds)) return;
    std::ostringstream message;
    message << file_.string() << ": poses that reach over " << last - first
            << " s are more than RecordingLimits::seconds, " << limits_.seconds
            << " s, allows: read a part of them or allow more";
    throw Error(message.str());
  }

  void addPoses(const RecordingSpan& span, Recording& recording) {
    std::vector<double> due(header_.vehicles.size(), -std::numeric_limits<double>::infinity());
    std::optional<std::uint64_t> last;
    double lastTime = -std::numeric_limits<double>::infinity();
    for (std::uint64_t begin = lastPosesBefore(span.from); begin < bodyEnd_;) {
      const auto line = lines_.lineAt(begin);
      begin = line->end;
      const LineStart start = startAt(*line);
      if (start.kind != LineKind::poses) continue;
      naming(line->begin, [&] {
        if (start.time < lastTime) throw Error("its time goes back");
      });
      lastTime = start.time;
      last = line->begin;
      if (start.time > span.to) break;
      if (std::ranges::none_of(due, [&](double time) { return start.time >= time; })) continue;
      naming(line->begin, [&] {
        for (const auto& [vehicle, pose] : parsePoses(line->text, limits_)) {
          if (vehicle < due.size() && pose.time < due[vehicle]) continue;
          recording.addPose(vehicle, pose);
          due[vehicle] = pose.time + (1.0 - spacingSlack) * span.poseSpacing;
        }
      });
    }
    // The last line counts for every vehicle, due or not.
    if (!last) return;
    naming(*last, [&] {
      for (const auto& [vehicle, pose] : parsePoses(lines_.lineAt(*last)->text, limits_)) {
        const bool isThere = vehicle < due.size() && !recording.vehicles()[vehicle].poses.empty() &&
                             recording.vehicles()[vehicle].poses.back().time >= pose.time;
        if (!isThere) recording.addPose(vehicle, pose);
      }
    });
  }

  void addImpacts(const RecordingSpan& span, Recording& recording) {
    for (const IndexedImpact& indexed : impactsWithin(span)) {
      naming(indexed.second, [&] {
        const RecordedImpact impact = parseImpact(lines_.lineAt(indexed.second)->text, limits_);
        if (impact.event().time != indexed.first) throw Error("the index gives another time");
        recording.addImpact(impact.event());
      });
    }
  }

  /// Where the impacts of the span are, in the file's order.
  std::vector<IndexedImpact> impactsWithin(const RecordingSpan& span) {
    std::vector<IndexedImpact> later;
    std::optional<std::uint64_t> index = end_ ? end_->index : lastIndex();
    if (!end_) {
      for (std::uint64_t begin = index.value_or(bodyBegin_); begin < bodyEnd_;) {
        const auto line = lines_.lineAt(begin);
        const LineStart start = startAt(*line);
        if (start.kind == LineKind::impact && contains(span, start.time))
          later.emplace_back(start.time, begin);
        begin = line->end;
      }
      std::ranges::reverse(later);
    }
    std::uint64_t count = 0;
    std::uint64_t before = bodyEnd_;
    while (index) {
      const IndexLine line = indexAt(*index, before);
      std::copy_if(line.impacts.rbegin(), line.impacts.rend(), std::back_inserter(later),
                   [&](const IndexedImpact& impact) { return contains(span, impact.first); });
      count += line.impacts.size();
      before = *index;
      index = line.previous;
    }
    if (end_ && count != end_->impacts) {
      throw Error(file_.string() + ": its index has " + std::to_string(count) +
                  " impacts, its last line says " + std::to_string(end_->impacts));
    }
    std::ranges::reverse(later);
    return later;
  }

  /// The last line of kind index of a file without end.
  std::optional<std::uint64_t> lastIndex() {
    for (std::uint64_t begin = bodyEnd_; begin > bodyBegin_;) {
      begin = lines_.beginBefore(begin);
      if (startAt(*lines_.lineAt(begin)).kind == LineKind::index) return begin;
    }
    return {};
  }

  IndexLine indexAt(std::uint64_t begin, std::uint64_t before) {
    const std::string advice =
        "; was the file edited? Without its lines of kind index and end it is read as it is";
    if (begin < bodyBegin_ || begin >= before)
      throw Error(file_.string() + ": its index leads to byte " + std::to_string(begin) +
                  ", where there is none" + advice);
    return naming(begin, [&] {
      try {
        IndexLine line = parseIndex(lines_.lineAt(begin)->text, limits_);
        // Each impact once: a line that is named many times is not read many times.
        std::uint64_t least = std::max(bodyBegin_, line.previous.value_or(0));
        for (const auto& [time, place] : line.impacts) {
          if (place < least || place >= begin)
            throw Error("an impact lies outside or out of order");
          least = place + 1;
        }
        return line;
      } catch (const Error& error) {
        throw Error(std::string("no line of the index: ") + error.what() + advice);
      }
    });
  }

  std::filesystem::path file_;
  RecordingLimits limits_;
  LineFile lines_;
  HeaderLine header_;
  std::uint64_t bodyBegin_ = 0;  ///< behind the header
  std::uint64_t bodyEnd_ = 0;    ///< behind the last whole line
  std::optional<EndLine> end_;
  std::optional<double> firstTime_;
  std::optional<double> lastTime_;
};

RecordingReader::RecordingReader(const std::filesystem::path& file, const RecordingLimits& limits)
    : implementation_(std::make_unique<Implementation>(file, limits)) {}
RecordingReader::RecordingReader(RecordingReader&& other) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&& other) noexcept = default;
RecordingReader::~RecordingReader() = default;

const RunDescription& RecordingReader::run() const { return implementation_->header().run; }

std::span<const RecordedVehicle> RecordingReader::vehicles() const {
  return implementation_->header().vehicles;
}

const std::string& RecordingReader::libraryVersion() const {
  return implementation_->header().libraryVersion;
}

std::optional<double> RecordingReader::firstTime() const { return implementation_->firstTime(); }

std::optional<double> RecordingReader::lastTime() const { return implementation_->lastTime(); }

bool RecordingReader::isComplete() const { return implementation_->isComplete(); }

Recording RecordingReader::read(const RecordingSpan& span) { return implementation_->read(span); }

std::vector<RecordedImpact> RecordingReader::impacts(const RecordingSpan& span) {
  return implementation_->impacts(span);
}

Recording readRecording(const std::filesystem::path& file, RunDescription* run,
                        const RecordingLimits& limits) {
  RecordingReader reader(file, limits);
  if (run != nullptr) *run = reader.run();
  return reader.read();
}

}  // namespace bumper
