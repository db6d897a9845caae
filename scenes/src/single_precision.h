#pragma once

namespace bumper {

/// Turning a number into single precision changes it by no more than this part of it.
inline constexpr double singlePrecisionRounding = 1.2e-7;

}  // namespace bumper
