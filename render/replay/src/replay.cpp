#include "bumper/render/replay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <future>
#include <limits>
#include <sstream>
#include <string>

#include "bumper/base/output_file.h"
#include "bumper/render/snapshot_renderer.h"
#include "bumper/render/video.h"
#include "bumper/response/error.h"
#include "run_excerpt.h"

namespace bumper {

namespace {

void requireTiming(double value, double low, double high, const char* name) {
  if (value >= low && value <= high) return;
  std::ostringstream message;
  message << "ReplayTiming::" << name << " is " << value << ": it must lie in " << low << " to "
          << high;
  throw Error(message.str());
}

[[noreturn]] void failByFrames(const ReplayTiming& timing, double from, double to) {
  std::ostringstream message;
  message << "a replay from " << from << " to " << to
          << " s has more than ReplayTiming::mostFrames, " << timing.mostFrames
          << ", allows: replay a part of it, or faster";
  throw Error(message.str());
}

struct Span {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();
};

Span spanOf(const Recording& recording, const ReplayTiming& timing) {
  Span span;
  for (const RecordedVehicle& vehicle : recording.vehicles()) {
    if (vehicle.poses.empty()) continue;
    span.from = std::min(span.from, vehicle.poses.front().time);
    span.to = std::max(span.to, vehicle.poses.back().time);
  }
  const Span whole = span;
  if (timing.from) span.from = std::max(span.from, *timing.from);
  if (timing.to) span.to = std::min(span.to, *timing.to);
  if (span.from <= span.to) return span;
  if (whole.from > whole.to) throw Error("there is nothing to replay: the recording holds no pose");
  std::ostringstream message;
  message
      << "there is nothing to replay between ReplayTiming::from and to: the recording reaches from "
      << whole.from << " to " << whole.to << " s";
  throw Error(message.str());
}

std::vector<double> slowingImpacts(const Recording& recording) {
  double hardest = 0.0;
  for (const RecordedImpact& impact : recording.impacts())
    hardest = std::max(hardest, hardness(impact.event()));
  std::vector<double> times;
  for (const RecordedImpact& impact : recording.impacts()) {
    if (hardness(impact.event()) >= drawing::weakShare * hardest)
      times.push_back(impact.event().time);
  }
  std::ranges::sort(times);
  return times;
}

/// How many times slower it goes at an instant.
double slownessAt(double time, const std::vector<double>& impacts, const ReplayTiming& timing) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto next = std::ranges::lower_bound(impacts, time);
  if (next != impacts.end()) nearest = *next - time;
  if (next != impacts.begin()) nearest = std::min(nearest, time - *std::prev(next));
  if (nearest <= timing.slowReach) return timing.slowMotion;
  if (nearest >= 2.0 * timing.slowReach) return 1.0;
  const double share = 2.0 - nearest / timing.slowReach;
  return 1.0 + share * (timing.slowMotion - 1.0);
}

/// `inThread` gets each frame with its number, from 0, in the thread that drew it; `take` gets them
/// in order on the calling thread.
void drawFrames(const Scene& scene, const Recording& recording, const ReplayOptions& options,
                const std::function<void(const Image&, std::size_t)>& inThread,
                const std::function<void(const Image&)>& take) {
  if (options.renderers < 1 || options.renderers > 64) {
    throw Error("ReplayOptions::renderers is " + std::to_string(options.renderers) +
                ": it must lie in 1 to 64");
  }
  const std::vector<double> times = replayTimes(recording, options.timing);
  const std::size_t count = std::min(options.renderers, times.size());
  std::vector<SnapshotRenderer> renderers;
  for (std::size_t k = 0; k < count; ++k) renderers.emplace_back(scene);

  // One frame in work for each renderer, the oldest first.
  std::deque<std::future<Image>> inWork;
  const auto takeOldest = [&] {
    const Image frame = inWork.front().get();
    inWork.pop_front();
    take(frame);
  };
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (inWork.size() == count) takeOldest();
    inWork.push_back(std::async(std::launch::async, [&, k] {
      SnapshotOptions picture = options.picture;
      picture.moment = times[k];
      Image frame = renderers[k % count].draw(recording, picture);
      if (inThread) inThread(frame, k);
      return frame;
    }));
  }
  while (!inWork.empty()) takeOldest();
}

}  // namespace

std::vector<double> replayTimes(const Recording& recording, const ReplayTiming& timing) {
  requireTiming(timing.framesPerSecond, 1.0, 240.0, "framesPerSecond");
  requireTiming(timing.speed, 0.001, 1000.0, "speed");
  requireTiming(timing.slowMotion, 1.0, 100.0, "slowMotion");
  requireTiming(timing.slowReach, 0.0, 100.0, "slowReach");
  const Span span = spanOf(recording, timing);
  const std::vector<double> impacts = slowingImpacts(recording);
  const double step = timing.speed / timing.framesPerSecond;
  // Slow motion only makes more of them; nothing is gained by counting on.
  if (!((span.to - span.from) / step < static_cast<double>(timing.mostFrames)))
    failByFrames(timing, span.from, span.to);
  std::vector<double> times;
  for (double time = span.from; time <= span.to;) {
    if (!times.empty() && time <= times.back()) {
      std::ostringstream message;
      message << "there is no replay at " << time << " s: a frame's step is lost in the rounding";
      throw Error(message.str());
    }
    if (times.size() == timing.mostFrames) failByFrames(timing, span.from, span.to);
    times.push_back(time);
    // By the slowness half a step ahead, so that the way into slow motion is that out of it; a step
    // that would leap over the beginning of slow motion is cut into its hundredths.
    constexpr int parts = 100;
    double left = step;
    for (int part = 0; part < parts && left > 0.0; ++part) {
      const double slowness = slownessAt(time, impacts, timing);
      time += step / parts / slowness;
      left -= step / parts;
    }
  }
  return times;
}

void drawReplay(const Scene& scene, const Recording& recording, const ReplayOptions& options,
                const std::function<void(const Image&)>& take) {
  drawFrames(scene, recording, options, {}, take);
}

void writeReplayFrames(const Scene& scene, const Recording& recording,
                       const std::filesystem::path& folder, const ReplayOptions& options,
                       const ReplayProgress& progress) {
  const std::size_t all = replayTimes(recording, options.timing).size();
  makeFolder(folder);
  const auto writeFrame = [&](const Image& frame, std::size_t index) {
    std::array<char, 40> name{};
    std::snprintf(name.data(), name.size(), "frame_%05zu.png", index + 1);
    writePng(frame, folder / name.data());
  };
  std::size_t done = 0;
  drawFrames(scene, recording, options, writeFrame, [&](const Image&) {
    ++done;
    if (progress) progress(done, all);
  });
}

void writeReplayVideo(const Scene& scene, const Recording& recording,
                      const std::filesystem::path& file, const ReplayOptions& options,
                      const ReplayProgress& progress) {
  const std::size_t all = replayTimes(recording, options.timing).size();
  VideoWriter video(file, options.picture.width, options.picture.height,
                    options.timing.framesPerSecond, options.patience);
  std::size_t done = 0;
  drawReplay(scene, recording, options, [&](const Image& frame) {
    video.add(frame);
    ++done;
    if (progress) progress(done, all);
  });
  video.finish();
}

}  // namespace bumper
