#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace bumper {

/// 8 bits per channel, sRGB.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

/// A picture: rows from the top, pixels from the left.
class Image {
 public:
  /// The largest width and height, pixels.
  static constexpr int maxSide = 16384;

  /// Of one colour. Throws Error unless width and height lie in 1 to maxSide.
  Image(int width, int height, Rgb fill = {});

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

/// Writes a PNG file of 8-bit RGB. Throws Error, naming the file, if it cannot be written; nothing
/// half-written then remains.
void writePng(const Image& image, const std::filesystem::path& file);

/// Reads a PNG file of any kind as 8-bit RGB; transparency is blended onto white. Throws Error,
/// naming the file, if it cannot be read, is no PNG, is cut off or damaged, or is larger than an
/// Image can be.
Image readPng(const std::filesystem::path& file);

}  // namespace bumper
