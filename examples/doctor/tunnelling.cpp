#include "tunnelling.h"

#include <cmath>
#include <utility>

#include "trace_measures.h"

namespace bumper::doctor {

namespace {

constexpr int phases = 4;
constexpr double tolerance = 1.03;

TestDrive driveAt(const Subject& subject, const Place& place, Approach approach, double speed,
                  int phase) {
  const VehicleParameters& vehicle = subject.vehicle;
  const bool isFront = approach == Approach::front;
  const double yaw = isFront ? -90.0 * degree : 0.0;
  const double reach = isFront ? vehicle.massCentreToFront : 0.5 * vehicle.width;
  const double way = speed * subject.step;
  const double gap = 0.001 * subject.length() + way * static_cast<double>(phase) / phases;
  // Long enough for two lengths of the vehicle, were there no wall.
  const auto steps = static_cast<std::size_t>(std::ceil((gap + 2.0 * subject.length()) / way)) + 6;
  return {.plane = place.plane,
          .start = {.position = {0.0, reach + gap}, .yaw = yaw, .velocity = {0.0, -speed}},
          .attack = 90.0 * degree,
          .steps = steps};
}

std::optional<TunnellingDrive> driveThrough(const Subject& subject, const Place& place,
                                            Approach approach, double speed, Rig& rig) {
  for (int phase = 0; phase < phases; ++phase) {
    const TestDrive drive = driveAt(subject, place, approach, speed, phase);
    if (!place.isFree(subject.vehicle, drive.start)) continue;
    if (wentThrough(rig.run(drive), place)) return TunnellingDrive{speed, drive};
  }
  return std::nullopt;
}

}  // namespace

SpeedRange searchedSpeeds(const Subject& subject) {
  return {.lowest = 0.1 * subject.speed, .highest = 2.0 * subject.length() / subject.step};
}

std::optional<TunnellingDrive> tunnellingSpeed(const Subject& subject, const Place& place,
                                               Approach approach, Rig& rig) {
  auto [low, high] = searchedSpeeds(subject);
  std::optional<TunnellingDrive> lowest = driveThrough(subject, place, approach, high, rig);
  if (!lowest) return std::nullopt;
  if (auto slow = driveThrough(subject, place, approach, low, rig)) return slow;
  while (high > tolerance * low) {
    const double middle = std::sqrt(low * high);
    if (auto through = driveThrough(subject, place, approach, middle, rig)) {
      lowest = std::move(through);
      high = middle;
    } else {
      low = middle;
    }
  }
  return lowest;
}

}  // namespace bumper::doctor
