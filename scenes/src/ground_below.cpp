#include "ground_below.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ground_probes.h"

namespace bumper {

namespace {

/// Ground must go on for so far around a wall, m: a vehicle that meets it from beyond has wheels
/// there.
constexpr double around = 1.5;

/// Places under a wall's sides are no further apart than this, m, and no more than so many.
constexpr double spacing = 2.0;
constexpr int mostPlaces = 64;

/// The ground under all places of a cell of this size, m, is looked for once.
constexpr double cellSize = 0.25;
constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Narrow pieces carry a vehicle where they cover so large a part of a disc of this radius, m, with
/// steps no higher than this, m. Planks with joints as wide as themselves do, a beam of 0.7 m does
/// not.
constexpr double discRadius = 0.7;
constexpr double leastShare = 0.4;
constexpr double mostStep = 0.3;

constexpr double degrees45 = 0.25 * std::numbers::pi;

Vector2 towards(int direction) {
  return {std::cos(degrees45 * direction), std::sin(degrees45 * direction)};
}

double heightAt(const TriangleCorners& triangle, const Vector2& place) {
  const Eigen::Vector3d normal = upwardNormal(triangle);
  return heightOfPlane(triangle[0], normal, place);
}

Eigen::AlignedBox3d column(const Vector2& place, double low, double high) {
  return {Eigen::Vector3d(place.x(), place.y(), low), Eigen::Vector3d(place.x(), place.y(), high)};
}

}  // namespace

GroundBelow::GroundBelow(const Scene& scene, const std::vector<FlatTriangle>& flat,
                         const GroundReach& reach, const std::vector<Wall>& walls)
    : reach_(reach) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(walls.size());
  for (const Wall& wall : walls) {
    Eigen::AlignedBox3d box = boxOf(wall.corners);
    box.min().z() = -1e30;
    box.max().z() = 1e30;
    boxes.push_back(box);
  }
  const BoxTree near(boxes);
  const double distance = std::max(reach.distance, around) + discRadius;
  boxes.clear();
  for (const FlatTriangle& each : flat) {
    const TriangleCorners corners = cornersOf(scene, scene.triangles[each.triangle]);
    const Eigen::AlignedBox3d box = boxOf(corners);
    bool isNear = false;
    near.search(
        box, distance, [&](double, double, double) { return !isNear; },
        [&](std::uint32_t) { isNear = true; });
    if (!isNear) continue;
    surfaces_.push_back({.corners = corners, .wide = each.wide, .carries = {}});
    boxes.push_back(box);
  }
  tree_.emplace(boxes);
  visits_ = maxVisits * (surfaces_.size() + 4 * walls.size());
}

template <typename Visit>
void GroundBelow::forSurfaces(const Eigen::AlignedBox3d& box, double distance, const Visit& visit) {
  const auto enter = [&](double /*distance2*/, double /*low*/, double /*high*/) {
    if (visits_ == 0) return false;
    --visits_;
    return true;
  };
  tree_->search(box, distance, enter, [&](std::uint32_t i) { visit(surfaces_[i]); });
}

bool GroundBelow::isProvenFor(const Wall& wall) {
  return isSurrounded(wall) && !hasNarrowGround(wall) && visits_ > 0;
}

// Whether wide ground lies under a place, below a height; as under the middle of its cell.
bool GroundBelow::isCovered(const Vector2& place, double height) {
  const auto cell = [](double coordinate) {
    return static_cast<std::int64_t>(std::floor(coordinate / cellSize));
  };
  const std::int64_t x = cell(place.x());
  const std::int64_t y = cell(place.y());
  const auto [known, isNew] = lowest_.try_emplace({x, y}, nowhere);
  if (isNew) {
    const Vector2 middle(cellSize * (static_cast<double>(x) + 0.5),
                         cellSize * (static_cast<double>(y) + 0.5));
    double& lowest = known->second;
    forSurfaces(column(middle, -1e30, 1e30), 0.0, [&](const Surface& surface) {
      if (surface.wide && covers(surface.corners, middle)) {
        lowest = std::min(lowest, heightAt(surface.corners, middle));
      }
    });
  }
  return known->second < height;
}

bool GroundBelow::isSurrounded(const Wall& wall) {
  const double lowest = boxOf(wall.corners).min().z();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2 from = wall.corners[k].head<2>();
    const Vector2 along = wall.corners[(k + 1) % 3].head<2>() - from;
    const int places =
        std::clamp(static_cast<int>(std::ceil(along.norm() / spacing)), 1, mostPlaces);
    for (int i = 0; i < places; ++i) {
      const Vector2 place = from + (static_cast<double>(i) / places) * along;
      if (!isCovered(place, lowest)) return false;
      for (int direction = 0; direction < 8; ++direction) {
        if (!isCovered(place + around * towards(direction), lowest)) return false;
      }
    }
  }
  return true;
}

bool GroundBelow::hasNarrowGround(const Wall& wall) {
  Eigen::AlignedBox3d box = boxOf(wall.corners);
  box.max().z() = std::max(box.max().z(), wall.top) + reach_.below;
  box.min().z() -= reach_.above;
  bool found = false;
  forSurfaces(box, reach_.distance,
              [&](Surface& surface) { found = found || (!surface.wide && carries(surface)); });
  return found;
}

bool GroundBelow::carries(Surface& surface) {
  if (surface.carries) return *surface.carries;
  const Vector2 middle =
      (surface.corners[0] + surface.corners[1] + surface.corners[2]).head<2>() / 3.0;
  const double height = heightAt(surface.corners, middle);
  int covered = 0;
  int places = 0;
  for (const double radius : {0.5 * discRadius, discRadius}) {
    for (int direction = 0; direction < 8; ++direction) {
      const Vector2 place = middle + radius * towards(direction);
      bool here = false;
      forSurfaces(column(place, height - mostStep, height + mostStep), 0.0,
                  [&](const Surface& other) { here = here || covers(other.corners, place); });
      covered += here ? 1 : 0;
      ++places;
    }
  }
  surface.carries = covered >= leastShare * places;
  return *surface.carries;
}

}  // namespace bumper
