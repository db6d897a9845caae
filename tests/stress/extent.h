#pragma once

#include <initializer_list>
#include <vector>

namespace bumper::tests {

/// Whether this is the program that takes minutes. The same objects are linked into it and into the
/// one that takes seconds.
extern const bool isLong;

/// How often something is done, or for how many seconds: a little, or a lot in the long program.
template <typename Number>
Number extent(Number little, Number much) {
  return isLong ? much : little;
}

/// Parameters of tests of the long program alone.
template <typename Parameter>
std::vector<Parameter> inLong(std::initializer_list<Parameter> parameters) {
  return isLong ? std::vector<Parameter>(parameters) : std::vector<Parameter>();
}

}  // namespace bumper::tests
