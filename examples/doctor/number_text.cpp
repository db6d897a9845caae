#include "number_text.h"

#include <array>
#include <cstdio>

namespace bumper::doctor {

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string millimetres(double metres) { return fixed(1000.0 * metres, 1) + " mm"; }

std::string counted(std::size_t count, const std::string& noun, const std::string& plural) {
  if (count == 1) return "1 " + noun;
  return std::to_string(count) + " " + (plural.empty() ? noun + "s" : plural);
}

std::string placeText(const Eigen::Vector3d& place) {
  return fixed(place.x(), 2) + ", " + fixed(place.y(), 2) + ", " + fixed(place.z(), 2);
}

}  // namespace bumper::doctor
