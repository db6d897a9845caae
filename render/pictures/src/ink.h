#pragma once

#include "picture.h"

namespace bumper::drawing {

// Colours that mean the same in every kind of picture.

inline const Colour ink(0.09F, 0.10F, 0.14F, 1.0F);   ///< letters and lines
inline const Colour mark(0.87F, 0.00F, 0.47F, 1.0F);  ///< impacts

}  // namespace bumper::drawing
