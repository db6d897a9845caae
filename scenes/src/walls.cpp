#include "bumper/scenes/walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "bumper/response/error.h"
#include "ground_below.h"
#include "ground_levels.h"
#include "leaning_walls.h"
#include "repeated_walls.h"
#include "triangle.h"
#include "wall_extents.h"
#include "weld.h"

namespace bumper {

namespace {

void validate(const WallSelection& selection) {
  if (!(selection.maxNormalUp >= 0.0 && selection.maxNormalUp <= 1.0)) {
    throw Error("WallSelection::maxNormalUp is " + std::to_string(selection.maxNormalUp) +
                ": allowed is 0 (exactly vertical) to 1 (everything)");
  }
  if (!selection.groundReach) return;
  const auto require = [](const char* name, double value) {
    if (std::isfinite(value) && value >= 0.0) return;
    throw Error(std::string("GroundReach::") + name + " is " + std::to_string(value) +
                " m: it must be finite and not negative");
  };
  require("distance", selection.groundReach->distance);
  require("above", selection.groundReach->above);
  require("below", selection.groundReach->below);
}

/// |vertical component of the normal| at 45°: what is steeper carries no vehicle.
constexpr double drivable = 0.707;

// Room for rounding, so that at 0 what was built to be vertical is.
double steepestGround(const WallSelection& selection) { return selection.maxNormalUp + 1e-9; }

/// The triangles that stand steep enough to be walls by themselves or as a part of one, duplicates
/// among them.
std::vector<Wall> steepTriangles(const Scene& scene, const WallSelection& selection,
                                 WallReport& report) {
  const double limit = std::max(steepestGround(selection), flattest);
  const std::vector<bool> scenery = matchingMeshes(scene, std::string(selection.scenery));
  std::vector<Wall> steep;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const Scene::Triangle& triangle = scene.triangles[i];
    const TriangleCorners corners = cornersOf(scene, triangle);
    const auto& [a, b, c] = corners;
    if (!(thickness(a, b, c) >= degenerateThickness)) {
      ++report.droppedDegenerate;
      continue;
    }
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    if (std::abs(normal.z()) > limit) {
      ++report.droppedFlat;
      continue;
    }
    if (scenery[triangle.mesh]) {
      ++report.droppedScenery;
      continue;
    }
    steep.push_back({corners, normal, static_cast<int>(i), 0.0, 0.0});
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

/// Leaves out what is too flat for a wall, by itself and as a part of one.
void dropFlat(const Scene& scene, const WallSelection& selection, Walls& walls,
              std::vector<Corners>& corners) {
  const std::vector<bool> stays = areWalls(scene, walls.walls, corners, steepestGround(selection));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < stays.size(); ++i) {
    if (!stays[i]) {
      walls.report.droppedOnGuess += std::abs(walls.walls[i].normal.z()) < drivable ? 1 : 0;
      continue;
    }
    walls.walls[kept] = walls.walls[i];
    corners[kept++] = corners[i];
  }
  walls.report.droppedFlat += stays.size() - kept;
  walls.walls.resize(kept);
  corners.resize(kept);
}

void describe(Walls& walls) {
  WallReport& report = walls.report;
  walls.walls.shrink_to_fit();
  report.walls = walls.walls.size();
  report.memory = walls.walls.capacity() * sizeof(Wall);
  report.lowestFoot = 0.0;
  report.highestTop = 0.0;
  if (walls.walls.empty()) return;
  report.lowestFoot = std::numeric_limits<double>::infinity();
  report.highestTop = -std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls.walls) {
    report.lowestFoot = std::min(report.lowestFoot, wall.foot);
    report.highestTop = std::max(report.highestTop, wall.top);
  }
}

/// Out of reach of ground below: of what lies below all ground, the ground may not be in the scene.
bool isAbove(GroundLevels::Place place) {
  return place == GroundLevels::Place::above_ground || place == GroundLevels::Place::between;
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
  result.walls = steepTriangles(scene, selection, result.report);
  std::vector<Corners> corners = weldedCorners(result.walls);
  dropFlat(scene, selection, result, corners);
  if (selection.dropRepeated) dropRepeated(result.walls, corners, result.report);
  findWallExtents(result.walls, corners);
  describe(result);
  dropOutOfReach(scene, selection, result);
  return result;
}

void dropOutOfReach(const Scene& scene, const WallSelection& selection, Walls& walls) {
  validate(selection);
  if (!selection.groundReach || walls.walls.empty()) return;
  const GroundReach& reach = *selection.groundReach;
  GroundLevels ground(scene, steepestGround(selection), reach.distance);
  if (ground.empty()) return;
  WallReport& report = walls.report;
  using Place = GroundLevels::Place;
  std::vector<Place> places;
  places.reserve(walls.walls.size());
  std::vector<Wall> outOfReach;
  for (const Wall& wall : walls.walls) {
    places.push_back(ground.placeOf(wall, reach));
    if (isAbove(places.back())) outOfReach.push_back(wall);
  }
  std::optional<GroundBelow> below;
  if (!outOfReach.empty()) below.emplace(scene, ground.flat(), reach, outOfReach);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Wall& wall = walls.walls[i];
    if (isAbove(places[i]) && below->isProvenFor(wall)) {
      ++(places[i] == Place::between ? report.droppedBuried : report.droppedOverhead);
      continue;
    }
    report.withoutGround += places[i] == Place::without_ground ? 1 : 0;
    report.inDoubt += isAbove(places[i]) || places[i] == Place::below_ground ? 1 : 0;
    walls.walls[kept++] = wall;
  }
  walls.walls.resize(kept);
  describe(walls);
}

}  // namespace bumper
