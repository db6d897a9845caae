#include "end_approach.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace bumper {

namespace {

// A motion as a point of the space in which half the mass times the square is the kinetic energy;
// the motions that do not approach at a point form a half-space.
using Motion = Eigen::Vector3d;

// Fraction of the initial motion that counts as rounding.
constexpr double noApproach = 1e-12;

// Directions that span less than this are taken as one: between walls that close on a vehicle no
// motion is possible, or one far faster than theirs.
constexpr double parallel = 0.1;

// A few rounds find the active directions; more would only follow rounding.
constexpr int mostRounds = 64;

/// Active directions and their weights, so that no direction approaches: non-negative least
/// squares, after Lawson and Hanson. The active directions are linearly independent.
class Stop {
 public:
  /// `least` is how far along each direction the motion must go at least: 0 for fixed walls.
  Stop(const Motion& before, std::span<const Motion> all, std::span<const double> least)
      : before_(before), all_(all), least_(least) {
    double longest = before.norm();
    for (const double each : least) {
      anyMoves_ |= each != 0.0;
      longest = std::max(longest, std::abs(each));
    }
    const double tolerance = noApproach * longest;
    for (int round = 0; round < mostRounds; ++round) {
      const Motion now = after();
      std::size_t fastest = 0;
      const auto speed = [&](std::size_t i) { return all[i].dot(now) - least[i]; };
      for (std::size_t i = 1; i < all.size(); ++i) {
        if (speed(i) < speed(fastest)) fastest = i;
      }
      if (count_ == mostCarryingPoints || all.empty() || speed(fastest) >= -tolerance) return;
      which_[count_] = fastest;
      far_[count_++] = 0.0;
      balance();
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t which(std::size_t i) const { return which_[i]; }
  [[nodiscard]] double far(std::size_t i) const { return far_[i]; }

  /// The remaining motion, without approach along the active directions.
  [[nodiscard]] Motion after() const {
    if (!anyMoves_) return remaining(before_);
    const Motion walls = motionOfWalls();
    return walls + remaining(before_ - walls);
  }

 private:
  // What is left of a motion if those directions have to be at right angles to it.
  [[nodiscard]] Motion remaining(const Motion& motion) const {
    switch (count_) {
      case 0:
        return motion;
      case 1:
        return motion - way(0).dot(motion) * way(0);
      case 2: {
        // At right angles to both, however narrow the wedge between them.
        const Motion across = (way(1) - way(1).dot(way(0)) * way(0)).normalized();
        const Motion edge = way(0).cross(across);
        return edge.dot(motion) / edge.squaredNorm() * edge;
      }
      default:
        return Motion::Zero();
    }
  }

  [[nodiscard]] Eigen::Matrix3d ways() const {
    Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < count_; ++i) result.col(static_cast<Eigen::Index>(i)) = way(i);
    return result;
  }

  // The shortest motion that goes along with all walls of the active directions.
  [[nodiscard]] Motion motionOfWalls() const {
    Motion speeds = Motion::Zero();
    for (std::size_t i = 0; i < count_; ++i) {
      speeds[static_cast<Eigen::Index>(i)] = least_[which_[i]];
    }
    return ways()
        .transpose()
        .jacobiSvd(Eigen::ComputeFullU | Eigen::ComputeFullV)
        .setThreshold(parallel)
        .solve(speeds);
  }

  [[nodiscard]] const Motion& way(std::size_t i) const { return all_[which_[i]]; }

  // Solves for no approach along all active directions; drops those whose weight would be negative.
  void balance() {
    while (count_ > 0) {
      const Motion relative = anyMoves_ ? Motion(before_ - motionOfWalls()) : before_;
      const Motion wanted = ways().colPivHouseholderQr().solve(-relative);
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
  std::span<const double> least_;
  bool anyMoves_ = false;
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
  std::array<double, mostTouchingPoints> least;
  for (std::size_t i = 0; i < count; ++i) {
    const Motion way = wayOf(points[i]);
    ways[i] = way.normalized();
    least[i] = points[i].wallSpeed / way.norm();
  }

  const Stop stop(before, std::span(ways.data(), count), std::span(least.data(), count));
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
