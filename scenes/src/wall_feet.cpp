// What stands at the foot of a wall?
//
// A triangle whose middle is near a taller wall in plan, and that reaches no further away from it.
// Of those that a vehicle could drive on it remains to be seen whether they are a ledge or the
// ground: their plane is followed to the nearest place that is out of reach of such walls, and is
// ground if the scene goes on there.

#include "bumper/scenes/wall_feet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "bumper/response/planar_motion.h"
#include "ground_probes.h"
#include "tall_walls.h"
#include "triangle.h"
#include "weld.h"

namespace bumper {

namespace {

/// A wall that is taller than this, m, is no foot, wherever it stands.
constexpr double maxFootHeight = 1.0;

/// How far beyond the reach of walls, m, one looks whether ground goes on.
constexpr double beyondReach = 0.02;

/// A place closer to a wall than this, m, lies on neither of its sides.
constexpr double onWall = 1e-3;

/// Where the reach of so many walls, one after the other, does not end, all is taken for ground.
constexpr int maxWallsLeft = 4;

Vector2 middleOf(const TriangleCorners& triangle) {
  return (triangle[0] + triangle[1] + triangle[2]).head<2>() / 3.0;
}

/// The horizontal direction away from the nearest wall.
Vector2 outward(const Wall& wall, const Vector2& nearest, const Vector2& place,
                const TriangleCorners& triangle) {
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
  Vector2 nearest;
  Vector2 outward;
};

/// The walls that a triangle with its upper end at `top` stands before, if any.
std::optional<Candidate> candidateOf(TallWalls& walls, int number, const TriangleCorners& triangle,
                                     double top) {
  const Vector2 middle = middleOf(triangle);
  const std::optional<Surroundings> around = walls.around(middle, top);
  if (!around) return std::nullopt;
  const Vector2 away = outward(walls.wall(around->nearestWall), around->nearest, middle, triangle);
  for (const Eigen::Vector3d& corner : triangle) {
    if ((corner.head<2>() - around->nearest).dot(away) > footReach + weldDistance) {
      return std::nullopt;
    }
  }
  return Candidate{.foot = {.triangle = number, .foot = around->foot, .top = around->top},
                   .nearest = around->nearest,
                   .outward = away};
}

std::vector<WallFoot> lowWalls(TallWalls& tallWalls, const std::vector<Wall>& walls) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) highest = std::max(highest, wall.top);
  std::vector<WallFoot> feet;
  for (const Wall& wall : walls) {
    if (wall.top - wall.foot > maxFootHeight || wall.top + minRise > highest) continue;
    const auto candidate = candidateOf(tallWalls, wall.triangle, wall.corners, wall.top);
    if (candidate) feet.push_back(candidate->foot);
  }
  return feet;
}

/// Nothing if it is a gap between walls, or the search has taken too long.
std::optional<Vector2> placeOutOfReach(TallWalls& walls, const Candidate& candidate,
                                       const TriangleCorners& triangle, double top) {
  constexpr double away = footReach + beyondReach;
  Vector2 place = candidate.nearest + away * candidate.outward;
  for (int i = 0; i < maxWallsLeft; ++i) {
    const std::optional<Surroundings> around = walls.around(place, top);
    if (!around) return place;
    place = around->nearest +
            away * outward(walls.wall(around->nearestWall), around->nearest, place, triangle);
  }
  return std::nullopt;
}

/// The feet among triangles that are no walls.
std::vector<WallFoot> slopesAndLedges(TallWalls& walls, const Scene& scene,
                                      const std::vector<bool>& isWall) {
  std::vector<Candidate> candidates;
  std::vector<GroundProbe> probes;
  std::vector<std::size_t> probed;  // by probe: its candidate
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    if (isWall[i]) continue;
    const TriangleCorners triangle = cornersOf(scene, scene.triangles[i]);
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
          {.place = {place->x(), place->y(), heightOfPlane(triangle[0], normal, *place)},
           .normal = normal});
      probed.push_back(candidates.size());
    }
    candidates.push_back(*candidate);
  }
  std::vector<bool> isGround(candidates.size(), false);
  const std::vector<bool> found = onGround(probes, scene, isWall);
  for (std::size_t k = 0; k < probes.size(); ++k) isGround[probed[k]] = found[k];
  std::vector<WallFoot> feet;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (!isGround[k]) feet.push_back(candidates[k].foot);
  }
  return feet;
}

}  // namespace

std::vector<WallFoot> wallFeet(const std::vector<Wall>& walls) {
  TallWalls tallWalls(walls);
  tallWalls.expect(walls.size());
  return lowWalls(tallWalls, walls);
}

std::vector<WallFoot> wallFeet(const Scene& scene, const std::vector<Wall>& walls) {
  TallWalls tallWalls(walls);
  tallWalls.expect(scene.triangles.size());
  std::vector<bool> isWall(scene.triangles.size(), false);
  for (const Wall& wall : walls) isWall[static_cast<std::size_t>(wall.triangle)] = true;
  const std::vector<WallFoot> low = lowWalls(tallWalls, walls);
  const std::vector<WallFoot> others = slopesAndLedges(tallWalls, scene, isWall);
  std::vector<WallFoot> feet;
  feet.reserve(low.size() + others.size());
  std::merge(low.begin(), low.end(), others.begin(), others.end(), std::back_inserter(feet),
             [](const WallFoot& a, const WallFoot& b) { return a.triangle < b.triangle; });
  return feet;
}

}  // namespace bumper
