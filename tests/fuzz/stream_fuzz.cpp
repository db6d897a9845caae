// What the program that reads scenes hands back, of any bytes: refused, or packed again it is the
// same bytes.

#include <cstdlib>
#include <string_view>

#include "scene_stream.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const bumper::SceneBudget budget{.triangles = 1000, .nodes = 100, .names = 1000};
  const std::optional<bumper::ReadResult> result = bumper::unpack(bytes, budget);
  if (result && bumper::pack(*result) != bytes) std::abort();
  return 0;
}
