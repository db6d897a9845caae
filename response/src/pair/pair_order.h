#pragma once

#include <array>

#include "bumper/response/planar_body.h"

namespace bumper {

/// Whether one body comes before another, by where it is and how it moves, then by what it is: the
/// order in which a computation takes them, whoever asks. Bodies alike in all have none.
inline bool comesBefore(const PlanarBody& a, const PlanarBody& b) {
  const auto key = [](const PlanarBody& body) {
    const PlanarMotion& motion = body.motion;
    return std::array<double, 8>{motion.position.x(), motion.position.y(), motion.yaw,
                                 motion.velocity.x(), motion.velocity.y(), motion.yawRate,
                                 body.mass,           body.yawInertia};
  };
  return key(a) < key(b);
}

}  // namespace bumper
