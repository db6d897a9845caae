#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

/// Numbers for people to read.
namespace bumper::doctor {

/// With so many decimals.
std::string fixed(double value, int decimals);

/// m as "5.0 mm".
std::string millimetres(double metres);

/// "1 slide", "2 slides", or with a plural of its own.
std::string counted(std::size_t count, const std::string& noun, const std::string& plural = "");

/// m as "12.0, -3.5, 0.6".
std::string placeText(const Eigen::Vector3d& place);

}  // namespace bumper::doctor
