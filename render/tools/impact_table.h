#pragma once

#include <cstddef>

#include "bumper/render/recording.h"

namespace bumper::tools {

/// Prints the impacts in the order of time, one a line, or one for each of two vehicles; of more
/// than `most` the hardest.
void printImpacts(const Recording& recording, std::size_t most = 24);

}  // namespace bumper::tools
