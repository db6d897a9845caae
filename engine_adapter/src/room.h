#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bumper {

/// Makes room for so many more elements, which can then be added without an allocation, and leaves
/// the growth as it is otherwise.
template <typename T>
void makeRoom(std::vector<T>& values, std::size_t more) {
  const std::size_t needed = values.size() + more;
  if (needed > values.capacity()) values.reserve(std::max(needed, 2 * values.capacity()));
}

}  // namespace bumper
