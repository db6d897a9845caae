#pragma once

#include "accuracy_rows.h"

namespace bumper::benchmark {

/// The name of its rows in accuracy.json.
inline constexpr const char* hinge2Scheme = "bumper_hinge2_car";

/// A chassis with four wheels on hinge2 joints, free of gravity and ground: Δv is that of the
/// common mass centre by the first impact, relative; yaw rate is the chassis's and position the
/// common mass centre's, at the end.
std::vector<Row> hinge2Rows(std::size_t count, std::uint64_t seed, int repetitions);

}  // namespace bumper::benchmark
