#pragma once

#include <cstddef>
#include <cstdint>

#include "bumper/render/recording_writer.h"

namespace bumper::testing {

/// Writes and closes a run of saloons "car 0", "car 1", … that go along x at 10 m/s, `perSecond`
/// poses a second, of which the first hits something at every full second, both ends included.
void addLongRun(RecordingWriter& writer, std::size_t vehicles, int seconds, int perSecond);

/// The most memory that this process has had, bytes.
std::uint64_t peakMemory();

}  // namespace bumper::testing
