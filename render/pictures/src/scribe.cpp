#include "scribe.h"

#include <algorithm>
#include <cmath>

namespace bumper::drawing {

namespace {

/// More letters than a picture has; all are forgotten when there are more.
constexpr std::size_t mostGlyphs = 4000;

std::uint8_t mixed(std::uint8_t below, float above, float share) {
  return static_cast<std::uint8_t>(
      std::lround(static_cast<float>(below) * (1.0F - share) + 255.0F * above * share));
}

bool isCovered(const Writing& writing, int x, int y) {
  return std::ranges::any_of(writing.covered, [&](const Eigen::AlignedBox2d& area) {
    return area.contains(Eigen::Vector2d(x + 0.5, y + 0.5));
  });
}

void stamp(const Glyph& glyph, int left, int baseline, const Writing& writing, Image& image) {
  for (int row = 0; row < glyph.height; ++row) {
    const int y = baseline + glyph.top + row;
    if (y < 0 || y >= image.height()) continue;
    for (int column = 0; column < glyph.width; ++column) {
      const int x = left + glyph.left + column;
      if (x < 0 || x >= image.width()) continue;
      const std::uint8_t coverage =
          glyph.coverage[static_cast<std::size_t>(row) * static_cast<std::size_t>(glyph.width) +
                         static_cast<std::size_t>(column)];
      if (coverage == 0 || isCovered(writing, x, y)) continue;
      const float share = writing.colour.w() * static_cast<float>(coverage) / 255.0F;
      Rgb& pixel = image.at(x, y);
      pixel = {mixed(pixel.red, writing.colour.x(), share),
               mixed(pixel.green, writing.colour.y(), share),
               mixed(pixel.blue, writing.colour.z(), share)};
    }
  }
}

}  // namespace

const Glyph& Scribe::glyph(const Key& key) {
  const auto found = glyphs_.find(key);
  if (found != glyphs_.end()) return found->second;
  if (glyphs_.size() >= mostGlyphs) glyphs_.clear();
  const auto& [letter, size, place] = key;
  return glyphs_.emplace(key, glyphOf(letter, size, static_cast<double>(place) / places))
      .first->second;
}

void Scribe::write(const std::vector<Writing>& writings, Image& image) {
  for (const Writing& writing : writings) {
    double pen = writing.start.x();
    const int baseline = static_cast<int>(std::lround(writing.start.y()));
    for (const char32_t letter : lettersOf(writing.line)) {
      const auto quarters = static_cast<int>(std::floor(pen * places));
      const int left = static_cast<int>(std::floor(pen));
      stamp(glyph({letter, writing.size, quarters - left * places}), left, baseline, writing,
            image);
      pen += advanceOf(letter) * writing.size / emHeight;
    }
  }
}

}  // namespace bumper::drawing
