#include "query_rows.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "clock.h"
#include "query_scheme.h"

namespace bumper::benchmark {

namespace {

constexpr const char* teleport = "bumper_teleport";

/// Memory of the heap that is in use, MB.
double heapInUse() {
  const struct mallinfo2 info = mallinfo2();
  return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

/// A scheme on a scene, the poses that it is asked about, and its least times.
struct Subject {
  QueryRow row;
  std::unique_ptr<QueryScheme> scheme;
  std::vector<Pose> own;  // of `stretches`, if they are not the drive's
  std::vector<Stretch> stretches;
  std::vector<double> asked;  // ns, by stretch
  std::vector<double> moved;
};

void build(const NamedScene& scene, int builds, Subject& subject) {
  const std::string name = subject.row.scheme == teleport ? "bumper" : subject.row.scheme;
  subject.row.buildTime = infinity;
  for (int i = 0; i < builds; ++i) {
    subject.scheme.reset();
    const double memory = heapInUse();
    const Timer timer;
    subject.scheme = makeQueryScheme(name, scene.scene);
    subject.row.buildTime = std::min(subject.row.buildTime, 1e-6 * timer.elapsed());
    subject.row.memory = heapInUse() - memory;
  }
}

double timeOf(QueryScheme& scheme, std::span<const Pose> poses) {
  const Timer timer;
  scheme.ask(poses);
  return timer.elapsed();
}

/// Every stretch as it is, or for a slow scheme single poses spread over the drive.
std::vector<Stretch> affordable(const Drive& drive, QueryScheme& scheme, double budget) {
  std::vector<Stretch> result;
  for (const Nearness kind : allNearness) {
    std::vector<Stretch> ofKind;
    std::ranges::copy_if(drive.stretches, std::back_inserter(ofKind),
                         [&](const Stretch& stretch) { return stretch.kind == kind; });
    if (ofKind.empty()) continue;
    const std::span<const Pose> sample = ofKind[ofKind.size() / 2].poses.first(1);
    const double once = std::min(timeOf(scheme, sample), timeOf(scheme, sample));
    const auto most = static_cast<std::size_t>(1e6 * budget / 3.0 / once);
    if (most >= drive.count(kind)) {
      result.insert(result.end(), ofKind.begin(), ofKind.end());
      continue;
    }
    const std::size_t wanted = std::max<std::size_t>(1, most);
    for (std::size_t i = 0; i < wanted; ++i) {
      std::size_t pose = i * drive.count(kind) / wanted;
      auto stretch = ofKind.begin();
      while (pose >= stretch->poses.size()) pose -= (stretch++)->poses.size();
      result.push_back({.kind = kind, .poses = stretch->poses.subspan(pose, 1)});
    }
  }
  return result;
}

std::vector<Stretch> teleports(const Drive& drive, std::vector<Pose>& poses) {
  constexpr std::size_t length = 32;
  std::vector<Stretch> result;
  poses.reserve(drive.poses.size());  // spans stay valid
  for (const Nearness kind : allNearness) {
    const std::vector<Pose> ofKind = scattered(drive, kind);
    const std::size_t begin = poses.size();
    poses.insert(poses.end(), ofKind.begin(), ofKind.end());
    for (std::size_t i = begin; i < poses.size(); i += length) {
      result.push_back(
          {.kind = kind, .poses = std::span(poses).subspan(i, std::min(length, poses.size() - i))});
    }
  }
  return result;
}

void choosePoses(const Drive& drive, double budget, Subject& subject) {
  if (subject.row.scheme == "bumper" || subject.row.scheme == "world_step") {
    subject.stretches = drive.stretches;  // steps follow each other
  } else if (subject.row.scheme == teleport) {
    subject.stretches = teleports(drive, subject.own);
  } else {
    subject.stretches = affordable(drive, *subject.scheme, budget);
  }
  subject.asked.assign(subject.stretches.size(), infinity);
  subject.moved.assign(subject.stretches.size(), infinity);
}

void repeat(Subject& subject) {
  for (std::size_t i = 0; i < subject.stretches.size(); ++i) {
    subject.asked[i] =
        std::min(subject.asked[i], timeOf(*subject.scheme, subject.stretches[i].poses));
  }
  for (std::size_t i = 0; i < subject.stretches.size(); ++i) {
    const Timer timer;
    subject.scheme->move(subject.stretches[i].poses);
    subject.moved[i] = std::min(subject.moved[i], timer.elapsed());
  }
}

/// How many of a kind's poses the scheme finds something at.
double shareFound(const Drive& drive, QueryScheme& scheme, Nearness kind) {
  constexpr std::size_t sample = 40;
  const std::vector<Pose> poses = scattered(drive, kind);
  const std::size_t count = std::min(sample, poses.size());
  const auto found = std::ranges::count_if(std::span(poses).first(count),
                                           [&](const Pose& pose) { return scheme.finds(pose); });
  return static_cast<double>(found) / static_cast<double>(count);
}

void evaluate(const Drive& drive, Subject& subject) {
  QueryRow& row = subject.row;
  std::array<double, 3> time{};
  std::array<std::size_t, 3> count{};
  for (std::size_t i = 0; i < subject.stretches.size(); ++i) {
    const auto kind = static_cast<std::size_t>(subject.stretches[i].kind);
    time.at(kind) += subject.asked[i] - subject.moved[i];
    count.at(kind) += subject.stretches[i].poses.size();
  }
  row.pathMean = 0.0;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    if (count.at(kind) == 0) continue;
    row.nanoseconds.at(kind) = time.at(kind) / static_cast<double>(count.at(kind));
    row.pathMean += row.nanoseconds.at(kind) * static_cast<double>(drive.counts.at(kind)) /
                    static_cast<double>(drive.poses.size());
  }
}

}  // namespace

QueryMeasurement measureQueries(const NamedScene& scene, const std::vector<std::string>& schemes,
                                const QueryOptions& options) {
  const Drive drive = makeDrive(scene.scene, options.poses);
  std::vector<Subject> subjects;
  for (const std::string& scheme : schemes) {
    Subject& subject = subjects.emplace_back();
    subject.row.scene = scene.name;
    subject.row.triangles = scene.scene.triangles.size();
    subject.row.scheme = scheme;
    build(scene, options.builds, subject);
    choosePoses(drive, options.budget, subject);
  }
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
    for (Subject& subject : subjects) repeat(subject);
  }
  QueryMeasurement result;
  result.drive.scene = scene.name;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    result.drive.shares.at(kind) =
        static_cast<double>(drive.counts.at(kind)) / static_cast<double>(drive.poses.size());
  }
  for (Subject& subject : subjects) {
    evaluate(drive, subject);
    subject.row.foundTouching = shareFound(drive, *subject.scheme, Nearness::touching);
    subject.row.foundFar = shareFound(drive, *subject.scheme, Nearness::far);
    result.rows.push_back(std::move(subject.row));
  }
  return result;
}

}  // namespace bumper::benchmark
