#pragma once

#include <string>
#include <string_view>

#include "bumper/base/api.h"

namespace BUMPER_INTERNAL bumper {

/// What a program may print of text that it did not write itself: control characters, marks that
/// turn the direction of writing and bytes that are not UTF-8 are shown as \n, \x1B or \u202E.
std::string printable(std::string_view text);

/// For the end of a program's main(): closes standard output. Throws Error if not all that was
/// printed could be written; that it was closed from the beginning is no error.
void closeStandardOutput();

}  // namespace bumper
