#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace bumper {

/// Warnings of set-up calls, each given once for each owner: the vehicle or barrier concerned. The
/// owner is null for those about the world.
class Warnings {
 public:
  /// Makes room for so many more; add() then does not throw.
  void makeRoom(std::size_t more);
  void add(const void* owner, std::string text);
  void drop(const void* owner) noexcept;
  /// In the order in which they came.
  [[nodiscard]] std::span<const std::string> all() const { return texts_; }

 private:
  std::vector<const void*> owners_;  // of each text
  std::vector<std::string> texts_;
};

}  // namespace bumper
