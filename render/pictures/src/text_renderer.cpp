#include "text_renderer.h"

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

bool isCovered(const TextLine& line, int x, int y) {
  return std::ranges::any_of(line.covered, [&](const Eigen::AlignedBox2d& area) {
    return area.contains(Eigen::Vector2d(x + 0.5, y + 0.5));
  });
}

}  // namespace

const Glyph& TextRenderer::glyph(const Key& key) {
  const auto found = glyphs_.find(key);
  if (found != glyphs_.end()) return found->second;
  if (glyphs_.size() >= mostGlyphs) glyphs_.clear();
  const auto& [letter, size, place] = key;
  return glyphs_.emplace(key, glyphOf(letter, size, static_cast<double>(place) / places))
      .first->second;
}

void TextRenderer::write(const std::vector<TextLine>& textLines, Image& image) {
  for (const TextLine& line : textLines) {
    double pen = line.start.x();
    const int baseline = static_cast<int>(std::lround(line.start.y()));
    for (const char32_t letter : lettersOf(line.text)) {
      const auto quarters = static_cast<int>(std::floor(pen * places));
      const int left = static_cast<int>(std::floor(pen));
      const Glyph& drawn = glyph({letter, line.size, quarters - left * places});
      blendGlyph(drawn, left, baseline, image,
                 [&](Rgb& pixel, std::uint8_t coverage, int x, int y) {
                   if (isCovered(line, x, y)) return;
                   const float share = line.colour.w() * static_cast<float>(coverage) / 255.0F;
                   pixel = {mixed(pixel.red, line.colour.x(), share),
                            mixed(pixel.green, line.colour.y(), share),
                            mixed(pixel.blue, line.colour.z(), share)};
                 });
      pen += advanceOf(letter) * line.size / emHeight;
    }
  }
}

}  // namespace bumper::drawing
