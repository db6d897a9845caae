#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

#include "bumper/base/api.h"
#include "bumper/render/image.h"
#include "picture.h"
#include "text.h"

namespace BUMPER_INTERNAL bumper {
namespace drawing {

/// Calls blend(pixel, coverage, x, y) for each pixel of the image that a glyph covers, coverage
/// from 1 to 255. `left` is the pixel in which the pen stands.
template <typename Blend>
void blendGlyph(const Glyph& glyph, int left, int baseline, Image& image, const Blend& blend) {
  for (int row = 0; row < glyph.height; ++row) {
    const int y = baseline + glyph.top + row;
    if (y < 0 || y >= image.height()) continue;
    for (int column = 0; column < glyph.width; ++column) {
      const int x = left + glyph.left + column;
      if (x < 0 || x >= image.width()) continue;
      const std::uint8_t coverage =
          glyph.coverage[static_cast<std::size_t>(row) * static_cast<std::size_t>(glyph.width) +
                         static_cast<std::size_t>(column)];
      if (coverage > 0) blend(image.at(x, y), coverage, x, y);
    }
  }
}

/// Draws text into images; keeps the glyphs that it has rasterised for the next.
class TextRenderer {
 public:
  void write(const std::vector<TextLine>& textLines, Image& image);

 private:
  /// Glyphs stand at quarters of a pixel.
  static constexpr int places = 4;
  /// Letter, size in pixels, place.
  using Key = std::tuple<char32_t, double, int>;

  const Glyph& glyph(const Key& key);

  std::map<Key, Glyph> glyphs_;
};

}  // namespace drawing
}  // namespace bumper
