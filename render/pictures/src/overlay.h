#pragma once

#include <string>

#include "bumper/render/snapshot.h"
#include "camera.h"
#include "picture.h"
#include "run_excerpt.h"

namespace bumper::drawing {

/// What lies over the drawn world: title, legend, scale bar, impact marks and their labels.
void addOverlay(const Camera& camera, const RunExcerpt& run, const SnapshotOptions& options,
                const std::string& title, Picture& picture);

/// The speed at the upper end of the legend, m/s.
double legendEnd(const RunExcerpt& run);

}  // namespace bumper::drawing
