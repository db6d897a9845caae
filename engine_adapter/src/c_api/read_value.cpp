#include "read_value.h"

#include <sstream>
#include <utility>
#include <vector>

namespace bumper::c_api {

namespace {

constexpr std::size_t mostCurvePoints = 65536;

std::string inWords(double value) {
  std::ostringstream words;
  words << value;
  return words.str();
}

}  // namespace

void requireNumber(const Name& name, double value) {
  if (std::abs(value) <= largestNumber) return;
  refuse(name, "is " + inWords(value) + ": it must be finite and at most " +
                   inWords(largestNumber) + " in magnitude");
}

void read(const Name& name, std::int32_t from, bool& to) {
  if (from != 0 && from != 1) refuse(name, "is " + std::to_string(from) + ": it must be 0 or 1");
  to = from == 1;
}

void requireEnumerator(const Name& name, std::int32_t value, int count) {
  if (value >= 0 && value < count) return;
  refuse(name,
         "is " + std::to_string(value) + ": it must be one of 0 to " + std::to_string(count - 1));
}

void requireArray(const Name& name, const void* first, std::size_t count, std::size_t most) {
  if (count > most) {
    refuse(name, "has " + std::to_string(count) + " elements: at most " + std::to_string(most) +
                     " may be");
  }
  if (first == nullptr && count > 0) refuse(name, "is null, but has a count above 0");
}

void read(const Name& name, const bumper_angle_curve& from, AngleCurve& to) {
  requireEnumerator({"shape", &name}, from.shape, BUMPER_CURVE_TABLE + 1);
  double grazing = 0.0;
  double headOn = 0.0;
  if (from.shape != BUMPER_CURVE_TABLE) {
    if (from.point_count != 0) refuse({"point_count", &name}, "is not 0, but the shape no table");
    read({"grazing", &name}, from.grazing, grazing);
    read({"head_on", &name}, from.head_on, headOn);
    to = from.shape == BUMPER_CURVE_COSINE ? AngleCurve::cosine(grazing, headOn)
                                           : AngleCurve::halfCosine(grazing, headOn);
    return;
  }
  const Name points{"points", &name};
  requireArray(points, from.points, from.point_count, mostCurvePoints);
  std::vector<std::pair<double, double>> table(from.point_count);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto index = static_cast<std::int64_t>(2 * i);
    read({"points", &name, index}, from.points[2 * i], table[i].first);
    read({"points", &name, index + 1}, from.points[2 * i + 1], table[i].second);
  }
  to = AngleCurve::table(std::move(table));
}

}  // namespace bumper::c_api
