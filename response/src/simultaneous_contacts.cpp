#include "simultaneous_contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace bumper {

namespace {

// A motion as a point of the space in which half the mass times the square is the kinetic energy;
// the motions that do not approach at a point form a half-space.
using Motion = Eigen::Vector3d;

}  // namespace

PlanarImpulse endApproach(const PlanarMotion& motion, double mass, double yawInertia,
                          std::span<const TouchingPoint> points) {
  const double radius = std::sqrt(yawInertia / mass);
  const Motion before(motion.velocity.x(), motion.velocity.y(), radius * motion.yawRate);
  std::array<Motion, mostTouchingPoints> ways;
  const std::size_t count = std::min(points.size(), mostTouchingPoints);
  for (std::size_t i = 0; i < count; ++i) {
    const TouchingPoint& point = points[i];
    ways[i] = Motion(point.normal.x(), point.normal.y(), cross(point.arm, point.normal) / radius);
    ways[i].normalize();
  }
  const double tolerance = 1e-12 * before.norm();
  const auto approachesNowhere = [&](const Motion& candidate) {
    return std::all_of(ways.begin(), ways.begin() + count,
                       [&](const Motion& way) { return way.dot(candidate) >= -tolerance; });
  };

  // The nearest point of a cone lies on it, on one of its faces, on one of its edges, or at its
  // tip: try all that are there, the one that keeps most energy is the nearest.
  Motion best = Motion::Zero();
  const auto consider = [&](const Motion& candidate) {
    if (candidate.squaredNorm() > best.squaredNorm() && approachesNowhere(candidate)) {
      best = candidate;
    }
  };
  consider(before);
  for (std::size_t i = 0; i < count; ++i) {
    consider(before - ways[i].dot(before) * ways[i]);
    for (std::size_t k = i + 1; k < count; ++k) {
      const Motion edge = ways[i].cross(ways[k]);
      if (edge.squaredNorm() < 1e-20) continue;
      consider(edge.dot(before) / edge.squaredNorm() * edge);
    }
  }
  const Motion change = best - before;
  return {.linear = mass * change.head<2>(), .angular = yawInertia / radius * change.z()};
}

}  // namespace bumper
