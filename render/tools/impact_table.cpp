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

// What a vehicle has hit, as a name that can be printed.
std::string hitBy(const ImpactEvent& event) {
  if (!event.otherVehicle.empty()) return printable(event.otherVehicle);
  return printable(event.material.empty() ? event.barrier : event.material);
}

// One line: an impact as one of its vehicles sees it; without the number if it has been told.
void printImpact(const std::string& number, const ImpactEvent& event, const Recording& recording) {
  const auto car = std::ranges::find(recording.vehicles(), event.vehicle, &RecordedVehicle::name);
  const bool isKnown = car != recording.vehicles().end() && event.arm.allFinite();
  const std::string place = isKnown ? placeOf(event.arm, car->parameters) : "?";
  std::printf("  %3s %8.3f  ", number.c_str(), event.time);
  if (recording.vehicles().size() > 1) std::printf("%-14.14s ", printable(event.vehicle).c_str());
  std::printf("%-12s %-14.14s %7.1f %9.2f %9.2f %10.0f %7.0f → %7.0f %6.2f → %6.2f\n",
              place.c_str(), hitBy(event).c_str(), event.angles.contactVelocity * degrees,
              event.approachSpeed, event.deltaV,
              std::hypot(event.impulseNormal, event.impulseTangent), event.yawRateBefore * degrees,
              event.yawRateAfter * degrees, event.speedBefore, event.speedAfter);
}

}  // namespace

void printImpacts(const Recording& recording, std::size_t most) {
  if (recording.impacts().empty()) {
    std::printf("  no impact\n");
    return;
  }
  std::vector<double> changes;
  for (const RecordedImpact& each : recording.impacts()) changes.push_back(hardness(each.event()));
  std::sort(changes.begin(), changes.end(), std::greater<>());
  const double least = changes.size() > most ? changes[most - 1] : 0.0;
  if (changes.size() > most) {
    std::printf("  the %zu hardest of %zu impacts:\n", most, changes.size());
  }
  const bool several = recording.vehicles().size() > 1;
  std::printf("  %3s %8s  ", "#", "time s");
  if (several) std::printf("%-14s ", "vehicle");
  std::printf("%-12s %-14s %7s %9s %9s %10s %17s %15s\n", "where", several ? "hits" : "wall",
              "angle °", "closing", "Δv m/s", "impulse Ns", "yaw rate °/s", "speed m/s");
  int number = 0;
  for (const RecordedImpact& each : recording.impacts()) {
    ++number;
    const ImpactEvent event = each.event();
    if (hardness(event) < least) continue;
    printImpact(std::to_string(number), event, recording);
    // The other vehicle's side of it.
    if (const auto other = asSeenBy(event.otherVehicle, event)) printImpact("", *other, recording);
  }
}

}  // namespace bumper::tools
