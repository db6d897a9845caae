#pragma once

/// Counts allocations of a program that is linked with caught_allocations.cpp, which replaces
/// malloc.
namespace bumper::tests {

/// Whoever allocates while this is set, on this thread, is counted.
extern thread_local bool guarded;
extern thread_local int caught;

}  // namespace bumper::tests
