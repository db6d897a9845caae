#pragma once

#include <optional>

#include "bumper/response/impact.h"
#include "bumper/response/vehicle_parameters.h"

namespace bumper {

/// One of two vehicles that may hit each other: its data, and its motion in the plane in which they
/// meet.
struct PairState {
  VehicleParameters vehicle;
  PlanarMotion motion;
};

/// A hit of two vehicles: the first one's impact on the second, in the plane's frame, where both are
/// at that time. The second takes the opposite impulse.
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

}  // namespace bumper
