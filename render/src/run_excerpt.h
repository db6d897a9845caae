#pragma once

#include <cstddef>
#include <vector>

#include "bumper/render/recording.h"
#include "bumper/render/snapshot.h"

namespace bumper::drawing {

/// A vehicle at an instant that is drawn.
struct DrawnPose {
  std::size_t vehicle = 0;
  RecordedPose pose;
  bool last = false;  ///< solid; the others are ghosts
};

/// An impact that is drawn.
struct DrawnImpact {
  std::size_t number = 0;  ///< from 1, in the recording's order
  ImpactEvent event;       ///< its names live as long as the recording
  bool labelled = false;   ///< has a number and an arrow; the others are small dots
};

/// The part of a recording that a picture shows.
struct RunExcerpt {
  double start = 0.0;                            ///< s
  double end = 0.0;                              ///< s
  std::vector<DrawnPose> poses;                  ///< in order of time
  std::vector<std::vector<RecordedPose>> paths;  ///< by vehicle, thinned out
  std::vector<DrawnImpact> impacts;
};

/// m: how much of a run a three-quarter view is about, on either side of the hardest impact …
constexpr double reachOfImpact = 15.0;
/// … or, without impacts, before the end.
constexpr double reachOfEnd = 30.0;

/// What the options ask for. Throws Error if at one of their instants no vehicle was recorded.
RunExcerpt excerptOf(const Recording& recording, const SnapshotOptions& options);

/// The hardest of the drawn impacts; null without impacts.
const DrawnImpact* hardest(const RunExcerpt& run);

/// The largest speed on the drawn paths, m/s.
double topSpeed(const RunExcerpt& run);

}  // namespace bumper::drawing
