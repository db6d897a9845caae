#include "run_excerpt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "bumper/response/error.h"
#include "text.h"
#include "vehicle_shape.h"

namespace bumper::drawing {

namespace {

constexpr std::size_t maxLabelled = 8;
/// Ghosts closer than this many vehicle lengths hide each other …
constexpr double crowded = 0.85;
/// … and closer than this they look like one.
constexpr double merged = 0.1;
constexpr double evenSpacing =
    2.2;  ///< vehicle lengths between ghosts without a reason of their own
constexpr double maxEvenGhosts = 8.0;

/// The longer way across the outline: a gate is wide.
double length(const RecordedVehicle& vehicle) {
  const VehicleParameters& size = vehicle.parameters;
  return std::max(size.massCentreToFront + size.massCentreToRear, size.width);
}

/// How far the vehicle that moves most is between two instants, in vehicle lengths.
double separation(const Recording& recording, double first, double second) {
  double most = 0.0;
  for (const RecordedVehicle& vehicle : recording.vehicles()) {
    const auto a = poseAt(vehicle, first);
    const auto b = poseAt(vehicle, second);
    if (a && b) most = std::max(most, (a->position - b->position).norm() / length(vehicle));
  }
  return most;
}

double travelled(const std::vector<RecordedPose>& poses) {
  double sum = 0.0;
  for (std::size_t k = 1; k < poses.size(); ++k)
    sum += (poses[k].position - poses[k - 1].position).norm();
  return sum;
}

/// Instants between the given ones, so that ghosts of the vehicle that goes farthest stand at even
/// distances where there is room.
void fillGaps(const Recording& recording, std::vector<double>& instants) {
  const auto vehicles = recording.vehicles();
  const auto farthest = std::ranges::max_element(
      vehicles, {}, [](const RecordedVehicle& vehicle) { return travelled(vehicle.poses); });
  const auto& poses = farthest->poses;
  const double spacing =
      std::max(evenSpacing * length(*farthest), travelled(poses) / maxEvenGhosts);
  std::vector<double> between;
  std::size_t next = 1;
  for (std::size_t gap = 1; gap < instants.size(); ++gap) {
    std::vector<RecordedPose> part;
    while (next < poses.size() && poses[next].time <= instants[gap - 1]) ++next;
    for (std::size_t k = next; k < poses.size() && poses[k].time <= instants[gap]; ++k)
      part.push_back(poses[k]);
    const double distance = travelled(part);
    const double count = std::floor(distance / spacing + 0.25);
    double passed = 0.0;
    double due = 1.0;
    for (std::size_t k = 1; k < part.size() && due < count; ++k) {
      passed += (part[k].position - part[k - 1].position).norm();
      if (passed < due * distance / count) continue;
      between.push_back(part[k].time);
      due += 1.0;
    }
  }
  instants.insert(instants.end(), between.begin(), between.end());
  std::ranges::sort(instants);
}

struct Span {
  double start = std::numeric_limits<double>::infinity();
  double end = -std::numeric_limits<double>::infinity();
};

Span wholeRun(const Recording& recording) {
  Span span;
  for (const RecordedVehicle& vehicle : recording.vehicles()) {
    if (vehicle.poses.empty()) continue;
    span.start = std::min(span.start, vehicle.poses.front().time);
    span.end = std::max(span.end, vehicle.poses.back().time);
  }
  return span;
}

/// When a vehicle is, without leaving, near the place where it is at an instant.
Span timeNear(const RecordedVehicle& vehicle, const Eigen::Vector3d& place, double time,
              double reach) {
  const auto& poses = vehicle.poses;
  Span span{time, time};
  const auto isNear = [&](const RecordedPose& pose) {
    return (pose.position - place).norm() <= reach;
  };
  const auto now = std::ranges::lower_bound(poses, time, {}, &RecordedPose::time);
  for (auto pose = now; pose != poses.end() && isNear(*pose); ++pose) span.end = pose->time;
  for (auto pose = now; pose != poses.begin() && isNear(*std::prev(pose)); --pose)
    span.start = std::prev(pose)->time;
  return span;
}

/// While all that take part in an impact are near its place.
Span timeOf(const ImpactEvent& event, const Recording& recording) {
  constexpr double ever = std::numeric_limits<double>::infinity();
  Span both{-ever, ever};
  for (const RecordedVehicle& vehicle : recording.vehicles()) {
    if (vehicle.poses.empty() || !asSeenBy(vehicle.name, event)) continue;
    const Span one = timeNear(vehicle, event.contact, event.time, reachOfImpact);
    both = {std::max(both.start, one.start), std::min(both.end, one.end)};
  }
  return both.start > -ever ? both : Span{};
}

/// The time that a three-quarter view is about.
Span timeOfInterest(const Recording& recording) {
  const auto impacts = recording.impacts();
  const auto worst = std::ranges::max_element(
      impacts, {}, [](const RecordedImpact& impact) { return hardness(impact.event()); });
  if (worst != impacts.end()) return timeOf(worst->event(), recording);
  Span span;
  for (const RecordedVehicle& vehicle : recording.vehicles()) {
    if (vehicle.poses.empty()) continue;
    const RecordedPose& last = vehicle.poses.back();
    const Span end = timeNear(vehicle, last.position, last.time, reachOfEnd);
    span = {std::min(span.start, end.start), std::max(span.end, end.end)};
  }
  return span;
}

/// The end and the hardest impact, which are shown even if they overlap, the start, the other
/// impacts, the harder first, and what fills the gaps.
std::vector<double> chosenInstants(const Recording& recording, const Span& span) {
  std::vector<double> instants = {span.end};
  // Ghosts of a crowd hide each other, and whose they are.
  if (recording.vehicles().size() > paintCount) return instants;
  const auto add = [&](double time, double apart) {
    const bool free = std::ranges::none_of(
        instants, [&](double other) { return separation(recording, time, other) < apart; });
    if (free && time >= span.start && time <= span.end) instants.push_back(time);
  };
  std::vector<ImpactEvent> impacts;
  impacts.reserve(recording.impacts().size());
  for (const RecordedImpact& impact : recording.impacts()) impacts.push_back(impact.event());
  std::ranges::stable_sort(impacts, std::ranges::greater{}, hardness);
  if (!impacts.empty()) add(impacts.front().time, merged);
  add(span.start, crowded);
  for (const ImpactEvent& impact : impacts) {
    if (instants.size() >= 2 + maxLabelled) break;
    add(impact.time, crowded);
  }
  std::ranges::sort(instants);
  fillGaps(recording, instants);
  return instants;
}

/// When a vehicle is drawn, of the instants that were chosen for all: once where it stays while
/// others move on. The end and the hardest impact come first, as among the instants.
std::vector<double> uncrowded(const RecordedVehicle& vehicle, const Recording& recording,
                              const std::vector<double>& instants) {
  std::vector<RecordedPose> kept;
  const auto add = [&](double time, double apart) {
    const auto pose = poseAt(vehicle, time);
    const bool free = pose && std::ranges::none_of(kept, [&](const RecordedPose& other) {
                        return (pose->position - other.position).norm() < apart * length(vehicle);
                      });
    if (free) kept.push_back(*pose);
  };
  const auto last = std::find_if(instants.rbegin(), instants.rend(),
                                 [&](double time) { return poseAt(vehicle, time).has_value(); });
  if (last != instants.rend()) add(*last, merged);
  const auto impacts = recording.impacts();
  const auto worst = std::ranges::max_element(
      impacts, {}, [](const RecordedImpact& impact) { return hardness(impact.event()); });
  if (worst != impacts.end() && std::ranges::binary_search(instants, worst->event().time))
    add(worst->event().time, merged);
  for (const double time : instants) add(time, crowded);
  std::vector<double> times;
  times.reserve(kept.size());
  for (const RecordedPose& pose : kept) times.push_back(pose.time);
  std::ranges::sort(times);
  return times;
}

void checkInstants(const Recording& recording, const std::vector<double>& instants) {
  for (const double time : instants) {
    const bool recorded = std::ranges::any_of(
        recording.vehicles(),
        [&](const RecordedVehicle& vehicle) { return poseAt(vehicle, time).has_value(); });
    if (recorded) continue;
    std::ostringstream message;
    message << "SnapshotOptions::instants holds " << time
            << " s: a vehicle must have been recorded at every instant";
    throw Error(message.str());
  }
}

[[noreturn]] void throwMoment(double time, const std::string& reason) {
  std::ostringstream message;
  message << "SnapshotOptions::moment is " << time << " s: " << reason;
  throw Error(message.str());
}

/// The poses from start to end, at least a hundredth of a vehicle length and a 3000th of the way
/// apart.
std::vector<RecordedPose> thinnedPath(const RecordedVehicle& vehicle, double start, double end) {
  if (vehicle.poses.empty()) return {};
  const auto first = poseAt(vehicle, std::max(start, vehicle.poses.front().time));
  const auto last = poseAt(vehicle, std::min(end, vehicle.poses.back().time));
  if (!first || !last || last->time < first->time) return {};
  const double spacing = std::max(0.01 * length(vehicle), travelled(vehicle.poses) / 3000.0);
  std::vector<RecordedPose> path = {*first};
  for (const RecordedPose& pose : vehicle.poses) {
    if (pose.time <= first->time || pose.time >= last->time) continue;
    if ((pose.position - path.back().position).norm() >= spacing) path.push_back(pose);
  }
  path.push_back(*last);
  return path;
}

/// The part of a path up to a time, with the vehicle's own place at its end.
std::vector<RecordedPose> upTo(double time, const std::vector<RecordedPose>& path,
                               const RecordedVehicle& vehicle) {
  const auto after = std::ranges::upper_bound(path, time, {}, &RecordedPose::time);
  std::vector<RecordedPose> part(path.begin(), after);
  if (after == path.begin() || after == path.end()) return part;
  if (const auto here = poseAt(vehicle, time)) part.push_back(*here);
  return part;
}

void labelHardest(std::vector<DrawnImpact>& impacts) {
  std::vector<DrawnImpact*> order;
  order.reserve(impacts.size());
  for (DrawnImpact& impact : impacts) order.push_back(&impact);
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [](const DrawnImpact* impact) { return hardness(impact->event); });
  if (order.size() > maxLabelled) order.resize(maxLabelled);
  for (DrawnImpact* impact : order)
    impact->labelled = hardness(impact->event) >= weakShare * hardness(order.front()->event);
}

}  // namespace

RunExcerpt excerptOf(const Recording& recording, const SnapshotOptions& options) {
  checkInstants(recording, options.instants);
  RunExcerpt run;
  const Span whole = wholeRun(recording);
  if (whole.start > whole.end) {
    if (options.moment) throwMoment(*options.moment, "nothing was recorded");
    return run;
  }
  std::vector<double> instants = options.instants;
  const bool chosen = instants.empty() && !options.moment;
  std::ranges::sort(instants);
  run.start = instants.empty() ? whole.start : instants.front();
  run.end = instants.empty() ? whole.end : instants.back();
  run.now = options.moment.value_or(run.end);
  if (!(run.now >= run.start && run.now <= run.end)) {
    std::ostringstream range;
    range << "it must lie in " << run.start << " s to " << run.end << " s";
    throwMoment(run.now, range.str());
  }
  if (options.moment) {
    std::erase_if(instants, [&](double time) { return time >= run.now; });
    instants.push_back(run.now);
  } else if (chosen) {
    const Span shown =
        options.view == SnapshotView::three_quarter ? timeOfInterest(recording) : whole;
    instants = chosenInstants(recording, shown);
  }

  const auto vehicles = recording.vehicles();
  for (std::size_t v = 0; v < vehicles.size(); ++v) {
    std::size_t drawn = run.poses.size();
    for (const double time : chosen ? uncrowded(vehicles[v], recording, instants) : instants) {
      if (const auto pose = poseAt(vehicles[v], time)) run.poses.push_back({v, *pose, false});
    }
    // In a replay a vehicle is solid while it is recorded, and leaves its ghosts behind after.
    if (run.poses.size() > drawn)
      run.poses.back().last = !options.moment || run.poses.back().pose.time == run.now;
    run.names.push_back(vehicles[v].name);
    run.paths.push_back(thinnedPath(vehicles[v], run.start, run.end));
    run.trails.push_back(upTo(run.now, run.paths.back(), vehicles[v]));
  }
  std::ranges::stable_sort(run.poses, {}, [](const DrawnPose& drawn) { return drawn.pose.time; });

  const auto impacts = recording.impacts();
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    const ImpactEvent event = impacts[k].event();
    if (options.instants.empty() || (event.time >= run.start && event.time <= run.end))
      run.impacts.push_back({k + 1, event, false, !options.moment || event.time <= run.now});
  }
  labelHardest(run.impacts);
  return run;
}

const DrawnImpact* hardest(const RunExcerpt& run) {
  const auto found = std::ranges::max_element(
      run.impacts, {}, [](const DrawnImpact& impact) { return hardness(impact.event); });
  return found == run.impacts.end() ? nullptr : &*found;
}

bool hasPairs(const RunExcerpt& run) {
  return std::ranges::any_of(
      run.impacts, [](const DrawnImpact& impact) { return !impact.event.otherVehicle.empty(); });
}

std::string deltaVText(const ImpactEvent& event) {
  std::string text = fixed(event.deltaV, 1);
  const auto other = asSeenBy(event.otherVehicle, event);
  if (other && std::isfinite(other->deltaV)) text += " | " + fixed(other->deltaV, 1);
  return text + " m/s";
}

double topSpeed(const RunExcerpt& run) {
  double most = 0.0;
  for (const auto& path : run.paths) {
    for (const RecordedPose& pose : path) most = std::max(most, pose.velocity.norm());
  }
  return most;
}

}  // namespace bumper::drawing
