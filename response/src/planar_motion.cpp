#include "bumper/response/planar_motion.h"

#include <cmath>

namespace bumper {

Vector2 rotated(const Vector2& v, double angle) {
  if (angle == 0.0) return v;  // often, and dear otherwise
  return Placement(Vector2::Zero(), angle).turned(v);
}

Placement::Placement(const Vector2& itsPosition, double yaw) : position(itsPosition) {
  if (yaw == 0.0) return;  // often, and dear otherwise
  cosine = std::cos(yaw);
  sine = std::sin(yaw);
}

PlanarMotion afterImpulse(PlanarMotion motion, const PlanarImpulse& impulse, double mass,
                          double yawInertia) {
  motion.velocity += impulse.linear / mass;
  motion.yawRate += impulse.angular / yawInertia;
  return motion;
}

double yawPlaneEnergy(const PlanarMotion& motion, double mass, double yawInertia) {
  return 0.5 * mass * motion.velocity.squaredNorm() +
         0.5 * yawInertia * motion.yawRate * motion.yawRate;
}

bool isFinite(const PlanarMotion& motion) {
  return motion.position.allFinite() && motion.velocity.allFinite() && std::isfinite(motion.yaw) &&
         std::isfinite(motion.yawRate);
}

}  // namespace bumper
