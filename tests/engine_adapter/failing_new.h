#pragma once

/// Lets allocations fail in a program that is linked with failing_new.cpp, which replaces operator
/// new.
namespace bumper::tests {

extern long live;          ///< allocations that have not been freed
extern long untilFailure;  ///< allocations that succeed; negative: all do
extern bool failsOnce;     ///< or all from then on, until untilFailure is set anew

}  // namespace bumper::tests
