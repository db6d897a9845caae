#pragma once

#include <stdexcept>
#include <string>

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

/// The one exception type of the library. Thrown by set-up calls and by reading and writing files,
/// never by a simulation step. The message names the offending value or file, its unit, and what is
/// allowed.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace bumper
