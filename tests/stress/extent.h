#pragma once

namespace bumper::tests {

/// How often something is done, or for how many seconds: a little by default, a lot in the program
/// that is built with BUMPER_STRESS_LONG.
template <typename Number>
constexpr Number extent([[maybe_unused]] Number little, [[maybe_unused]] Number much) {
#ifdef BUMPER_STRESS_LONG
  return much;
#else
  return little;
#endif
}

}  // namespace bumper::tests
