#include "bumper/render/image.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "bumper/base/output_file.h"
#include "bumper/response/error.h"

namespace bumper {

static_assert(sizeof(Rgb) == 3, "libpng is handed rows of Rgb");

namespace {

/// libpng's simplified interface: it reports errors by return value and never prints.
struct PngImage {
  PngImage() { png.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  PngImage(PngImage&&) = delete;
  PngImage& operator=(PngImage&&) = delete;
  ~PngImage() { png_image_free(&png); }

  png_image png{};
};

std::vector<char> readFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> bytes;
  std::array<char, 65536> part{};
  while (stream) {
    stream.read(part.data(), part.size());
    bytes.insert(bytes.end(), part.begin(), part.begin() + stream.gcount());
  }
  if (stream.bad() || bytes.empty())
    throw Error("cannot read " + file.string() + ": it must be a PNG file");
  return bytes;
}

/// libpng reads the pixels and not to the end of the file.
bool hasEnd(const std::vector<char>& bytes) {
  static constexpr std::array<char, 12> end = {0,   0,   0,      0,      'I',    'E',
                                               'N', 'D', '\xAE', '\x42', '\x60', '\x82'};
  return std::search(bytes.begin(), bytes.end(), end.begin(), end.end()) != bytes.end();
}

}  // namespace

Image::Image(int width, int height, Rgb fill) : width_(width), height_(height) {
  if (width < 1 || width > maxSide || height < 1 || height > maxSide) {
    throw Error("an image of " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels: width and height must lie in 1 to " + std::to_string(maxSide));
  }
  pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
}

void writePng(const Image& image, const std::filesystem::path& file) {
  PngImage encoder;
  encoder.png.width = static_cast<png_uint_32>(image.width());
  encoder.png.height = static_cast<png_uint_32>(image.height());
  encoder.png.format = PNG_FORMAT_RGB;

  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(encoder.png);
  std::vector<char> bytes(size);
  if (png_image_write_to_memory(&encoder.png, bytes.data(), &size, 0, image.pixels().data(), 0,
                                nullptr) == 0)
    throw Error("cannot write " + file.string() + ": " + encoder.png.message);

  OutputFile output(file);
  output.write({{bytes.data(), size}});
  output.moveToPlace();
}

Image readPng(const std::filesystem::path& file) {
  const std::vector<char> bytes = readFile(file);
  PngImage input;
  if (png_image_begin_read_from_memory(&input.png, bytes.data(), bytes.size()) == 0)
    throw Error("cannot read " + file.string() + " as PNG: " + input.png.message);
  if (!hasEnd(bytes)) throw Error("cannot read " + file.string() + " as PNG: it is cut off");
  if (input.png.width > Image::maxSide || input.png.height > Image::maxSide) {
    throw Error("cannot read " + file.string() + ": it is " + std::to_string(input.png.width) +
                " x " + std::to_string(input.png.height) + " pixels, allowed are " +
                std::to_string(Image::maxSide) + " each way");
  }
  input.png.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(input.png.width), static_cast<int>(input.png.height));
  const png_color white = {255, 255, 255};
  if (png_image_finish_read(&input.png, &white, image.pixels().data(), 0, nullptr) == 0)
    throw Error("cannot read " + file.string() + " as PNG: " + input.png.message);
  return image;
}

}  // namespace bumper
