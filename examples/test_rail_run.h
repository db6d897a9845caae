#pragma once

#include "bumper/render/recording.h"
#include "bumper/response/response_settings.h"
#include "bumper/scenes/scene.h"

namespace bumper::examples {

/// The paper's drive in the test rail: from the origin along +x at 60 mph, steering straight, four
/// seconds in steps of 5 ms (Eq. 38).
Recording runTestRail(const Scene& scene, const ResponseSettings& settings);

}  // namespace bumper::examples
