#include "bumper/render/recording_writer.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "bumper/base/output_file.h"
#include "bumper/response/error.h"
#include "recording_checks.h"
#include "recording_lines.h"

namespace bumper {

namespace {

constexpr std::size_t handOverSize = std::size_t{64} << 10U;  ///< bytes
/// A reader of a file without end searches this far for the last index, bytes.
constexpr std::uint64_t indexDistance = std::uint64_t{4} << 20U;
constexpr std::size_t indexLength = 1024;  ///< impacts in a line

/// Calls what may throw Error and puts the file's name before its message.
template <typename Action>
auto naming(const std::filesystem::path& file, const Action& action) {
  try {
    return action();
  } catch (const Error& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

void check(const SceneReference& scene) {
  if (!std::isfinite(scene.scale) || scene.scale <= 0.0) {
    throw Error("SceneReference::scale is " + std::to_string(scene.scale) +
                ": it must be finite and positive");
  }
  if (!scene.up.empty() && scene.up != "x" && scene.up != "y" && scene.up != "z")
    throw Error("SceneReference::up is \"" + scene.up + R"(": allowed are "x", "y", "z" and "")");
}

/// Adds poses and impacts in order of time; impacts stay in the recording's own order.
void addInOrder(const Recording& recording, RecordingWriter& writer) {
  const auto vehicles = recording.vehicles();
  const auto impacts = recording.impacts();
  std::vector<std::size_t> next(vehicles.size(), 0);
  std::size_t impact = 0;
  while (true) {
    double time = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < vehicles.size(); ++k) {
      const auto& poses = vehicles[k].poses;
      if (next[k] < poses.size()) time = std::min(time, poses[next[k]].time);
    }
    for (; impact < impacts.size() && impacts[impact].event().time < time; ++impact) {
      writer.addImpact(impacts[impact].event());
    }
    if (!std::isfinite(time)) return;
    for (std::size_t k = 0; k < vehicles.size(); ++k) {
      const auto& poses = vehicles[k].poses;
      for (; next[k] < poses.size() && poses[next[k]].time == time; ++next[k]) {
        writer.addPose(k, poses[next[k]]);
      }
    }
  }
}

}  // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& file, RunDescription run)
    : RecordingWriter(file, file, std::move(run)) {}

RecordingWriter::RecordingWriter(std::filesystem::path file, const std::filesystem::path& path,
                                 RunDescription run)
    : file_(std::move(file)), run_(std::move(run)) {
  naming(file_, [&] { check(run_.scene); });
  stream_.open(path, std::ios::binary | std::ios::trunc);
  if (!stream_) throw Error("cannot write " + file_.string() + ": its folder must be writable");
}

RecordingWriter::~RecordingWriter() {
  try {
    if (!failed_) close();
  } catch (const std::exception&) {
    failed_ = true;  // close() reports it
  }
}

std::size_t RecordingWriter::addVehicle(std::string name, const VehicleParameters& parameters,
                                        RunParameters settings) {
  return naming(file_, [&] {
    requireOpen();
    if (hasHeader_) {
      throw Error("the vehicle \"" + name +
                  "\" comes too late: all must be added before the first pose or impact");
    }
    requireUtf8(name);
    vehicles_.push_back(
        checkedVehicle(std::move(name), parameters, std::move(settings), vehicles_));
    last_.emplace_back();
    return vehicles_.size() - 1;
  });
}

void RecordingWriter::addPose(std::size_t vehicle, const RecordedPose& pose) {
  naming(file_, [&] {
    requireOpen();
    checkIndex(vehicle, vehicles_.size());
    const RecordedPose kept = checkedPose(pose, vehicles_[vehicle].name, last_[vehicle].pose);
    if (pose.time < poseTime_) {
      throw Error("the pose of \"" + vehicles_[vehicle].name + "\" at " +
                  std::to_string(pose.time) + " s comes after one at " + std::to_string(poseTime_) +
                  " s: poses must be added in order of time");
    }
    if (!poseLine_.empty() && pose.time > poseTime_) endPoseLine();
    const bool first = poseLine_.empty();
    if (first) {
      writeHeader();
      appendPoseLineBegin(poseLine_, pose.time);
    }
    appendPose(poseLine_, vehicle, kept, first);
    poseTime_ = pose.time;
    last_[vehicle].pose = pose.time;
  });
}

void RecordingWriter::addImpact(const ImpactEvent& event) {
  naming(file_, [&] {
    requireOpen();
    const std::size_t vehicle = vehicleOf(event, vehicles_);
    checkImpact(event, last_[vehicle].impact);
    writeHeader();
    endPoseLine();
    index_.emplace_back(event.time, offset());
    appendImpact(text_, event);
    last_[vehicle].impact = event.time;
    ++impacts_;
    endLine();
  });
}

void RecordingWriter::flush() {
  naming(file_, [&] {
    requireOpen();
    writeHeader();
    endPoseLine();
    handOver();
    stream_.flush();
    requireWritten();
  });
}

void RecordingWriter::close() {
  if (!stream_.is_open()) return;
  naming(file_, [&] {
    requireOpen();
    writeHeader();
    endPoseLine();
    if (!index_.empty()) writeIndex();
    appendEnd(text_, lastIndex_, impacts_);
    handOver();
    stream_.close();
    requireWritten();
  });
  syncToDisk(file_);
}

void RecordingWriter::requireOpen() const {
  if (failed_) throw Error("writing has failed before");
  if (!stream_.is_open()) throw Error("the file is closed already");
}

void RecordingWriter::requireWritten() {
  if (stream_) return;
  failed_ = true;
  throw Error("cannot write on: the disk must have room");
}

void RecordingWriter::writeHeader() {
  if (hasHeader_) return;
  appendHeader(text_, run_, vehicles_);
  hasHeader_ = true;
}

void RecordingWriter::endPoseLine() {
  if (poseLine_.empty()) return;
  text_ += poseLine_;
  text_ += poseLineEnd;
  poseLine_.clear();
  endLine();
}

void RecordingWriter::endLine() {
  if (index_.size() >= indexLength || offset() - indexedTo_ >= indexDistance) writeIndex();
  if (text_.size() >= handOverSize) handOver();
}

void RecordingWriter::writeIndex() {
  const std::uint64_t begin = offset();
  appendIndex(text_, lastIndex_, index_);
  if (!index_.empty()) lastIndex_ = begin;
  index_.clear();
  indexedTo_ = offset();
}

void RecordingWriter::handOver() {
  stream_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
  requireWritten();
  written_ += text_.size();
  text_.clear();
}

void writeRecording(const Recording& recording, const std::filesystem::path& file,
                    const RunDescription& run) {
  OutputFile output(file);
  RecordingWriter writer(file, output.path(), run);
  for (const RecordedVehicle& vehicle : recording.vehicles()) {
    writer.addVehicle(vehicle.name, vehicle.parameters, vehicle.settings);
  }
  addInOrder(recording, writer);
  writer.close();
  output.moveToPlace();
}

}  // namespace bumper
