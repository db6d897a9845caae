#pragma once

#ifdef BUMPER_VALGRIND
#include <valgrind/callgrind.h>
#endif

/// What the program tells valgrind's tool callgrind, if it runs under it. Its header was not found:
/// nothing.
namespace bumper::benchmark::callgrind {

/// Whether the program was built with valgrind's header and runs under valgrind.
inline bool isWatching() {
#ifdef BUMPER_VALGRIND
  return RUNNING_ON_VALGRIND != 0;
#else
  return false;
#endif
}

/// Instruments from now on, with empty counters; collects nothing yet.
inline void start() {
#ifdef BUMPER_VALGRIND
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
#endif
}

/// Collects from now on, or no more.
inline void toggle() {
#ifdef BUMPER_VALGRIND
  CALLGRIND_TOGGLE_COLLECT;
#endif
}

/// Writes the counters to the next file, under a name.
inline void dump([[maybe_unused]] const char* name) {
#ifdef BUMPER_VALGRIND
  CALLGRIND_DUMP_STATS_AT(name);
#endif
}

inline void stop() {
#ifdef BUMPER_VALGRIND
  CALLGRIND_STOP_INSTRUMENTATION;
#endif
}

}  // namespace bumper::benchmark::callgrind
