#pragma once

#include <cstddef>

#include "bumper/base/api.h"
#include "bumper/render/image.h"
#include "bumper/render/offscreen_backend.h"
#include "bumper/render/recording.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

struct CloseUpOptions {
  int width = 1280;  ///< pixels, 640 to 8192 and what the driver allows
  int height = 720;  ///< pixels, 360 to 8192 and what the driver allows
};

/// A diagram of one impact from above, in the manner of the paper's Figures 1, 2, 3 and 5, with its
/// numbers beside: the vehicle's outline as it hits, the walls of the scene, the wall's normal N
/// and the tangent T = z × N, the vehicle's axes i and j, the arms x (along N) and y (along T) from
/// the mass centre to the contact point, the impulse on the vehicle, and the mass centre's velocity
/// before and after. A second drawing magnifies the contact: a and b, where the wall enters and
/// leaves the outline, and the midpoint between them, at which the impulse acts. Where outline and
/// wall only touch, a and b are one point.
///
/// Of two vehicles both outlines are drawn in their paints, with both velocities, the opposite
/// impulses, and the overlap that both reach in the default penetration time, carried back by the
/// mean of their motions; numbers of both. One that was not recorded then is only named.
///
/// World x points right and y up. The outline stands where the impact's arm puts it, with the
/// heading that was recorded at its time. A velocity before that is not known is the one after
/// without what the impulse added.
///
/// `impact` is the impact's index in the recording. Throws Error if there is no such impact, if its
/// vehicle was not recorded at its time, on an invalid scene, on a size outside its range, or if
/// the driver fails.
Image impactCloseUp(const Scene& scene, const Recording& recording, std::size_t impact,
                    const CloseUpOptions& options = {},
                    OffscreenBackend backend = OffscreenBackend::automatic);

}  // namespace bumper
