#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <string_view>
#include <vector>

namespace bumper::drawing {

/// Heights in the font's own units; a picture draws them a few times larger.
constexpr double capitalHeight = 9.0;  ///< from the top of a line to the baseline

/// The rectangles that a line of text is made of, in the font's units from its upper left corner,
/// y down. Other letters than printable ASCII become '?', one for each character.
std::vector<Eigen::AlignedBox2d> textBoxes(std::string_view line);

/// In the font's units.
double textWidth(std::string_view line);

/// A number with a point and a fixed number of decimals, whatever the locale; never "-0".
std::string fixed(double value, int decimals);

}  // namespace bumper::drawing
