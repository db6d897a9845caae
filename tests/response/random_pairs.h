#pragma once

#include "bumper/response/pair.h"
#include "random_impacts.h"

/// Random vehicles that are about to hit each other, the same on every machine.
namespace bumper::tests {

struct Pair {
  PairState first;
  PairState second;
};

std::ostream& operator<<(std::ostream& out, const PairState& state);
std::ostream& operator<<(std::ostream& out, const Pair& pair);

struct PairLimits {
  double leastMass = 250.0;    ///< kg
  double mostMass = 18'000.0;  ///< kg
  double mostSpeed = 30.0;     ///< of each, m/s
  double mostYawRate = 6.0;    ///< rad/s
};

/// A vehicle whose size goes with its mass: 250 kg are 2.2 × 0.8 m, 18 t are 10 × 2.5 m.
VehicleParameters vehicleOfMass(Random& random, double mass);

/// Of any mass within the limits, all orders of magnitude alike.
VehicleParameters randomVehicle(Random& random, const PairLimits& limits);

/// Two vehicles, apart from each other, the second of which drives at some point of the first.
Pair randomPair(Random& random, const PairLimits& limits = {});

/// The pair seen in a mirror that turns left into right.
Pair mirrored(const Pair& pair);

/// The pair turned by an angle about the frame's origin.
Pair turned(const Pair& pair, double angle);

/// A state as single precision would carry it.
PairState rounded(const PairState& state);

}  // namespace bumper::tests
