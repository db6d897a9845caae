#pragma once

#include <cmath>
#include <cstdint>
#include <ostream>
#include <random>

#include "bumper/response/contact_solve.h"
#include "bumper/response/vehicle_parameters.h"

/// Random vehicles and impacts that are the same on every machine.
namespace bumper::tests {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// The standard library's distributions differ between its implementations; this does not.
  double uniform(double low, double high) {
    const double unit = static_cast<double>(engine_() >> 11U) * 0x1p-53;
    return low + (high - low) * unit;
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  int below(int count) { return static_cast<int>(uniform(0.0, count)); }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

/// Unit; rad from the x axis.
inline Vector2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Two bodies in contact at one point; `other` may be a barrier.
struct Situation {
  ContactBody vehicle;
  ContactBody other;
  Vector2 normal = Vector2::UnitX();  ///< out of the other body into the vehicle
};

std::ostream& operator<<(std::ostream& out, const Situation& situation);

/// From a small car to a large pickup.
VehicleParameters randomVehicle(Random& random);

enum class Other { barrier, vehicle };

/// A vehicle that closes on a barrier or on another vehicle: contact at a corner, on a side, or
/// anywhere.
Situation randomImpact(Random& random, Other other);

/// 0, 1 and anything between.
double randomRestitution(Random& random);

/// Up to 3: mostly road-like, sometimes absurd.
double randomFriction(Random& random);

/// The situation seen in a mirror that turns left into right.
Situation mirrored(const Situation& situation);

/// The situation seen in a frame turned by `-angle`.
Situation turned(const Situation& situation, double angle);

}  // namespace bumper::tests
