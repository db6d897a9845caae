#pragma once

#include "bumper/response/outline.h"
#include "bumper/response/planar_body.h"

namespace bumper {

/// One of two vehicles, in the plane in which they meet.
struct PairBody {
  PlanarBody body;
  Outline outline{VehicleParameters{}};

  [[nodiscard]] Placement placementAfter(double time) const {
    const PlanarMotion& motion = body.motion;
    return {motion.position + time * motion.velocity, motion.yaw + time * motion.yawRate};
  }
};

}  // namespace bumper
