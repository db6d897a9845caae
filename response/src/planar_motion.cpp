#include "bumper/response/planar_motion.h"

#include <cmath>
#include <utility>

namespace bumper {

Vector2 rotated(const Vector2& v, double angle) {
  if (angle == 0.0) return v;  // often, and dear otherwise
  return Placement(Vector2::Zero(), angle).turned(v);
}

Placement::Placement(Vector2 itsPosition, double yaw) : position(std::move(itsPosition)) {
  if (yaw == 0.0) return;  // often, and dear otherwise
  cosine = std::cos(yaw);
  sine = std::sin(yaw);
}

PlanarMotion advanced(PlanarMotion motion, double time) {
  motion.position += time * motion.velocity;
  motion.yaw += time * motion.yawRate;
  return motion;
}

bool isFinite(const PlanarMotion& motion) {
  return motion.position.allFinite() && motion.velocity.allFinite() && std::isfinite(motion.yaw) &&
         std::isfinite(motion.yawRate);
}

}  // namespace bumper
