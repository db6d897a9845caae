#include "ground_below.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "ground_probes.h"

namespace bumper {

namespace {

/// Ground must go on for so far around a wall, m: a vehicle that meets it from beyond has wheels
/// there.
constexpr double ringWidth = 1.5;

/// Places under a wall's sides are no further apart than this, m, and no more than so many.
constexpr double spacing = 2.0;
constexpr int mostPlaces = 64;

/// Of what is smaller than this, m, one place is enough.
constexpr double small = 0.5;

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Narrow pieces carry a vehicle where they cover so large a part of a disc of this radius, m, with
/// steps no higher than this, m. Planks with joints as wide as themselves do, a beam of 0.7 m does
/// not.
constexpr double discRadius = 0.7;
constexpr double leastShare = 0.4;
constexpr double mostStep = 0.3;

constexpr double diagonal = 0.5 * std::numbers::sqrt2;
const std::array<Vector2, 8> directions{Vector2(1.0, 0.0),  Vector2(diagonal, diagonal),
                                        Vector2(0.0, 1.0),  Vector2(-diagonal, diagonal),
                                        Vector2(-1.0, 0.0), Vector2(-diagonal, -diagonal),
                                        Vector2(0.0, -1.0), Vector2(diagonal, -diagonal)};

double heightAt(const TriangleCorners& triangle, const Vector2& place) {
  const Eigen::Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  return heightOfPlane(triangle[0], normal, place);
}

double planArea(const TriangleCorners& triangle) {
  return 0.5 * std::abs(cross((triangle[1] - triangle[0]).head<2>(),
                              (triangle[2] - triangle[0]).head<2>()));
}

Eigen::AlignedBox3d column(const Vector2& place, double low, double high) {
  return {Eigen::Vector3d(place.x(), place.y(), low), Eigen::Vector3d(place.x(), place.y(), high)};
}

/// Where ground carries a vehicle that may meet a wall.
Eigen::AlignedBox3d withinReach(const Wall& wall, const GroundReach& reach) {
  Eigen::AlignedBox3d box = boxOf(wall.corners);
  box.max().z() = std::max(box.max().z(), wall.top) + reach.below;
  box.min().z() -= reach.above;
  return box;
}

/// Finds roughly what is near walls.
class NearWalls {
 public:
  NearWalls(const std::vector<Wall>& walls, const GroundReach& reach, double distance)
      : heights_(std::max(distance, 1.0)) {
    for (const Wall& wall : walls) {
      Eigen::AlignedBox3d box = withinReach(wall, reach);
      box.min().head<2>().array() -= distance;
      box.max().head<2>().array() += distance;
      isEverywhere_ = isEverywhere_ || !heights_.forCells(box, mostCells, [&](const auto& cell) {
        heights_.at(cell).first.extend(Vector1(box.min().z()));
        heights_.at(cell).first.extend(Vector1(box.max().z()));
      });
    }
  }

  /// `atHeight`: only what is as high as ground that carries a vehicle to the walls.
  [[nodiscard]] bool mayReach(const Eigen::AlignedBox3d& box, bool atHeight) const {
    bool reaches = isEverywhere_;
    const Heights own(Vector1(box.min().z()), Vector1(box.max().z()));
    const bool isSmall = reaches || heights_.forCells(box, mostCells, [&](const auto& cell) {
      const Heights* heights = heights_.find(cell);
      reaches = reaches || (heights != nullptr && (!atHeight || heights->intersects(own)));
    });
    return reaches || !isSmall;
  }

 private:
  using Vector1 = Eigen::Matrix<double, 1, 1>;
  using Heights = Eigen::AlignedBox1d;
  static constexpr std::int64_t mostCells = 256;

  PlanGrid<Heights> heights_;
  bool isEverywhere_ = false;
};

}  // namespace

GroundBelow::GroundBelow(const Scene& scene, const std::vector<FlatTriangle>& flat,
                         const GroundReach& reach, const std::vector<Wall>& walls)
    : reach_(reach) {
  const double distance = std::max(reach.distance, ringWidth) + discRadius;
  const NearWalls near(walls, reach, distance);
  visits_ = maxVisits * (flat.size() + 4 * walls.size());
  std::vector<TriangleCorners> narrow;
  std::vector<Eigen::AlignedBox3d> wideBoxes;
  std::vector<Eigen::AlignedBox3d> narrowBoxes;
  for (const FlatTriangle& each : flat) {
    const TriangleCorners corners = cornersOf(scene, scene.triangles[each.triangle]);
    const Eigen::AlignedBox3d box = boxOf(corners);
    if (!near.mayReach(box, !each.wide)) continue;
    (each.wide ? wide_ : narrow).push_back(corners);
    (each.wide ? wideBoxes : narrowBoxes).push_back(box);
  }
  wideTree_.emplace(wideBoxes);
  const BoxTree narrowTree(narrowBoxes);
  // Pieces that are next to one another carry alike.
  std::map<std::array<std::int64_t, 3>, bool> known;
  std::vector<Eigen::AlignedBox3d> carriers;
  for (std::size_t i = 0; i < narrow.size(); ++i) {
    const Eigen::Vector3d middle = (narrow[i][0] + narrow[i][1] + narrow[i][2]) / 3.0;
    std::array<std::int64_t, 3> block;
    for (int axis = 0; axis < 3; ++axis) {
      block.at(static_cast<std::size_t>(axis)) =
          static_cast<std::int64_t>(std::floor(middle[axis] / mostStep));
    }
    const auto [entry, isNew] = known.try_emplace(block, false);
    if (isNew) entry->second = carries(narrow[i], narrowTree, narrow);
    if (entry->second) carriers.push_back(narrowBoxes[i]);
  }
  carrierTree_.emplace(carriers);
}

template <typename Visit>
void GroundBelow::search(const BoxTree& tree, const Eigen::AlignedBox3d& box, double distance,
                         const Visit& visit) {
  const auto enter = [&](double /*distance2*/, double /*low*/, double /*high*/) {
    if (visits_ == 0) return false;
    --visits_;
    return true;
  };
  tree.search(box, distance, enter, visit);
}

bool GroundBelow::isProvenFor(const Wall& wall) {
  bool isOnNarrow = false;
  search(*carrierTree_, withinReach(wall, reach_), reach_.distance,
         [&](std::uint32_t) { isOnNarrow = true; });
  return !isOnNarrow && isSurrounded(wall) && visits_ > 0;
}

// Whether wide ground lies under a place, below a height; as under the middle of its cell.
bool GroundBelow::isCovered(const Vector2& place, double height) {
  const auto cell = lowest_.cellOf(place.x(), place.y());
  const auto [lowest, isNew] = lowest_.at(cell);
  if (isNew) {
    const Vector2 middle = lowest_.middleOf(cell);
    double found = nowhere;
    search(*wideTree_, column(middle, -1e30, 1e30), 0.0, [&](std::uint32_t i) {
      if (covers(wide_[i], middle)) found = std::min(found, heightAt(wide_[i], middle));
    });
    lowest = found;
  }
  return lowest < height;
}

bool GroundBelow::isSurrounded(const Wall& wall) {
  const Eigen::AlignedBox3d box = boxOf(wall.corners);
  const double lowest = box.min().z();
  const auto isSurroundedAt = [&](const Vector2& place) {
    if (!isCovered(place, lowest)) return false;
    return std::all_of(directions.begin(), directions.end(), [&](const Vector2& direction) {
      return isCovered(place + ringWidth * direction, lowest);
    });
  };
  if (box.diagonal().head<2>().norm() < small) return isSurroundedAt(box.center().head<2>());
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2 from = wall.corners[k].head<2>();
    const Vector2 along = wall.corners[(k + 1) % 3].head<2>() - from;
    const int places =
        std::clamp(static_cast<int>(std::ceil(along.norm() / spacing)), 1, mostPlaces);
    for (int i = 0; i < places; ++i) {
      if (!isSurroundedAt(from + (static_cast<double>(i) / places) * along)) return false;
    }
  }
  return true;
}

// Whether a narrow piece and its neighbours cover enough of a disc.
bool GroundBelow::carries(const TriangleCorners& narrow, const BoxTree& narrowTree,
                          const std::vector<TriangleCorners>& others) {
  const Vector2 middle = (narrow[0] + narrow[1] + narrow[2]).head<2>() / 3.0;
  const double height = heightAt(narrow, middle);
  const Eigen::AlignedBox3d here = column(middle, height - mostStep, height + mostStep);
  std::vector<const TriangleCorners*> near;
  search(narrowTree, here, discRadius, [&](std::uint32_t i) { near.push_back(&others[i]); });
  search(*wideTree_, here, discRadius, [&](std::uint32_t i) { near.push_back(&wide_[i]); });
  double area = 0.0;
  for (const TriangleCorners* each : near) area += planArea(*each);
  if (area < leastShare * std::numbers::pi * discRadius * discRadius) return visits_ == 0;
  int covered = 0;
  for (const double radius : {0.5 * discRadius, discRadius}) {
    for (const Vector2& direction : directions) {
      const Vector2 place = middle + radius * direction;
      const bool isHere = std::any_of(near.begin(), near.end(), [&](const TriangleCorners* each) {
        return covers(*each, place);
      });
      covered += isHere ? 1 : 0;
    }
  }
  return covered >= leastShare * 2.0 * static_cast<double>(directions.size()) || visits_ == 0;
}

}  // namespace bumper
