#pragma once

#include <cstddef>

/// Counts allocations of a program that is linked with allocated_bytes.cpp, which replaces operator
/// new.
namespace bumper::tests {

/// So far, in all.
std::size_t allocatedBytes();

}  // namespace bumper::tests
