#include "nearby_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bumper {

namespace {

// How far the region goes beyond the reach, m: on all sides, and ahead by what the vehicle passes
// in this time, s, but no further than that.
constexpr double allAround = 0.5;
constexpr double timeAhead = 0.2;
constexpr double mostAhead = 6.0;

// What is left of a wall that leans lies in the rectangle around its part in the band.
constexpr double aroundCorner = 1.4143;

}  // namespace

bool NearbyWalls::covers(const WallQuery& query, const VehicleState& state, double reach) const {
  if (!isKnown_) return false;
  const Eigen::Vector3d moved = axes_.transpose() * (state.massCentre - centre_);
  const double turned = query.radius() * (state.axes - axes_).norm();
  const double needed = reach + query.lean() + turned;
  return moved.x() + needed <= margins_.front && -moved.x() + needed <= margins_.rear &&
         std::abs(moved.y()) + needed <= margins_.side &&
         std::abs(moved.z()) + turned <= margins_.height;
}

void NearbyWalls::list(WallQuery& query, const std::vector<std::unique_ptr<Barrier>>& barriers,
                       const VehicleState& state, double reach) {
  centre_ = state.massCentre;
  axes_ = state.axes;
  // One that spins turns out of the region before it has passed through it.
  const double spin = std::abs(state.yawRate) * 1.5 * query.radius();
  const double time = std::min(timeAhead, allAround / std::max(spin, 1e-9));
  const double way =
      std::clamp(time * state.axes.col(0).dot(state.velocity), -mostAhead, mostAhead);
  const double needed = reach + query.lean() + allAround;
  margins_ = {.front = needed + std::max(way, 0.0),
              .rear = needed + std::max(-way, 0.0),
              .side = needed,
              .height = allAround};
  const double radius =
      query.radius() + std::max(margins_.front, margins_.rear) + margins_.side + margins_.height;
  walls_.clear();
  for (const std::unique_ptr<Barrier>& barrier : barriers) {
    if (barrier == nullptr || barrier->clearanceAtLeast(centre_, radius) > radius) continue;
    if (barrier->mesh() == nullptr) {
      walls_.push_back(
          {.of = {.barrier = barrier.get(), .wall = 0},
           .wall = {.corners = {centre_, centre_, centre_}, .normal = Eigen::Vector3d::Zero()},
           .centre = centre_,
           .radius = std::numeric_limits<double>::infinity(),
           .offset = 0.0});
      continue;
    }
    for (const int number : query.list(*barrier->mesh(), state, margins_)) {
      const Wall wall = barrier->mesh()->walls()[static_cast<std::size_t>(number)];
      const auto& corners = wall.corners;
      const Eigen::Vector3d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
      const Eigen::Vector3d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
      walls_.push_back({.of = {.barrier = barrier.get(), .wall = number},
                        .wall = wall,
                        .centre = 0.5 * (low + high),
                        .radius = aroundCorner * 0.5 * (high - low).norm(),
                        .offset = wall.normal.dot(corners[0])});
    }
  }
  isKnown_ = true;
}

// Whether all of the outline's reach, over the band, lies on one side of the wall's plane.
bool NearbyWalls::isBeyondPlane(const WallQuery& query, const VehicleState& state, const Near& near,
                                double reach) {
  const Outline& outline = query.outline();
  const Eigen::Vector3d normal = state.axes.transpose() * near.wall.normal;
  const Eigen::Vector3d middle = query.middle();
  const double across =
      std::abs(near.offset - near.wall.normal.dot(state.massCentre) - normal.dot(middle));
  // Twice the band's height: what leans stands out from its line.
  const double half = std::abs(normal.x()) * (0.5 * (outline.front + outline.rear) + reach) +
                      std::abs(normal.y()) * (outline.halfWidth + reach) +
                      std::abs(normal.z()) * 2.0 * query.lean();
  return across > half + 1e-9;
}

void NearbyWalls::collect(WallQuery& query, const std::vector<std::unique_ptr<Barrier>>& barriers,
                          const VehicleState& state, double reach,
                          std::vector<WallSegment>& segments) {
  if (!covers(query, state, reach)) list(query, barriers, state, reach);
  const Outline& outline = query.outline();
  const Eigen::Vector3d forward = state.axes.col(0);
  const Eigen::Vector3d left = state.axes.col(1);
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Near& near = walls_[i];
    const Eigen::Vector3d away = near.centre - state.massCentre;
    const double x = forward.dot(away);
    const double most = near.radius + reach;
    if (x > outline.front + most || -x > outline.rear + most) continue;
    if (std::abs(left.dot(away)) > outline.halfWidth + most) continue;
    if (isBeyondPlane(query, state, near, reach)) continue;
    if (auto segment = query.cut(*near.of.barrier, near.of.wall, near.wall, state, reach)) {
      segment->id = static_cast<int>(i);
      segments.push_back(*segment);
    }
  }
}

}  // namespace bumper
