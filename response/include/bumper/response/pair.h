#pragma once

#include <optional>

#include "bumper/base/api.h"
#include "bumper/response/impact.h"
#include "bumper/response/outline.h"
#include "bumper/response/vehicle_parameters.h"

namespace BUMPER_API bumper {

/// One of two vehicles that may hit each other: its data, and its motion in the plane in which they
/// meet.
struct PairState {
  VehicleParameters vehicle;
  PlanarMotion motion;
};

/// A hit of two vehicles: the first one's impact on the second, in the plane's frame, where both
/// are at that time. The second takes the opposite impulse.
struct PairHit {
  double time = 0.0;  ///< s from the states given
  Impact impact{};
  ImpactResponse response{};
};

/// The first hit of two vehicles in free flight within `h` seconds; none if they do not touch or
/// pass by each other. The point and the normal are those of the nearest-face rule: of the overlap
/// which both reach in the settings' penetration time.
///
/// A pure function of its arguments, for hosts that simulate one vehicle each: with the states and
/// in the order that both agree on, the result is the same to the last bit on each. Which of the
/// two is first is decided by their states, so that exchanging them exchanges and negates the
/// result exactly.
std::optional<PairHit> respondPair(const PairState& first, const PairState& second,
                                   const ResponseSettings& settings, double h);

/// The same hit with the second vehicle as the first.
PairHit asSeenByOther(const PairHit& hit);

/// How far two outlines are apart, m, along the side of either that separates them best; negative:
/// the least depth of their overlap.
struct PairSeparation {
  double distance = 0.0;
  Vector2 normal = Vector2::Zero();  ///< unit, out of the second into the first
};
PairSeparation separation(const Outline& first, const Placement& firstAt, const Outline& second,
                          const Placement& secondAt);

}  // namespace bumper
