#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

/// 8 bits per channel, sRGB.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

/// A picture: rows from the top, pixels from the left. One that was moved from is 0 × 0.
class Image {
 public:
  /// The largest width and height, pixels.
  static constexpr int maxSide = 16384;

  /// Of one colour. Throws Error unless width and height lie in 1 to maxSide.
  Image(int width, int height, Rgb fill = {});
  Image(const Image&) = default;
  Image& operator=(const Image&) = default;
  Image(Image&& other) noexcept
      : width_(std::exchange(other.width_, 0)),
        height_(std::exchange(other.height_, 0)),
        pixels_(std::exchange(other.pixels_, {})) {}
  Image& operator=(Image&& other) noexcept {
    width_ = std::exchange(other.width_, 0);
    height_ = std::exchange(other.height_, 0);
    pixels_ = std::exchange(other.pixels_, {});
    return *this;
  }
  ~Image() = default;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// 0 ≤ x < width from the left, 0 ≤ y < height from the top; not checked.
  [[nodiscard]] const Rgb& at(int x, int y) const { return pixels_[index(x, y)]; }
  [[nodiscard]] Rgb& at(int x, int y) { return pixels_[index(x, y)]; }

  /// Row by row, without gaps.
  [[nodiscard]] const std::vector<Rgb>& pixels() const { return pixels_; }
  [[nodiscard]] std::vector<Rgb>& pixels() { return pixels_; }

  bool operator==(const Image&) const = default;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<Rgb> pixels_;
};

/// Writes a PNG file of 8-bit RGB. Throws Error, naming the file, if it cannot be written or the
/// picture has no pixels; nothing half-written then remains.
void writePng(const Image& image, const std::filesystem::path& file);

/// Pixels of the largest picture that is drawn, 8192 × 8192: 200 MB, which a PNG file of 200 kB may
/// ask for.
inline constexpr std::size_t usualMostPixels = std::size_t{8192} * 8192;

/// Reads a PNG file of any kind as 8-bit RGB; transparency is blended onto white. Throws Error,
/// naming the file, if it is no regular file, cannot be read, is no PNG, is cut off or damaged, is
/// larger than an Image can be, or has more than `mostPixels`: its first bytes tell.
Image readPng(const std::filesystem::path& file, std::size_t mostPixels = usualMostPixels);

}  // namespace bumper
