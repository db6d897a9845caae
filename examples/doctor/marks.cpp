#include "marks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bumper::doctor {

namespace {

std::uint8_t blended(std::uint8_t below, std::uint8_t above, double share) {
  return static_cast<std::uint8_t>(std::lround(below + share * (above - below)));
}

}  // namespace

void drawLine(Image& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour,
              double width) {
  if (!from.allFinite() || !to.allFinite()) return;
  const double margin = 0.5 * width + 1.0;
  const auto range = [&](double a, double b, int size) {
    const auto limited = [&](double v) { return static_cast<int>(std::clamp(v, 0.0, 1.0 * size)); };
    return std::pair(limited(std::floor(std::min(a, b) - margin)),
                     limited(std::ceil(std::max(a, b) + margin)));
  };
  const auto [left, right] = range(from.x(), to.x(), image.width());
  const auto [top, bottom] = range(from.y(), to.y(), image.height());
  const Eigen::Vector2d way = to - from;
  const double length2 = std::max(way.squaredNorm(), 1e-12);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const Eigen::Vector2d offset = Eigen::Vector2d(x + 0.5, y + 0.5) - from;
      const double along = std::clamp(offset.dot(way) / length2, 0.0, 1.0);
      const double share = std::clamp(0.5 * width + 0.5 - (offset - along * way).norm(), 0.0, 1.0);
      if (share <= 0.0) continue;
      Rgb& pixel = image.at(x, y);
      pixel = {blended(pixel.red, colour.red, share), blended(pixel.green, colour.green, share),
               blended(pixel.blue, colour.blue, share)};
    }
  }
}

void drawArrow(Image& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour,
               double width) {
  drawLine(image, from, to, colour, width);
  const Eigen::Vector2d way = to - from;
  if (way.norm() < 1.0) return;
  const Eigen::Vector2d back = -way.normalized() * std::min(4.0 * width, 0.5 * way.norm());
  const Eigen::Vector2d aside(-0.5 * back.y(), 0.5 * back.x());
  drawLine(image, to, to + back + aside, colour, width);
  drawLine(image, to, to + back - aside, colour, width);
}

}  // namespace bumper::doctor
