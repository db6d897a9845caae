#include "end_approach.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace bumper {

namespace {

// A motion as a point of the space in which half the mass times the square is the kinetic energy;
// the motions that do not approach at a point form a half-space.
using Motion = Eigen::Vector3d;

// Fraction of the initial motion that counts as rounding.
constexpr double noApproach = 1e-12;

// A few rounds find the active directions; more would only follow rounding.
constexpr int mostRounds = 64;

/// Active directions and their weights, so that no direction approaches: non-negative least
/// squares, after Lawson and Hanson. The active directions are linearly independent.
class Stop {
 public:
  Stop(const Motion& before, std::span<const Motion> all) : before_(before), all_(all) {
    const double tolerance = noApproach * before.norm();
    for (int round = 0; round < mostRounds; ++round) {
      const Motion now = after();
      const auto fastest = std::min_element(
          all.begin(), all.end(),
          [&](const Motion& a, const Motion& b) { return a.dot(now) < b.dot(now); });
      if (count_ == mostCarryingPoints || fastest == all.end() || fastest->dot(now) >= -tolerance) {
        return;
      }
      which_[count_] = static_cast<std::size_t>(fastest - all.begin());
      far_[count_++] = 0.0;
      balance();
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t which(std::size_t i) const { return which_[i]; }
  [[nodiscard]] double far(std::size_t i) const { return far_[i]; }

  /// The remaining motion, without approach along the active directions.
  [[nodiscard]] Motion after() const {
    switch (count_) {
      case 0:
        return before_;
      case 1:
        return before_ - way(0).dot(before_) * way(0);
      case 2: {
        // At right angles to both, however narrow the wedge between them.
        const Motion across = (way(1) - way(1).dot(way(0)) * way(0)).normalized();
        const Motion edge = way(0).cross(across);
        return edge.dot(before_) / edge.squaredNorm() * edge;
      }
      default:
        return Motion::Zero();
    }
  }

 private:
  [[nodiscard]] const Motion& way(std::size_t i) const { return all_[which_[i]]; }

  // Solves for no approach along all active directions; drops those whose weight would be negative.
  void balance() {
    while (count_ > 0) {
      Eigen::Matrix3d ways = Eigen::Matrix3d::Zero();
      for (std::size_t i = 0; i < count_; ++i) ways.col(static_cast<Eigen::Index>(i)) = way(i);
      const Motion wanted = ways.colPivHouseholderQr().solve(-before_);
      double share = 1.0;
      std::size_t first = count_;
      for (std::size_t i = 0; i < count_; ++i) {
        const double goal = wanted[static_cast<Eigen::Index>(i)];
        if (goal > 0.0) continue;
        const double until = far_[i] > 0.0 ? far_[i] / (far_[i] - goal) : 0.0;
        if (first == count_ || until < share) {
          share = until;
          first = i;
        }
      }
      for (std::size_t i = 0; i < count_; ++i) {
        far_[i] += share * (wanted[static_cast<Eigen::Index>(i)] - far_[i]);
      }
      if (first == count_) return;
      --count_;
      for (std::size_t i = first; i < count_; ++i) {
        which_[i] = which_[i + 1];
        far_[i] = far_[i + 1];
      }
    }
  }

  Motion before_;
  std::span<const Motion> all_;
  std::array<std::size_t, mostCarryingPoints> which_{};
  std::array<double, mostCarryingPoints> far_{};
  std::size_t count_ = 0;
};

}  // namespace

SharedImpulse endApproach(const PlanarBody& body, std::span<const TouchingPoint> points) {
  const auto& [mass, yawInertia, motion] = body;
  const double radius = std::sqrt(yawInertia / mass);
  const Motion before(motion.velocity.x(), motion.velocity.y(), radius * motion.yawRate);
  std::array<Motion, mostTouchingPoints> ways;
  const auto wayOf = [radius](const TouchingPoint& point) {
    return Motion(point.normal.x(), point.normal.y(), cross(point.arm, point.normal) / radius);
  };
  const std::size_t count = std::min(points.size(), mostTouchingPoints);
  for (std::size_t i = 0; i < count; ++i) ways[i] = wayOf(points[i]).normalized();

  const Stop stop(before, std::span(ways.data(), count));
  const Motion change = stop.after() - before;
  SharedImpulse result;
  result.sum = {.linear = mass * change.head<2>(), .angular = yawInertia / radius * change.z()};
  for (std::size_t i = 0; i < stop.count(); ++i) {
    const std::size_t point = stop.which(i);
    result.shares[result.count++] = {.point = point,
                                     .impulse = mass * stop.far(i) / wayOf(points[point]).norm()};
  }
  return result;
}

}  // namespace bumper
