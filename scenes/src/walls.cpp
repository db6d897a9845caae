#include "bumper/scenes/walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_set>

#include "bumper/response/error.h"
#include "wall_extents.h"
#include "weld.h"

namespace bumper {

namespace {

using Corners = std::array<std::uint32_t, 3>;

struct CornersHash {
  std::size_t operator()(const Corners& corners) const {
    std::uint64_t value = 0;
    for (const std::uint32_t corner : corners) {
      value = (value ^ corner) * 0x9E3779B97F4A7C15ULL;
      value ^= value >> 32U;
    }
    return static_cast<std::size_t>(value);
  }
};

Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

void validate(const WallSelection& selection) {
  if (selection.maxNormalUp >= 0.0 && selection.maxNormalUp <= 1.0) return;
  throw Error("WallSelection::maxNormalUp is " + std::to_string(selection.maxNormalUp) +
              ": allowed is 0 (exactly vertical) to 1 (everything)");
}

/// The triangles that stand steep enough, duplicates among them.
std::vector<Wall> steepTriangles(const Scene& scene, double maxNormalUp, WallReport& report) {
  // Room for rounding, so that at 0 what was built to be vertical is.
  const double limit = maxNormalUp + 1e-9;
  std::vector<Wall> steep;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const Scene::Triangle& triangle = scene.triangles[i];
    const Eigen::Vector3d& a = scene.corner(triangle, 0);
    const Eigen::Vector3d& b = scene.corner(triangle, 1);
    const Eigen::Vector3d& c = scene.corner(triangle, 2);
    if (!(thickness(a, b, c) >= degenerateThickness)) {
      ++report.droppedDegenerate;
      continue;
    }
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    if (std::abs(normal.z()) > limit) {
      ++report.droppedFlat;
      continue;
    }
    steep.push_back({{a, b, c}, normal, static_cast<int>(i), 0.0, 0.0});
  }
  return steep;
}

/// Which corners are the same points: three numbers for each wall.
std::vector<Corners> weldedCorners(const std::vector<Wall>& walls) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(walls.size() * 3);
  for (const Wall& wall : walls) {
    points.insert(points.end(), wall.corners.begin(), wall.corners.end());
  }
  const std::vector<std::uint32_t> welded = weld(points);
  std::vector<Corners> corners(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    corners[i] = {welded[3 * i], welded[3 * i + 1], welded[3 * i + 2]};
  }
  return corners;
}

std::size_t dropDuplicates(std::vector<Wall>& walls, std::vector<Corners>& corners) {
  std::unordered_set<Corners, CornersHash> seen;
  seen.reserve(walls.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!seen.insert(sorted(corners[i])).second) continue;
    walls[kept] = walls[i];
    corners[kept++] = corners[i];
  }
  const std::size_t dropped = walls.size() - kept;
  walls.resize(kept);
  corners.resize(kept);
  return dropped;
}

}  // namespace

Walls selectWalls(const Scene& scene, const WallSelection& selection) {
  validate(scene);
  validate(selection);
  if (scene.triangles.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) / 3) {
    throw Error("scene \"" + scene.name + "\" has " + std::to_string(scene.triangles.size()) +
                " triangles: allowed are 715,827,882");
  }
  Walls result;
  result.walls = steepTriangles(scene, selection.maxNormalUp, result.report);
  std::vector<Corners> corners = weldedCorners(result.walls);
  result.report.droppedDuplicate = dropDuplicates(result.walls, corners);
  findWallExtents(result.walls, corners);

  result.report.walls = result.walls.size();
  if (result.walls.empty()) return result;
  result.report.lowestFoot = std::numeric_limits<double>::infinity();
  result.report.highestTop = -std::numeric_limits<double>::infinity();
  for (const Wall& wall : result.walls) {
    result.report.lowestFoot = std::min(result.report.lowestFoot, wall.foot);
    result.report.highestTop = std::max(result.report.highestTop, wall.top);
  }
  return result;
}

}  // namespace bumper
