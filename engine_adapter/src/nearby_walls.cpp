#include "nearby_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bumper {

namespace {

// How far the region goes beyond the reach, m: on all sides, and ahead by what the vehicle passes
// in this time, s, but no further than that.
constexpr double allAround = 1.0;
constexpr double timeAhead = 0.2;
constexpr double mostAhead = 6.0;

// Walls lie in one plane within these.
constexpr double sameOffset = 1e-9;    // m
constexpr double sameNormal2 = 1e-26;  // of the difference's square

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
  sheets_.clear();
  lastWithin_ = 0;
  for (const std::unique_ptr<Barrier>& barrier : barriers) {
    if (barrier == nullptr || barrier->clearanceAtLeast(centre_, radius) > radius) continue;
    if (barrier->mesh() == nullptr) {
      walls_.push_back(
          {.of = {.barrier = barrier.get(), .wall = 0},
           .wall = {.corners = {centre_, centre_, centre_}, .normal = Eigen::Vector3d::Zero()},
           .centre = centre_,
           .radius = std::numeric_limits<double>::infinity(),
           .sheet = sheetOf(
               {.corners = {centre_, centre_, centre_}, .normal = Eigen::Vector3d::Zero()})});
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
                        .sheet = sheetOf(wall)});
    }
  }
  isKnown_ = true;
}

// The number of the plane that a wall lies in.
std::size_t NearbyWalls::sheetOf(const Wall& wall) {
  const double offset = wall.normal.dot(wall.corners[0] - centre_);
  const auto same = std::find_if(sheets_.begin(), sheets_.end(), [&](const Sheet& sheet) {
    return (sheet.normal - wall.normal).squaredNorm() <= sameNormal2 &&
           std::abs(sheet.offset - offset) <= sameOffset;
  });
  if (same != sheets_.end()) return static_cast<std::size_t>(same - sheets_.begin());
  sheets_.push_back({.normal = wall.normal, .offset = offset, .isBeyond = false});
  return sheets_.size() - 1;
}

// Finds the planes that have all of a rectangle, over the band, on one side.
void NearbyWalls::lookAtSheets(const WallQuery& query, const VehicleState& state,
                               const PlanRectangle& around) {
  const Eigen::Vector3d middle(around.middle.x(), around.middle.y(), query.middleHeight());
  const Eigen::Vector3d place = state.massCentre - centre_ + state.axes * middle;
  for (Sheet& sheet : sheets_) {
    const Eigen::Vector3d normal = state.axes.transpose() * sheet.normal;
    // Twice the band's height: what leans stands out from its line.
    const double half = std::abs(normal.x()) * around.half.x() +
                        std::abs(normal.y()) * around.half.y() +
                        std::abs(normal.z()) * 2.0 * query.lean();
    sheet.isBeyond = std::abs(sheet.offset - sheet.normal.dot(place)) > half + 2.0 * sameOffset;
  }
}

// Whether a wall may be in the rectangle whose planes were looked at last.
bool NearbyWalls::mayMeet(const Near& near, const VehicleState& state,
                          const PlanRectangle& around) const {
  if (sheets_[near.sheet].isBeyond) return false;
  const Eigen::Vector3d away = near.centre - state.massCentre;
  const double x = state.axes.col(0).dot(away) - around.middle.x();
  if (std::abs(x) > around.half.x() + near.radius) return false;
  const double y = state.axes.col(1).dot(away) - around.middle.y();
  return std::abs(y) <= around.half.y() + near.radius;
}

bool NearbyWalls::anyMayMeet(const WallQuery& query, const VehicleState& state,
                             const PlanRectangle& around) {
  lookAtSheets(query, state, around);
  return std::any_of(walls_.begin(), walls_.end(),
                     [&](const Near& near) { return mayMeet(near, state, around); });
}

bool NearbyWalls::anyWithin(const WallQuery& query, const VehicleState& state, double reach) {
  const PlanRectangle around = query.outline().enlarged(reach);
  lookAtSheets(query, state, around);
  const auto isWithin = [&](const Near& near) {
    return mayMeet(near, state, around) &&
           query.cut(*near.of.barrier, near.of.wall, near.wall, state, reach).has_value();
  };
  if (lastWithin_ < walls_.size() && isWithin(walls_[lastWithin_])) return true;
  const auto found = std::find_if(walls_.begin(), walls_.end(), isWithin);
  lastWithin_ = static_cast<std::size_t>(found - walls_.begin());
  return found != walls_.end();
}

bool NearbyWalls::collect(WallQuery& query, const std::vector<std::unique_ptr<Barrier>>& barriers,
                          const VehicleState& state, const Question& question,
                          std::vector<WallSegment>& segments) {
  const double reach = question.reach;
  if (!covers(query, state, reach)) list(query, barriers, state, reach);
  if (!question.evenIfNoneIsTouched && !anyMayMeet(query, state, question.swept)) {
    return anyWithin(query, state, reach);
  }
  const PlanRectangle around = query.outline().enlarged(reach);
  lookAtSheets(query, state, around);
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Near& near = walls_[i];
    if (!mayMeet(near, state, around)) continue;
    if (auto segment = query.cut(*near.of.barrier, near.of.wall, near.wall, state, reach)) {
      segment->id = static_cast<int>(i);
      segments.push_back(*segment);
    }
  }
  return !segments.empty();
}

}  // namespace bumper
