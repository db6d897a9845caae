#include "warnings.h"

#include <utility>

#include "room.h"

namespace bumper {

void Warnings::makeRoom(std::size_t more) {
  bumper::makeRoom(owners_, more);
  bumper::makeRoom(texts_, more);
}

void Warnings::add(const void* owner, std::string text) {
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    if (owners_[i] == owner && texts_[i] == text) return;
  }
  owners_.push_back(owner);
  texts_.push_back(std::move(text));
}

void Warnings::drop(const void* owner) noexcept {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    if (owners_[i] == owner) continue;
    if (kept != i) {
      owners_[kept] = owners_[i];
      texts_[kept] = std::move(texts_[i]);
    }
    ++kept;
  }
  owners_.resize(kept);
  texts_.resize(kept);
}

}  // namespace bumper
