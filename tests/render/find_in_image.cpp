#include "find_in_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bumper::testing {

namespace {

using Eigen::Vector2d;

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

bool isMarkColour(const Rgb& pixel) {
  return pixel.red > 200 && pixel.green < 30 && pixel.blue > 90 && pixel.blue < 150;
}

bool isPaint(const Rgb& pixel) {
  return pixel.red > 90 && pixel.green < 0.35 * pixel.red && pixel.blue < 0.35 * pixel.red;
}

std::vector<Patch> findPatches(const Image& image, const ColourTest& belongs) {
  std::vector<char> open(image.pixels().size());
  std::ranges::transform(image.pixels(), open.begin(),
                         [&](const Rgb& pixel) { return static_cast<char>(belongs(pixel)); });
  const int width = image.width();
  std::vector<Patch> patches;
  for (std::size_t start = 0; start < open.size(); ++start) {
    if (open[start] == 0) continue;
    Patch patch;
    std::vector<std::size_t> next = {start};
    open[start] = 0;
    while (!next.empty()) {
      const std::size_t place = next.back();
      next.pop_back();
      const int x = static_cast<int>(place) % width;
      const int y = static_cast<int>(place) / width;
      patch.pixels.emplace_back(x + 0.5, y + 0.5);
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, image.height() - 1); ++j) {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
          const auto beside = static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(i);
          if (open[beside] == 0) continue;
          open[beside] = 0;
          next.push_back(beside);
        }
      }
    }
    for (const Vector2d& pixel : patch.pixels) patch.centroid += pixel;
    patch.centroid /= static_cast<double>(patch.pixels.size());
    patches.push_back(std::move(patch));
  }
  return patches;
}

Hull hullOf(const std::vector<Vector2d>& points) {
  std::vector<Vector2d> sorted = points;
  std::ranges::sort(sorted, [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Hull hull;
  auto& corners = hull.corners;
  const auto addChain = [&](auto begin, auto end) {
    const std::size_t first = corners.size();
    for (auto point = begin; point != end; ++point) {
      while (corners.size() >= first + 2 &&
             turn(corners[corners.size() - 2], corners.back(), *point) <= 0.0)
        corners.pop_back();
      corners.push_back(*point);
    }
    corners.pop_back();
  };
  addChain(sorted.begin(), sorted.end());
  addChain(sorted.rbegin(), sorted.rend());

  // Moments of the area, triangle by triangle.
  double area = 0.0;
  Vector2d first = Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  const Vector2d origin = corners.front();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Vector2d a = corners[k] - origin;
    const Vector2d b = corners[k + 1] - origin;
    const double part = 0.5 * (a.x() * b.y() - a.y() * b.x());
    area += part;
    first += part * (a + b) / 3.0;
    second += part / 12.0 * (a * a.transpose() + b * b.transpose() + (a + b) * (a + b).transpose());
  }
  const Vector2d centroid = first / area;
  const Eigen::Matrix2d spread = second / area - centroid * centroid.transpose();
  hull.centroid = origin + centroid;
  hull.direction = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  return hull;
}

}  // namespace bumper::testing
