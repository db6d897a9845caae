#include "wall_face.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bumper {

namespace {

// Corners this close are the same, and lie in one plane or line, m.
constexpr double tolerance = 1e-9;

// Faces up to here are steep: |vertical component of the normal|, just above the usual limit.
constexpr double steepNormal = 0.301;

// A strip is so many times as long as it is wide, and rises by no more than this for each metre.
constexpr double leastSlenderness = 2.0;
constexpr double mostSlope = 0.35;

bool areSame(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a - b).squaredNorm() <= tolerance * tolerance;
}

}  // namespace

WallFace::WallFace(const Wall& wall) : count_(3), normal_(wall.normal) {
  std::copy(wall.corners.begin(), wall.corners.end(), corners_.begin());
  along_ = Eigen::Vector3d::UnitZ().cross(normal_).normalized();
  const auto [first, last] =
      std::minmax({along_.dot(corners_[0]), along_.dot(corners_[1]), along_.dot(corners_[2])});
  start_ = first;
  end_ = last;
}

bool WallFace::add(const Wall& wall) {
  // The same winding, so that what is in front stays in front.
  if (wall.normal.dot(normal_) <= 0.0) return false;
  for (const Eigen::Vector3d& corner : wall.corners) {
    if (std::abs(normal_.dot(corner - corners_[0])) > tolerance) return false;
    const double place = along_.dot(corner);
    if (place < start_ - tolerance || place > end_ + tolerance) return false;
  }
  for (std::size_t side = 0; side < count_; ++side) {
    const Eigen::Vector3d& from = corners_[side];
    const Eigen::Vector3d& to = corners_[(side + 1) % count_];
    for (std::size_t k = 0; k < 3; ++k) {
      // Of the same winding, it runs along the side the other way.
      if (!areSame(wall.corners[k], to) || !areSame(wall.corners[(k + 1) % 3], from)) continue;
      return addCorner(wall.corners[(k + 2) % 3], side);
    }
  }
  return false;
}

// Puts a corner between the ends of a side, outside of it.
bool WallFace::addCorner(const Eigen::Vector3d& corner, std::size_t side) {
  // How far a corner is on the outer side of the line between its neighbours.
  const auto standsOut = [&](const Eigen::Vector3d& before, const Eigen::Vector3d& middle,
                             const Eigen::Vector3d& after) {
    const Eigen::Vector3d line = after - before;
    return normal_.dot((middle - before).cross(line)) / line.norm();
  };
  const auto at = [&](std::size_t k) -> const Eigen::Vector3d& { return corners_[k % count_]; };
  const double atStart = standsOut(at(side + count_ - 1), at(side), corner);
  const double atEnd = standsOut(corner, at(side + 1), at(side + 2));
  if (atStart < -tolerance || atEnd < -tolerance) return false;
  std::array<Eigen::Vector3d, mostCorners> kept;
  std::size_t count = 0;
  const auto keep = [&](const Eigen::Vector3d& each) {
    if (count < mostCorners) kept[count] = each;
    ++count;
  };
  for (std::size_t k = 0; k < count_; ++k) {
    // The side's ends are no longer corners where the outline is straight.
    const bool isStart = k == side;
    const bool isEnd = k == (side + 1) % count_;
    const bool goesStraightOn = (isStart && atStart <= tolerance) || (isEnd && atEnd <= tolerance);
    if (!goesStraightOn) keep(corners_[k]);
    if (isStart) keep(corner);
  }
  if (count > mostCorners) return false;
  corners_ = kept;
  count_ = count;
  return true;
}

double WallFace::diameter() const {
  double most = 0.0;
  for (const Eigen::Vector3d& a : corners()) {
    for (const Eigen::Vector3d& b : corners()) most = std::max(most, (a - b).norm());
  }
  return most;
}

std::optional<Strip> stripOf(const WallFace& face) {
  if (std::abs(face.normal().z()) <= steepNormal) return std::nullopt;
  const std::span<const Eigen::Vector3d> corners = face.corners();
  Eigen::Vector3d side = Eigen::Vector3d::Zero();
  std::size_t begin = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector3d each = corners[(k + 1) % corners.size()] - corners[k];
    if (each.squaredNorm() <= side.squaredNorm()) continue;
    side = each;
    begin = k;
  }
  Strip strip{.direction = side.normalized(), .width = 0.0};
  for (const Eigen::Vector3d& corner : corners) {
    strip.width = std::max(strip.width, (corner - corners[begin]).cross(strip.direction).norm());
  }
  if (std::abs(strip.direction.z()) > mostSlope || side.norm() < leastSlenderness * strip.width) {
    return std::nullopt;
  }
  return strip;
}

}  // namespace bumper
