#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "border.h"
#include "bumper/engine_adapter/responder.h"
#include "enumerations.h"
#include "struct_size.h"

/// From C to C++: each throws Error, with the name of the value, if it is not valid. Ranges that
/// the library checks itself are left to it.
namespace bumper::c_api {

/// Larger numbers are mistakes, and products of a few of them would not be finite.
inline constexpr double largestNumber = 1e15;

void requireNumber(const Name& name, double value);

inline void read(const Name& name, double from, double& to) {
  requireNumber(name, from);
  to = from;
}

void read(const Name& name, std::int32_t from, bool& to);
void read(const Name& name, const bumper_angle_curve& from, AngleCurve& to);

/// Throws Error unless 0 <= value < count.
void requireEnumerator(const Name& name, std::int32_t value, int count);

template <Enumeration E>
void read(const Name& name, std::int32_t from, E& to) {
  requireEnumerator(name, from, countOf<E>);
  to = static_cast<E>(from);
}

template <int n>
void read(const Name& name, const double (&from)[n], Eigen::Matrix<double, n, 1>& to) {
  for (int i = 0; i < n; ++i) read({.text = "", .of = &name, .index = i}, from[i], to[i]);
}

inline void read(const Name& /*name*/, const char* from, std::string& to) {
  to = from != nullptr ? from : "";
}

inline void read(const Name& /*name*/, const char* from, std::string_view& to) {
  to = from != nullptr ? from : "";
}

inline void read(const Name& /*name*/, dSpaceID from, dSpaceID& to) { to = from; }
inline void read(const Name& /*name*/, dGeomID from, dGeomID& to) { to = from; }

inline void read(const Name& name, const bumper_band& from, Band& to) {
  read({"bottom", &name}, from.bottom, to.bottom);
  read({"top", &name}, from.top, to.top);
}

/// An array of at most `most` things.
void requireArray(const Name& name, const void* first, std::size_t count, std::size_t most);

}  // namespace bumper::c_api
