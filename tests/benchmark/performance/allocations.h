#pragma once

#include <cstddef>

namespace bumper::benchmark {

/// How often this program has called operator new until now. A program that calls this replaces
/// operator new and delete.
std::size_t allocationCount();

}  // namespace bumper::benchmark
