#include "impact_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "bumper/base/printing.h"
#include "bumper/render/degrees.h"

namespace bumper::tools {

namespace {

// Which end and side of the car was hit.
std::string placeOf(const Vector2& arm, const VehicleParameters& car) {
  std::string place;
  if (arm.x() > 0.5 * car.massCentreToFront) place = "front";
  if (arm.x() < -0.5 * car.massCentreToRear) place = "rear";
  const bool atSide = std::abs(arm.y()) > 0.15 * car.width;
  if (!atSide) return place.empty() ? "middle" : place;
  if (!place.empty()) place += ' ';
  return place + (arm.y() > 0.0 ? "left" : "right");
}

}  // namespace

void printImpacts(const Recording& recording, std::size_t most) {
  if (recording.impacts().empty()) {
    std::printf("  no impact\n");
    return;
  }
  std::vector<double> changes;
  for (const RecordedImpact& each : recording.impacts()) changes.push_back(each.event().deltaV);
  std::sort(changes.begin(), changes.end(), std::greater<>());
  const double least = changes.size() > most ? changes[most - 1] : 0.0;
  if (changes.size() > most) {
    std::printf("  the %zu hardest of %zu impacts:\n", most, changes.size());
  }
  std::printf("  %3s %8s  %-12s %-14s %7s %9s %9s %10s %17s %15s\n", "#", "time s", "where", "wall",
              "angle °", "closing", "Δv m/s", "impulse Ns", "yaw rate °/s", "speed m/s");
  int number = 0;
  for (const RecordedImpact& each : recording.impacts()) {
    ++number;
    const ImpactEvent event = each.event();
    if (event.deltaV < least) continue;
    const VehicleParameters* car = nullptr;
    for (const RecordedVehicle& vehicle : recording.vehicles()) {
      if (vehicle.name == event.vehicle) car = &vehicle.parameters;
    }
    const std::string wall = printable(event.material.empty() ? event.barrier : event.material);
    std::printf(
        "  %3d %8.3f  %-12s %-14.14s %7.1f %9.2f %9.2f %10.0f %7.0f → %7.0f %6.2f → %6.2f\n",
        number, event.time, placeOf(event.arm, *car).c_str(), wall.c_str(),
        event.angles.contactVelocity * degrees, event.approachSpeed, event.deltaV,
        std::hypot(event.impulseNormal, event.impulseTangent), event.yawRateBefore * degrees,
        event.yawRateAfter * degrees, event.speedBefore, event.speedAfter);
  }
}

}  // namespace bumper::tools
