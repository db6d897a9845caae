#pragma once

#include <ctime>
#include <limits>

namespace bumper::benchmark {

/// A time before anything was measured.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Measures how long something takes, ns. What is repeated takes the least of its times, so that
/// being interrupted does not count. What takes longer than machines leave anyone alone is measured
/// by the thread's own clock, which does not run while the thread waits for a processor, but takes
/// long to read.
class Timer {
 public:
  Timer() : threadBegin_(read(CLOCK_THREAD_CPUTIME_ID)), begin_(read(CLOCK_MONOTONIC)) {}

  [[nodiscard]] double elapsed() const {
    const double time = read(CLOCK_MONOTONIC) - begin_;
    return time < longTime_ ? time : read(CLOCK_THREAD_CPUTIME_ID) - threadBegin_;
  }

 private:
  static constexpr double longTime_ = 1e5;  // ns

  static double read(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
  }

  double threadBegin_;
  double begin_;
};

}  // namespace bumper::benchmark
