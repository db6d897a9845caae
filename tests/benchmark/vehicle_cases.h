#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vehicle_reference.h"

namespace bumper::benchmark {

/// Longest run of a case, s.
inline constexpr double longestVehicleRun = 0.6;

enum class VehicleKind {
  plain,  ///< two, a corner in a side, contact at the point of first touch, fixed e and μ: what
          ///< every peer can do
  pair,  ///< two, from a motorcycle to a lorry, yaw rates to 6 rad/s; the paper's curves or fixed e
         ///< and μ, penetration times to 10 ms
  scene  ///< two to five, and one or two walls
};
const char* nameOf(VehicleKind kind);

struct ReferencedVehicles {
  VehicleCase vehicleCase;
  VehicleFlight flight;
};

/// Cases of a kind with what becomes of them, and why others are none.
struct VehicleBatch {
  VehicleKind kind = VehicleKind::plain;
  std::vector<ReferencedVehicles> cases;
  std::size_t tried = 0;      ///< starts drawn that lead to a touch
  std::size_t sensitive = 0;  ///< of them: another number of impacts if one is moved by 1e-10 m
  /// … of which nothing is certain, by the doubt about their first contact.
  std::array<std::size_t, doubts> doubtful{};
};

/// Always the same ones for a seed. Those of a scene hit a wall and each other.
VehicleBatch makeVehicleBatch(VehicleKind kind, std::size_t count, std::uint64_t seed);

}  // namespace bumper::benchmark
