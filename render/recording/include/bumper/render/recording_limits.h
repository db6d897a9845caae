#pragma once

#include <cstddef>

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

/// What a recording file may ask of its reader. A kilobyte of text can ask for a film of a year:
/// what is above these is an Error that names the limit. Each may be set to whatever is needed.
struct RecordingLimits {
  /// s between the first and the last pose that are read. Frames of a film and outlines of a plot
  /// grow with it, not with the file. A day.
  double seconds = 86400.0;
  /// s: of any time, either way. Beyond 1e10, 317 years, a double does not tell the steps of a
  /// simulation apart any more: 2 µs are lost.
  double latest = 1e10;
  /// Bytes. A line is parsed as a whole, which takes up to some twenty times its length of memory.
  /// Here a header has room for 10,000 vehicles, and a line for the poses of 60,000.
  std::size_t lineBytes = std::size_t{16} << 20U;
  /// Of JSON arrays and objects within each other; the format has four.
  std::size_t depth = 32;
  /// Vehicles, parameters and settings in all.
  std::size_t names = 10000;
};

}  // namespace bumper
