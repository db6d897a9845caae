#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "border.h"

/// Structs of callers with another version of the header.
namespace bumper::c_api {

/// What the library must know of a struct that begins with its size; specialised in fields.h:
///   Cpp        what it is in C++
///   firstSize  its size in the first release, the smallest valid one
template <typename C>
struct Layout;

template <typename C>
concept Sized = requires {
  Layout<C>::firstSize;
};

/// Members are added in units of this, without holes between them.
inline constexpr std::size_t sizeUnit = 8;

/// Throws Error unless a struct may have this size.
template <Sized C>
void requireSize(const Name& name, std::size_t size) {
  static_assert(Layout<C>::firstSize % sizeUnit == 0 && sizeof(C) % sizeUnit == 0);
  // Nobody's struct is larger than this: it is a size that was never set.
  constexpr std::size_t largest = 65536;
  if (size >= Layout<C>::firstSize && size <= largest && size % sizeUnit == 0) return;
  refuse(name, "has size " + std::to_string(size) + ": fill it by its bumper_init function, with " +
                   std::to_string(sizeof(C)) + " bytes by this header");
}

/// A caller's struct, completed: what it lacks is as in `whole`. Throws Error if it is longer and
/// says something there.
template <Sized C>
C completed(const Name& name, const C& given, C whole) {
  const std::size_t size = given.size;
  requireSize<C>(name, size);
  const auto* bytes = reinterpret_cast<const unsigned char*>(&given);
  if (size > sizeof(C) &&
      std::any_of(bytes + sizeof(C), bytes + size, [](unsigned char byte) { return byte != 0; })) {
    refuse(name, "has members that this version of the library does not know");
  }
  std::memcpy(&whole, bytes, std::min(size, sizeof(C)));
  return whole;
}

/// Fills a caller's struct of `size` bytes.
template <Sized C>
void fill(const Name& name, C& target, std::size_t size, const C& whole) {
  requireSize<C>(name, size);
  auto* bytes = reinterpret_cast<unsigned char*>(&target);
  std::memcpy(bytes, &whole, std::min(size, sizeof(C)));
  if (size > sizeof(C)) std::memset(bytes + sizeof(C), 0, size - sizeof(C));
  target.size = size;
}

}  // namespace bumper::c_api
