// A recording of any bytes is read or refused, and what was read is within the limits.

#include <cstdlib>
#include <string>

#include "bumper/render/recording.h"
#include "bumper/render/recording_reader.h"
#include "bumper/response/error.h"
#include "memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bumper::fuzz::MemoryFile file(data, size);
  bumper::RecordingLimits limits;
  limits.lineBytes = std::size_t{1} << 16U;
  limits.names = 100;
  try {
    bumper::RunDescription run;
    const bumper::Recording recording = bumper::readRecording(file.path(), &run, limits);
    if (recording.vehicles().size() > limits.names) std::abort();
  } catch (const bumper::Error& error) {
    if (std::string(error.what()).find(file.path().string()) == std::string::npos) std::abort();
  }
  return 0;
}
