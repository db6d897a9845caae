// A PNG file of any bytes is read or refused; a picture is the same as itself, and what it differs
// by from its own negative are shares.

#include <cstdlib>
#include <string>

#include "bumper/render/image.h"
#include "bumper/render/image_compare.h"
#include "bumper/response/error.h"
#include "memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bumper::fuzz::MemoryFile file(data, size);
  try {
    const bumper::Image image = bumper::readPng(file.path(), std::size_t{64} * 64);
    if (!bumper::compareImages(image, image).isSame) std::abort();
    bumper::Image negative = image;
    for (bumper::Rgb& each : negative.pixels()) each.red = static_cast<std::uint8_t>(~each.red);
    const bumper::ImageComparison result =
        bumper::compareImages(image, negative, {.smoothing = 2, .reach = 1});
    if (!(result.differingShare >= 0.0 && result.differingShare <= 1.0)) std::abort();
    if (!(result.worstTileShare >= 0.0 && result.worstTileShare <= 1.0)) std::abort();
  } catch (const bumper::Error& error) {
    if (std::string(error.what()).find(file.path().string()) == std::string::npos) std::abort();
  }
  return 0;
}
