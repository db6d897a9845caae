#pragma once

#include <cstdint>
#include <string>

#include "bumper/engine_adapter/c_api.h"
#include "bumper/response/error.h"

/// What may fail on the way from C to C++ and back: exceptions here, codes and messages there.
namespace bumper::c_api {

/// A handle that names nothing, or nothing any more.
class StaleHandle : public Error {
 public:
  using Error::Error;
};

/// More things than handles.
class TooMany : public Error {
 public:
  using Error::Error;
};

/// Keeps what the exception that is being handled says as this thread's message, behind the name of
/// the function that was called, and returns its code.
int reported(const char* function) noexcept;

/// What a function of the C interface does; its result, or a code if it throws.
template <typename Call>
int guarded(const char* function, const Call& call) noexcept {
  try {
    return call();
  } catch (...) {
    return reported(function);
  }
}

/// An argument, or a member of one, as messages name it.
struct Name {
  const char* text;
  const Name* of = nullptr;  ///< the struct or array that it is in
  std::int64_t index = -1;   ///< in an array; −1: it is in none

  [[nodiscard]] std::string full() const;
};

/// Throws Error: "<name> <defect>".
[[noreturn]] void refuse(const Name& name, const std::string& defect);

template <typename Thing>
Thing& required(const char* name, Thing* pointer) {
  if (pointer == nullptr) refuse({name}, "is null");
  return *pointer;
}

}  // namespace bumper::c_api
