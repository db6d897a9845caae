#pragma once

#include "bumper/render/image.h"
#include "offscreen_context.h"
#include "picture.h"

namespace bumper::drawing {

/// Draws a picture with four samples per pixel. Throws Error if the driver fails or the size lies
/// beyond its limits.
Image rasterise(const Picture& picture, OffscreenContext& context);

}  // namespace bumper::drawing
