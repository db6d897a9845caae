#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/render/recording.h"
#include "bumper/render/snapshot.h"

namespace BUMPER_INTERNAL bumper {
namespace drawing {

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
  bool shown = true;       ///< not: it is yet to come
};

/// The part of a recording that a picture shows.
struct RunExcerpt {
  double start = 0.0;            ///< s
  double end = 0.0;              ///< s: of the part that the picture frames
  double now = 0.0;              ///< s: up to which it is shown; the end unless a moment was given
  std::vector<DrawnPose> poses;  ///< in order of time
  std::vector<std::vector<RecordedPose>> paths;   ///< by vehicle, thinned out, up to the end
  std::vector<std::vector<RecordedPose>> trails;  ///< the same up to now
  std::vector<DrawnImpact> impacts;
  std::vector<std::string> names;  ///< of all vehicles
};

/// m: how much of a run a three-quarter view is about, on either side of the hardest impact …
constexpr double reachOfImpact = 15.0;
/// … or, without impacts, before the end.
constexpr double reachOfEnd = 30.0;

/// Impacts below this share of the hardest's are weak: they have no label and do not slow a
/// replay.
constexpr double weakShare = 0.1;
/// m/s: the hardest impact has an arrow of full length if its Δv is at least this.
constexpr double fullArrowDeltaV = 5.0;

/// The part that the options select. Throws Error if at one of their instants no vehicle was
/// recorded, or their moment lies outside what is drawn.
RunExcerpt excerptOf(const Recording& recording, const SnapshotOptions& options);

/// The hardest of the impacts, shown or yet to come; null without impacts.
const DrawnImpact* hardest(const RunExcerpt& run);

/// Whether vehicles hit each other in it.
bool hasPairs(const RunExcerpt& run);

/// "4.2 m/s", or of two vehicles "4.2 | 7.1 m/s", the one that the event is about first.
std::string deltaVText(const ImpactEvent& event);

/// The largest speed on the drawn paths, m/s.
double topSpeed(const RunExcerpt& run);

}  // namespace drawing
}  // namespace bumper
