#pragma once

#include <chrono>
#include <ctime>

namespace bumper::benchmark {

/// Nanoseconds of a clock that only goes forward. What is repeated takes the least of its times,
/// so that being interrupted does not count.
inline double nanoseconds() {
  return static_cast<double>(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                 std::chrono::steady_clock::now().time_since_epoch())
                                 .count());
}

/// The same of this thread's own time, which does not run while it waits for a processor. Reading
/// it takes longer: for what takes a tenth of a millisecond or more.
inline double threadNanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

}  // namespace bumper::benchmark
