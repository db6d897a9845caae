#include "text.h"

#include <stb_easy_font.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace bumper::drawing {

namespace {

/// What the font can draw.
std::string printable(std::string_view line) {
  std::string result;
  for (const char letter : line) {
    const auto code = static_cast<unsigned char>(letter);
    if (code >= 0x80 && code < 0xC0) continue;  // inside a UTF-8 character
    result += code >= ' ' && code <= '~' ? letter : '?';
  }
  return result;
}

}  // namespace

std::vector<Eigen::AlignedBox2d> textBoxes(std::string_view line) {
  // Four corners of x, y, z and colour, 16 bytes each.
  constexpr std::size_t quadSize = 64;
  constexpr std::size_t mostQuadsPerLetter = 32;
  std::string letters = printable(line);
  std::vector<char> buffer(quadSize * mostQuadsPerLetter * (letters.size() + 1));
  const int quads = stb_easy_font_print(0.0F, 0.0F, letters.data(), nullptr, buffer.data(),
                                        static_cast<int>(buffer.size()));
  std::vector<Eigen::AlignedBox2d> boxes;
  for (std::size_t k = 0; k < static_cast<std::size_t>(quads); ++k) {
    std::array<float, 2> low{};
    std::array<float, 2> high{};
    std::memcpy(low.data(), &buffer[k * quadSize], sizeof(low));
    std::memcpy(high.data(), &buffer[k * quadSize + quadSize / 2], sizeof(high));
    boxes.emplace_back(Eigen::Vector2d(static_cast<double>(low[0]), static_cast<double>(low[1])),
                       Eigen::Vector2d(static_cast<double>(high[0]), static_cast<double>(high[1])));
  }
  return boxes;
}

double textWidth(std::string_view line) {
  std::string letters = printable(line);
  return stb_easy_font_width(letters.data());
}

std::string fixed(double value, int decimals) {
  const double unit = std::pow(10.0, -decimals);
  if (std::abs(value) < 0.5 * unit) value = 0.0;
  std::array<char, 400> digits{};
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                     std::chars_format::fixed, decimals);
  return {digits.data(), written.ptr};
}

}  // namespace bumper::drawing
