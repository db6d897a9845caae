#include "bumper/render/image.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>

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

[[noreturn]] void failReading(const std::filesystem::path& file, const std::string& reason) {
  throw Error("cannot read " + file.string() + reason);
}

/// Width and height as the first bytes of a PNG file state them; zeros if these are none of one.
std::array<std::uint64_t, 2> sizeStatedBy(std::istream& stream) {
  static constexpr std::array<char, 16> start = {'\x89', 'P', 'N', 'G', '\r', '\n', '\x1A', '\n',
                                                 0,      0,   0,   13,  'I',  'H',  'D',    'R'};
  std::array<char, start.size() + 8> bytes{};
  if (!stream.read(bytes.data(), bytes.size())) return {};
  if (!std::equal(start.begin(), start.end(), bytes.begin())) return {};
  std::array<std::uint64_t, 2> size{};
  for (std::size_t k = 0; k < 8; ++k)
    size.at(k / 4) = size.at(k / 4) << 8U | static_cast<unsigned char>(bytes.at(start.size() + k));
  return size;
}

/// The bytes of a PNG file of at most so many pixels, and in proportion to these.
std::vector<char> readFile(const std::filesystem::path& file, std::size_t mostPixels) {
  constexpr std::uint64_t bytesPerPixel = 9;  // 16 bits in four channels, not compressible
  constexpr std::uint64_t besides = std::uint64_t{16} << 20U;  // bytes: text, profiles
  std::error_code failure;
  if (std::filesystem::exists(file, failure) && !std::filesystem::is_regular_file(file, failure))
    failReading(file, ": it is no regular file");
  std::ifstream stream(file, std::ios::binary);
  const auto [width, height] = sizeStatedBy(stream);
  if (width == 0 || height == 0) failReading(file, ": it must be a PNG file");
  const std::string size =
      ": it is " + std::to_string(width) + " x " + std::to_string(height) + " pixels, allowed are ";
  if (width > Image::maxSide || height > Image::maxSide)
    failReading(file, size + std::to_string(Image::maxSide) + " each way");
  if (width * height > mostPixels) failReading(file, size + std::to_string(mostPixels) + " in all");
  const std::uintmax_t length = std::filesystem::file_size(file, failure);
  if (failure) failReading(file, ": " + failure.message());
  if (length > bytesPerPixel * width * height + besides)
    failReading(file, size + "not so many bytes as it has, " + std::to_string(length));
  std::vector<char> bytes(length);
  stream.seekg(0);
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    failReading(file, ": it must stay as it is meanwhile");
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
  if (image.pixels().empty())
    throw Error("cannot write " + file.string() + ": the picture has no pixels");
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

Image readPng(const std::filesystem::path& file, std::size_t mostPixels) {
  const std::vector<char> bytes = readFile(file, mostPixels);
  PngImage input;
  if (png_image_begin_read_from_memory(&input.png, bytes.data(), bytes.size()) == 0)
    failReading(file, std::string(" as PNG: ") + input.png.message);
  if (!hasEnd(bytes)) failReading(file, " as PNG: it is cut off");
  input.png.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(input.png.width), static_cast<int>(input.png.height));
  const png_color white = {255, 255, 255};
  if (png_image_finish_read(&input.png, &white, image.pixels().data(), 0, nullptr) == 0)
    failReading(file, std::string(" as PNG: ") + input.png.message);
  return image;
}

}  // namespace bumper
