#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bumper/engine_adapter/responder.h"
#include "enumerations.h"

/// From C++ to C: defaults, events and what is asked for.
namespace bumper::c_api {

inline void write(double from, double& to) { to = from; }
inline void write(bool from, std::int32_t& to) { to = from ? 1 : 0; }
inline void write(int from, std::int32_t& to) { to = from; }
inline void write(std::size_t from, std::uint64_t& to) { to = from; }

template <Enumeration E>
void write(E from, std::int32_t& to) {
  to = static_cast<std::int32_t>(from);
}

/// Of a table's points none are written: no default and no preset has one.
inline void write(const AngleCurve& from, bumper_angle_curve& to) {
  static_assert(isSame(BUMPER_CURVE_COSINE, AngleCurve::Shape::cosine) &&
                isSame(BUMPER_CURVE_HALF_COSINE, AngleCurve::Shape::half_cosine) &&
                isSame(BUMPER_CURVE_TABLE, AngleCurve::Shape::table));
  to = {.shape = static_cast<std::int32_t>(from.shape()),
        .point_count = 0,
        .grazing = from.grazing(),
        .head_on = from.headOn(),
        .points = nullptr};
}

/// A name that is there: the views are of whole strings, which end with a zero byte.
inline void write(std::string_view from, const char*& to) {
  to = from.data() != nullptr ? from.data() : "";
}

/// The default of an option's name.
inline void write(const std::string& /*from*/, const char*& to) { to = nullptr; }

template <int n>
void write(const Eigen::Matrix<double, n, 1>& from, double (&to)[n]) {
  for (int i = 0; i < n; ++i) to[i] = from[i];
}

inline void write(const Eigen::Quaterniond& from, double (&to)[4]) {
  to[0] = from.w();
  to[1] = from.x();
  to[2] = from.y();
  to[3] = from.z();
}

/// Pointers of options: null is their default.
template <typename Cpp, typename Pointee>
void write(const Cpp& /*from*/, Pointee*& to) {
  to = nullptr;
}

}  // namespace bumper::c_api
