#pragma once

#include <chrono>

namespace bumper::benchmark {

/// Nanoseconds of a clock that only goes forward. What is repeated takes the least of its times,
/// so that being interrupted does not count.
inline double nanoseconds() {
  return static_cast<double>(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                 std::chrono::steady_clock::now().time_since_epoch())
                                 .count());
}

}  // namespace bumper::benchmark
