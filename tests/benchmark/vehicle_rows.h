#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "accuracy_rows.h"
#include "vehicle_cases.h"
#include "vehicle_schemes.h"

namespace bumper::benchmark {

/// The largest of the vehicles' errors: of Δv relative to the largest change of velocity that a
/// vehicle of the case has had.
EndError errorOf(const ReferencedVehicles& one, const std::vector<PlanarMotion>& end);

/// A scheme and step over the cases of a kind: a line of accuracy.json.
struct VehicleRow {
  VehicleKind kind = VehicleKind::plain;
  Row errors;  ///< its setting and wall mean nothing
};

/// What became of the cases of a kind.
struct VehicleCount {
  VehicleKind kind = VehicleKind::plain;
  std::size_t cases = 0;
  std::size_t tried = 0;
  std::size_t sensitive = 0;
  std::array<std::size_t, doubts> doubtful{};
};

struct VehicleResults {
  std::vector<VehicleRow> rows;
  std::vector<VehicleCount> counts;
};

struct VehicleOptions {
  std::size_t plain = 240;
  std::size_t pairs = 10000;
  std::size_t scenes = 400;
  std::size_t timed = 40;
  int repetitions = 5;
  std::uint64_t seed = 20030604;
};

VehicleResults measureVehicles(const VehicleOptions& options,
                               const std::function<void(const std::string&)>& say);

}  // namespace bumper::benchmark
