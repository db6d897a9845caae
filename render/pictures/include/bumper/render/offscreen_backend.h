#pragma once

#include <vector>

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

/// The library that draws without a window. Both are parts of Mesa and need no graphics card; EGL
/// uses one if it finds one.
enum class OffscreenBackend {
  automatic,  ///< OSMesa if bumper was built with it and it works here, else EGL
  osmesa,     ///< until Mesa 25.0
  egl         ///< without a surface: EGL_MESA_platform_surfaceless
};

/// Those that bumper was built with, without `automatic`, the preferred first.
std::vector<OffscreenBackend> builtBackends();

}  // namespace bumper
