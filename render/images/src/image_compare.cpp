#include "bumper/render/image_compare.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "bumper/response/error.h"

namespace bumper {

namespace {

constexpr int tileSide = 32;

struct Range {
  std::array<int, 3> low{255, 255, 255};
  std::array<int, 3> high{0, 0, 0};
};

std::array<int, 3> channels(const Rgb& pixel) { return {pixel.red, pixel.green, pixel.blue}; }

/// Every pixel the mean of those around it, as far as the picture goes.
Image smoothed(const Image& image, int radius) {
  if (radius == 0) return image;
  Image result(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    const int top = std::max(y - radius, 0);
    const int bottom = std::min(y + radius, image.height() - 1);
    for (int x = 0; x < image.width(); ++x) {
      const int left = std::max(x - radius, 0);
      const int right = std::min(x + radius, image.width() - 1);
      std::array<int, 3> sum{};
      for (int j = top; j <= bottom; ++j) {
        for (int i = left; i <= right; ++i) {
          const auto pixel = channels(image.at(i, j));
          for (std::size_t k = 0; k < 3; ++k) sum[k] += pixel[k];
        }
      }
      const int count = (right - left + 1) * (bottom - top + 1);
      const auto mean = [&](std::size_t k) {
        return static_cast<std::uint8_t>((sum[k] + count / 2) / count);
      };
      result.at(x, y) = {mean(0), mean(1), mean(2)};
    }
  }
  return result;
}

Range rangeAround(const Image& image, int x, int y, int reach) {
  Range range;
  const int right = std::min(x + reach, image.width() - 1);
  const int bottom = std::min(y + reach, image.height() - 1);
  for (int j = std::max(y - reach, 0); j <= bottom; ++j) {
    for (int i = std::max(x - reach, 0); i <= right; ++i) {
      const auto pixel = channels(image.at(i, j));
      for (std::size_t k = 0; k < 3; ++k) {
        range.low[k] = std::min(range.low[k], pixel[k]);
        range.high[k] = std::max(range.high[k], pixel[k]);
      }
    }
  }
  return range;
}

bool isOutside(const Rgb& pixel, const Range& range, int tolerance) {
  const auto value = channels(pixel);
  for (std::size_t k = 0; k < 3; ++k) {
    if (value[k] < range.low[k] - tolerance || value[k] > range.high[k] + tolerance) return true;
  }
  return false;
}

Rgb paleGrey(const Rgb& pixel) {
  const int mean = (pixel.red + pixel.green + pixel.blue) / 3;
  const auto grey = static_cast<std::uint8_t>(170 + mean / 4);
  return {grey, grey, grey};
}

template <typename Number>
void requireRange(Number value, int high, const char* name) {
  if (value >= 0 && value <= high) return;
  throw Error(std::string("ImageCompareOptions::") + name + " is " + std::to_string(value) +
              ": it must lie in 0 to " + std::to_string(high));
}

}  // namespace

ImageComparison compareImages(const Image& first, const Image& second,
                              const ImageCompareOptions& options) {
  requireRange(options.tolerance, 255, "tolerance");
  requireRange(options.smoothing, 8, "smoothing");
  requireRange(options.reach, 8, "reach");
  requireRange(options.mostDiffering, 1, "mostDiffering");
  requireRange(options.mostDifferingInTile, 1, "mostDifferingInTile");
  const int width = first.width();
  const int height = first.height();
  if (width == 0 || height == 0) throw Error("cannot compare images without pixels");
  if (second.width() != width || second.height() != height) {
    throw Error("cannot compare an image of " + std::to_string(width) + " x " +
                std::to_string(height) + " pixels with one of " + std::to_string(second.width()) +
                " x " + std::to_string(second.height()) + ": the sizes must be the same");
  }

  const Image firstMeans = smoothed(first, options.smoothing);
  const Image secondMeans = smoothed(second, options.smoothing);
  ImageComparison result{.difference = Image(width, height)};
  const int tilesAcross = (width + tileSide - 1) / tileSide;
  const int tilesDown = (height + tileSide - 1) / tileSide;
  std::vector<int> differingInTile(
      static_cast<std::size_t>(tilesAcross) * static_cast<std::size_t>(tilesDown), 0);
  long differing = 0;
  long sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto a = channels(first.at(x, y));
      const auto b = channels(second.at(x, y));
      int worst = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        worst = std::max(worst, std::abs(a[k] - b[k]));
        sum += std::abs(a[k] - b[k]);
      }
      result.worstDifference = std::max(result.worstDifference, worst);
      const Rgb& meanA = firstMeans.at(x, y);
      const Rgb& meanB = secondMeans.at(x, y);
      const bool differs =
          isOutside(meanA, {channels(meanB), channels(meanB)}, options.tolerance) &&
          (isOutside(meanA, rangeAround(secondMeans, x, y, options.reach), options.tolerance) ||
           isOutside(meanB, rangeAround(firstMeans, x, y, options.reach), options.tolerance));
      result.difference.at(x, y) = differs ? Rgb{220, 0, 30} : paleGrey(first.at(x, y));
      if (!differs) continue;
      ++differing;
      const int tile = y / tileSide * tilesAcross + x / tileSide;
      ++differingInTile[static_cast<std::size_t>(tile)];
    }
  }

  const double pixels = static_cast<double>(width) * height;
  result.differingShare = static_cast<double>(differing) / pixels;
  result.meanDifference = static_cast<double>(sum) / (3.0 * pixels);
  result.worstTileShare =
      static_cast<double>(std::ranges::max(differingInTile)) / (tileSide * tileSide);
  result.isSame = result.differingShare <= options.mostDiffering &&
                  result.worstTileShare <= options.mostDifferingInTile;
  return result;
}

}  // namespace bumper
