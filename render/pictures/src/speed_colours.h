#pragma once

#include <Eigen/Core>

#include "bumper/base/api.h"

namespace BUMPER_INTERNAL bumper {
namespace drawing {

/// A colour for a share from 0 (slow) to 1 (fast), from deep indigo through teal and green to
/// yellow: ever lighter, so that the order survives in grey and for the colour-blind.
Eigen::Vector3f speedColour(double share);

/// The smallest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not less than a
/// value.
double roundedUp(double value);

/// The largest of 1, 2, 5 times a power of ten that is not more than a value; value > 0.
double roundedDown(double value);

}  // namespace drawing
}  // namespace bumper
