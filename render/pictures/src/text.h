#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bumper/base/api.h"

namespace BUMPER_INTERNAL bumper {
namespace drawing {

/// Heights in units of text; a picture draws them a few times larger.
constexpr double emHeight = 9.0;
constexpr double capitalHeight = 6.6;  ///< from the top of a capital to the baseline

/// Of a line in UTF-8, in units of text.
double textWidth(std::string_view line);

/// The letters of a line in UTF-8. What is no letter of the font, a control character or broken
/// UTF-8 becomes '?'.
std::u32string lettersOf(std::string_view line);

/// In units of text.
double advanceOf(char32_t letter);

/// How much of each pixel a letter covers, row by row from the top.
struct Glyph {
  int left = 0;  ///< pixels from the pen to the first column
  int top = 0;   ///< from the baseline down to the first row
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> coverage;  ///< 0 to 255
};

/// At a size of the em in pixels, the pen a share of a pixel to the right.
Glyph glyphOf(char32_t letter, double size, double share);

/// A number with a point and a fixed number of decimals, whatever the locale; never "-0".
std::string fixed(double value, int decimals);

}  // namespace drawing
}  // namespace bumper
