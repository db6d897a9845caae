#pragma once

#include <map>
#include <tuple>

#include "bumper/render/image.h"
#include "picture.h"
#include "text.h"

namespace bumper::drawing {

/// Writes into images, and keeps the letters that it has drawn for the next.
class Scribe {
 public:
  void write(const std::vector<Writing>& writings, Image& image);

 private:
  /// Letters stand at quarters of a pixel.
  static constexpr int places = 4;
  /// Letter, size in pixels, place.
  using Key = std::tuple<char32_t, double, int>;

  const Glyph& glyph(const Key& key);

  std::map<Key, Glyph> glyphs_;
};

}  // namespace bumper::drawing
