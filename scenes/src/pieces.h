#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace bumper {

/// Connected components, by their corners (union-find).
class Pieces {
 public:
  explicit Pieces(std::size_t corners) : parents_(corners) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  std::uint32_t find(std::uint32_t corner) {
    while (parents_[corner] != corner) {
      parents_[corner] = parents_[parents_[corner]];
      corner = parents_[corner];
    }
    return corner;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace bumper
