#pragma once

namespace bumper::tests {

/// Built with the address sanitizer, under which some tests take fifteen times as long: they are
/// smaller then, as long as the same code runs.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace bumper::tests
