#include "text.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb_truetype.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "bumper/response/error.h"

extern const unsigned char bumperFontFile[];  // NOLINT(*-avoid-c-arrays): the file's bytes

namespace bumper::drawing {

namespace {

class Font {
 public:
  Font() {
    if (stbtt_InitFont(&info_, bumperFontFile, 0) == 0)
      throw Error("the font that bumper was built with is no TrueType font");
    perEm_ = stbtt_ScaleForMappingEmToPixels(&info_, 1.0F);
  }

  [[nodiscard]] bool has(char32_t letter) const { return indexOf(letter) != 0; }

  [[nodiscard]] double advance(char32_t letter) const {
    int advance = 0;
    stbtt_GetGlyphHMetrics(&info_, indexOf(letter), &advance, nullptr);
    return emHeight * advance * static_cast<double>(perEm_);
  }

  [[nodiscard]] Glyph glyph(char32_t letter, double size, double share) const {
    const float scale = perEm_ * static_cast<float>(size);
    const auto shift = static_cast<float>(share);
    const int index = indexOf(letter);
    int right = 0;
    int bottom = 0;
    Glyph glyph;
    stbtt_GetGlyphBitmapBoxSubpixel(&info_, index, scale, scale, shift, 0.0F, &glyph.left,
                                    &glyph.top, &right, &bottom);
    glyph.width = right - glyph.left;
    glyph.height = bottom - glyph.top;
    glyph.coverage.resize(static_cast<std::size_t>(glyph.width) *
                          static_cast<std::size_t>(glyph.height));
    if (!glyph.coverage.empty()) {
      stbtt_MakeGlyphBitmapSubpixel(&info_, glyph.coverage.data(), glyph.width, glyph.height,
                                    glyph.width, scale, scale, shift, 0.0F, index);
    }
    return glyph;
  }

 private:
  [[nodiscard]] int indexOf(char32_t letter) const {
    return stbtt_FindGlyphIndex(&info_, static_cast<int>(letter));
  }

  stbtt_fontinfo info_{};
  float perEm_ = 0.0F;
};

const Font& font() {
  static const Font instance;
  return instance;
}

}  // namespace

std::u32string lettersOf(std::string_view line) {
  std::u32string letters;
  for (std::size_t k = 0; k < line.size();) {
    const auto lead = static_cast<unsigned char>(line[k++]);
    if (lead >= 0x80 && lead < 0xC0) continue;  // what is left of a broken letter
    const int rest = lead < 0x80 ? 0 : lead < 0xE0 ? 1 : lead < 0xF0 ? 2 : 3;
    auto letter = static_cast<char32_t>(rest == 0 ? lead : lead & (0x3FU >> rest));
    int read = 0;
    for (; read < rest && k < line.size(); ++read, ++k) {
      const auto next = static_cast<unsigned char>(line[k]);
      if ((next & 0xC0U) != 0x80U) break;
      letter = (letter << 6U) | (next & 0x3FU);
    }
    const bool printable = read == rest && letter >= U' ' && letter != 0x7F && font().has(letter);
    letters += printable ? letter : U'?';
  }
  return letters;
}

double advanceOf(char32_t letter) { return font().advance(letter); }

double textWidth(std::string_view line) {
  double width = 0.0;
  for (const char32_t letter : lettersOf(line)) width += advanceOf(letter);
  return width;
}

Glyph glyphOf(char32_t letter, double size, double share) {
  return font().glyph(letter, size, share);
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
