// What stands at the foot of a wall?
//
// A triangle whose middle is near a taller wall in plan, and that reaches no further away from it.
// Of those that a vehicle could drive on it remains to be seen whether they are a ledge or the
// ground: their plane is followed to the nearest place that is out of reach of such walls, and is
// ground if the scene goes on there.

#include "bumper/scenes/wall_feet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "box_tree.h"
#include "bumper/response/planar_motion.h"
#include "weld.h"

namespace bumper {

namespace {

/// How much higher than a foot, m, a wall must be.
constexpr double minRise = 0.05;

/// A wall that is taller than this, m, is no foot, wherever it stands.
constexpr double maxFootHeight = 1.0;

/// What is steeper than 45° carries no vehicle.
constexpr double minGroundNormalUp = 0.707;

/// Ground bends by less than 15°, and steps by no more than this, m, where it goes on.
constexpr double minAlignment = 0.966;
constexpr double maxStep = 0.03;

/// How far beyond the reach of walls, m, one looks whether ground goes on.
constexpr double beyondReach = 0.02;

/// A place closer to a wall than this, m, lies on neither of its sides.
constexpr double onWall = 1e-3;

/// Where the reach of so many walls, one after the other, does not end, all is taken for ground.
constexpr int maxWallsLeft = 4;

/// Steps of a search, on average for each triangle: bounds the time that meshes take whose
/// triangles lie one upon another. What is not found out by then is no foot.
constexpr std::size_t maxVisits = 256;

using Triangle = std::array<Eigen::Vector3d, 3>;

Box boxOf(const Triangle& triangle) {
  return {triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]),
          triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2])};
}

Vector2 middleOf(const Triangle& triangle) {
  return (triangle[0] + triangle[1] + triangle[2]).head<2>() / 3.0;
}

Vector2 nearestOf(const Vector2& from, const Vector2& to, const Vector2& point) {
  const Vector2 along = to - from;
  const double length2 = along.squaredNorm();
  const double share =
      length2 > 0.0 ? std::clamp((point - from).dot(along) / length2, 0.0, 1.0) : 0.0;
  return from + share * along;
}

/// The nearest point to another in plan; of a wall that leans one of its edges' is near enough.
Vector2 nearestOf(const Triangle& wall, const Vector2& point) {
  Vector2 nearest = wall[0].head<2>();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2 each = nearestOf(wall[k].head<2>(), wall[(k + 1) % 3].head<2>(), point);
    if ((each - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = each;
  }
  return nearest;
}

/// Walls that are tall enough, and stand low enough, to have a certain foot.
struct Heights {
  double minTop;
  double maxFoot;
};

Heights heightsAbove(double top) { return {.minTop = top + minRise, .maxFoot = top + footReach}; }

/// The walls in reach of a place.
struct Surroundings {
  std::size_t nearestWall = 0;
  Vector2 nearest = Vector2::Zero();
  double squaredDistance = std::numeric_limits<double>::infinity();
  double foot = std::numeric_limits<double>::infinity();  // of all of them
  double top = -std::numeric_limits<double>::infinity();
};

class WallTree {
 public:
  explicit WallTree(const std::vector<Wall>& walls) : walls_(walls), tree_(boxesOf(walls)) {}

  [[nodiscard]] std::optional<Surroundings> around(const Vector2& place, const Heights& heights) {
    Surroundings result;
    const auto enter = [&](double distance2, double foot, double top) {
      if (visits_ == 0) return false;
      --visits_;
      return distance2 < result.squaredDistance || foot < result.foot || top > result.top;
    };
    const Box tallEnough{.low = {place.x(), place.y(), heights.minTop},
                         .high = {place.x(), place.y(), heights.maxFoot}};
    tree_.search(tallEnough, footReach, enter, [&](std::uint32_t i) {
      const Wall& wall = walls_[i];
      const Vector2 nearest = nearestOf(wall.corners, place);
      const double distance2 = (nearest - place).squaredNorm();
      if (distance2 > footReach * footReach) return;
      if (distance2 < result.squaredDistance) {
        result.nearestWall = i;
        result.nearest = nearest;
        result.squaredDistance = distance2;
      }
      result.foot = std::min(result.foot, wall.foot);
      result.top = std::max(result.top, wall.top);
    });
    if (visits_ == 0 || !std::isfinite(result.squaredDistance)) return std::nullopt;
    return result;
  }

  [[nodiscard]] const Wall& wall(std::size_t i) const { return walls_[i]; }
  /// So many triangles more are to be looked at.
  void expect(std::size_t triangles) { visits_ += maxVisits * triangles; }

 private:
  static std::vector<Box> boxesOf(const std::vector<Wall>& walls) {
    std::vector<Box> boxes;
    boxes.reserve(walls.size());
    for (const Wall& wall : walls) {
      Box box = boxOf(wall.corners);
      box.low.z() = wall.foot;
      box.high.z() = wall.top;
      boxes.push_back(box);
    }
    return boxes;
  }

  const std::vector<Wall>& walls_;
  BoxTree tree_;
  std::size_t visits_ = 0;
};

/// The horizontal direction away from the nearest wall.
Vector2 outward(const Wall& wall, const Vector2& nearest, const Vector2& place,
                const Triangle& triangle) {
  const Vector2 away = place - nearest;
  if (away.norm() > onWall) return away.normalized();
  Vector2 normal = wall.normal.head<2>().normalized();
  double furthest = 0.0;
  for (const Eigen::Vector3d& corner : triangle) {
    const double distance = (corner.head<2>() - nearest).dot(normal);
    if (std::abs(distance) > std::abs(furthest)) furthest = distance;
  }
  return furthest < 0.0 ? -normal : normal;
}

/// A triangle that is the foot of walls unless it is ground.
struct Candidate {
  WallFoot foot;
  Vector2 middle;
  Vector2 nearest;
  Vector2 outward;
};

/// The walls that a triangle with its upper end at `top` stands before, if any.
std::optional<Candidate> candidateOf(WallTree& walls, int number, const Triangle& triangle,
                                     double top) {
  const Vector2 middle = middleOf(triangle);
  const std::optional<Surroundings> around = walls.around(middle, heightsAbove(top));
  if (!around) return std::nullopt;
  const Vector2 away = outward(walls.wall(around->nearestWall), around->nearest, middle, triangle);
  for (const Eigen::Vector3d& corner : triangle) {
    if ((corner.head<2>() - around->nearest).dot(away) > footReach + weldDistance) {
      return std::nullopt;
    }
  }
  return Candidate{.foot = {.triangle = number, .foot = around->foot, .top = around->top},
                   .middle = middle,
                   .nearest = around->nearest,
                   .outward = away};
}

std::vector<WallFoot> lowWalls(WallTree& tree, const std::vector<Wall>& walls) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) highest = std::max(highest, wall.top);
  std::vector<WallFoot> feet;
  for (const Wall& wall : walls) {
    if (wall.top - wall.foot > maxFootHeight || wall.top + minRise > highest) continue;
    const auto candidate = candidateOf(tree, wall.triangle, wall.corners, wall.top);
    if (candidate) feet.push_back(candidate->foot);
  }
  return feet;
}

/// Where the plane of a triangle is out of reach of the walls that it may be the foot of.
struct Probe {
  std::size_t candidate;
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
};

Eigen::Vector3d upwardNormal(const Triangle& triangle) {
  const Eigen::Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  return (normal.z() < 0.0 ? -normal : normal).normalized();
}

double heightOfPlane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                     const Vector2& place) {
  return point.z() - (place - point.head<2>()).dot(normal.head<2>()) / normal.z();
}

/// Nothing if it is a gap between walls, or the search has taken too long.
std::optional<Vector2> placeOutOfReach(WallTree& walls, const Candidate& candidate,
                                       const Triangle& triangle, double top) {
  constexpr double away = footReach + beyondReach;
  Vector2 place = candidate.nearest + away * candidate.outward;
  for (int i = 0; i < maxWallsLeft; ++i) {
    const std::optional<Surroundings> around = walls.around(place, heightsAbove(top));
    if (!around) return place;
    place = around->nearest +
            away * outward(walls.wall(around->nearestWall), around->nearest, place, triangle);
  }
  return std::nullopt;
}

bool covers(const Triangle& triangle, const Vector2& place) {
  const Vector2 a = triangle[0].head<2>() - place;
  const Vector2 b = triangle[1].head<2>() - place;
  const Vector2 c = triangle[2].head<2>() - place;
  const double ab = cross(a, b);
  const double bc = cross(b, c);
  const double ca = cross(c, a);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

/// Which probes lie on flat triangles of the scene; by probe.
std::vector<bool> onGround(const std::vector<Probe>& probes, const std::vector<Triangle>& flat) {
  std::vector<bool> found(probes.size(), false);
  if (probes.empty()) return found;
  std::vector<Box> boxes;
  boxes.reserve(probes.size());
  const Eigen::Vector3d aside = maxStep * Eigen::Vector3d::UnitZ();
  for (const Probe& probe : probes) boxes.push_back({probe.place - aside, probe.place + aside});
  const BoxTree tree(boxes);
  std::size_t visits = maxVisits * (probes.size() + flat.size());
  for (const Triangle& triangle : flat) {
    const auto enter = [&](double /*distance2*/, double /*low*/, double /*high*/) {
      if (visits == 0) return false;
      --visits;
      return true;
    };
    tree.search(boxOf(triangle), 0.0, enter, [&](std::uint32_t i) {
      const Probe& probe = probes[i];
      if (found[i] || !covers(triangle, probe.place.head<2>())) return;
      const Eigen::Vector3d normal = upwardNormal(triangle);
      const double height = heightOfPlane(triangle[0], normal, probe.place.head<2>());
      found[i] =
          normal.dot(probe.normal) >= minAlignment && std::abs(height - probe.place.z()) <= maxStep;
    });
  }
  if (visits == 0) found.assign(probes.size(), true);
  return found;
}

/// The feet among triangles that are no walls.
std::vector<WallFoot> slopesAndLedges(WallTree& walls, const Scene& scene,
                                      const std::vector<bool>& isWall) {
  std::vector<Candidate> candidates;
  std::vector<Probe> probes;
  std::vector<Triangle> flat;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    if (isWall[i]) continue;
    const Scene::Triangle& each = scene.triangles[i];
    const Triangle triangle{scene.corner(each, 0), scene.corner(each, 1), scene.corner(each, 2)};
    const double top = std::max({triangle[0].z(), triangle[1].z(), triangle[2].z()});
    const auto candidate = candidateOf(walls, static_cast<int>(i), triangle, top);
    if (!candidate || thickness(triangle[0], triangle[1], triangle[2]) < degenerateThickness) {
      continue;
    }
    const Eigen::Vector3d normal = upwardNormal(triangle);
    if (normal.z() >= minGroundNormalUp) {
      const std::optional<Vector2> place = placeOutOfReach(walls, *candidate, triangle, top);
      if (!place) continue;
      probes.push_back(
          {.candidate = candidates.size(),
           .place = {place->x(), place->y(), heightOfPlane(triangle[0], normal, *place)},
           .normal = normal});
    }
    candidates.push_back(*candidate);
  }
  std::vector<WallFoot> feet;
  if (!probes.empty()) {
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
      if (isWall[i]) continue;
      const Scene::Triangle& each = scene.triangles[i];
      const Triangle triangle{scene.corner(each, 0), scene.corner(each, 1), scene.corner(each, 2)};
      if (upwardNormal(triangle).z() >= minGroundNormalUp * minAlignment) flat.push_back(triangle);
    }
  }
  std::vector<bool> isGround(candidates.size(), false);
  const std::vector<bool> found = onGround(probes, flat);
  for (std::size_t k = 0; k < probes.size(); ++k) isGround[probes[k].candidate] = found[k];
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (!isGround[k]) feet.push_back(candidates[k].foot);
  }
  return feet;
}

}  // namespace

std::vector<WallFoot> wallFeet(const std::vector<Wall>& walls) {
  WallTree tree(walls);
  tree.expect(walls.size());
  return lowWalls(tree, walls);
}

std::vector<WallFoot> wallFeet(const Scene& scene, const std::vector<Wall>& walls) {
  WallTree tree(walls);
  tree.expect(scene.triangles.size());
  std::vector<bool> isWall(scene.triangles.size(), false);
  for (const Wall& wall : walls) isWall[static_cast<std::size_t>(wall.triangle)] = true;
  const std::vector<WallFoot> low = lowWalls(tree, walls);
  const std::vector<WallFoot> others = slopesAndLedges(tree, scene, isWall);
  std::vector<WallFoot> feet;
  feet.reserve(low.size() + others.size());
  std::merge(low.begin(), low.end(), others.begin(), others.end(), std::back_inserter(feet),
             [](const WallFoot& a, const WallFoot& b) { return a.triangle < b.triangle; });
  return feet;
}

}  // namespace bumper
