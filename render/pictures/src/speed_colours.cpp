#include "speed_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bumper::drawing {

Eigen::Vector3f speedColour(double share) {
  static const std::array<Eigen::Vector3f, 7> anchors = {
      Eigen::Vector3f(0.16F, 0.06F, 0.36F), Eigen::Vector3f(0.24F, 0.20F, 0.58F),
      Eigen::Vector3f(0.13F, 0.41F, 0.62F), Eigen::Vector3f(0.07F, 0.58F, 0.56F),
      Eigen::Vector3f(0.25F, 0.74F, 0.42F), Eigen::Vector3f(0.65F, 0.86F, 0.22F),
      Eigen::Vector3f(1.00F, 0.92F, 0.30F)};
  const double place = std::clamp(share, 0.0, 1.0) * (anchors.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  const auto part = static_cast<float>(place - static_cast<double>(k));
  return (1.0F - part) * anchors[k] + part * anchors[k + 1];
}

double roundedUp(double value) {
  if (!(value > 0.0)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    // A hair of slack: 30.000000001 m/s fits a scale that ends at 30.
    if (factor * power * (1.0 + 1e-6) >= value) return factor * power;
  }
  return 10.0 * power;
}

double roundedDown(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= value) return factor * power;
  }
  return power;
}

}  // namespace bumper::drawing
