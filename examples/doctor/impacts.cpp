#include "impacts.h"

#include <array>
#include <cmath>

#include "trace_measures.h"

namespace bumper::doctor {

namespace {

constexpr std::array<double, 3> impactAngles{20.0, 45.0, 90.0};
constexpr double impactDuration = 0.25;  // s

}  // namespace

Impacts::Impacts(const Subject& subject, std::span<const Place> places) : places_(places) {
  const VehicleParameters& vehicle = subject.vehicle;
  double phase = 0.5;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const double angle : impactAngles) {
      phase = std::fmod(phase + golden, 1.0);
      const double yaw = -angle * degree;
      // Off its middle, so that a head-on impact turns the vehicle too.
      const Vector2 front(vehicle.massCentreToFront,
                          angle < 90.0 ? -0.5 * vehicle.width : 0.2 * vehicle.width);
      const double gap = 0.001 * subject.length() +
                         phase * subject.speed * subject.step * std::sin(angle * degree);
      PlanarMotion start{.yaw = yaw, .velocity = rotated({subject.speed, 0.0}, yaw)};
      start.position = Vector2(0.0, gap) - rotated(front, yaw);
      if (!places[i].isFree(vehicle, start)) continue;
      drives_.push_back(
          {.place = i,
           .drive = {.plane = places[i].plane,
                     .start = start,
                     .attack = angle * degree,
                     .steps = static_cast<std::size_t>(impactDuration / subject.step)}});
    }
  }
}

std::vector<ImpactTrial> Impacts::driven(Rig& rig) const {
  std::vector<ImpactTrial> trials = drives_;
  for (ImpactTrial& trial : trials) {
    const DriveTrace trace = rig.run(trial.drive);
    trial.energy = mostEnergy(trace);
    trial.isThrough = wentThrough(trace, places_[trial.place]);
  }
  return trials;
}

}  // namespace bumper::doctor
