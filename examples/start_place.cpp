#include "start_place.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>

#include "bumper/scenes/walls.h"

namespace bumper::examples {

namespace {

constexpr double headroom = 2.0;           // m
constexpr double storey = 0.5;             // m that a named height may lie below its ground
constexpr double sameSurface = 0.01;       // m
constexpr double minGroundNormalUp = 0.7;  // 45°
constexpr double minLevelNormalUp = 0.97;  // 14°

Eigen::Vector3d areaVector(const Scene& scene, const Scene::Triangle& triangle) {
  const Eigen::Vector3d& a = scene.corner(triangle, 0);
  return 0.5 * (scene.corner(triangle, 1) - a).cross(scene.corner(triangle, 2) - a);
}

double normalUp(const Eigen::Vector3d& area) { return std::abs(area.z()) / area.norm(); }

Eigen::Vector2d centreOf(const Scene& scene, const Scene::Triangle& triangle) {
  return (scene.corner(triangle, 0) + scene.corner(triangle, 1) + scene.corner(triangle, 2))
             .head<2>() /
         3.0;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// In plan, edges included.
bool covers(const Scene& scene, const Scene::Triangle& triangle, const Eigen::Vector2d& place) {
  const Eigen::Vector2d a = scene.corner(triangle, 0).head<2>() - place;
  const Eigen::Vector2d b = scene.corner(triangle, 1).head<2>() - place;
  const Eigen::Vector2d c = scene.corner(triangle, 2).head<2>() - place;
  const double ab = cross(a, b);
  const double bc = cross(b, c);
  const double ca = cross(c, a);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

// By vertex: a vertex of the connected piece of ground that it belongs to (union-find).
std::vector<std::uint32_t> piecesOf(const Scene& scene,
                                    const std::vector<Scene::Triangle>& ground) {
  std::vector<std::uint32_t> parents(scene.vertices.size());
  std::iota(parents.begin(), parents.end(), 0U);
  const auto find = [&](std::uint32_t vertex) {
    while (parents[vertex] != vertex) vertex = parents[vertex] = parents[parents[vertex]];
    return vertex;
  };
  for (const Scene::Triangle& triangle : ground) {
    for (std::size_t k = 1; k < 3; ++k) {
      parents[find(triangle.corners.at(k))] = find(triangle.corners[0]);
    }
  }
  for (std::uint32_t vertex = 0; vertex < parents.size(); ++vertex) parents[vertex] = find(vertex);
  return parents;
}

}  // namespace

StartPlaces::StartPlaces(const Scene& scene, const std::vector<bool>& scenery) : scene_(scene) {
  std::copy_if(scene.triangles.begin(), scene.triangles.end(), std::back_inserter(triangles_),
               [&](const Scene::Triangle& triangle) { return !scenery[triangle.mesh]; });
}

// From below upwards, one for all triangles in the same place.
std::vector<StartPlaces::Surface> StartPlaces::surfacesAt(const Eigen::Vector2d& place) const {
  std::vector<Surface> surfaces;
  for (const Scene::Triangle& triangle : triangles_) {
    const Eigen::Vector3d area = areaVector(scene_, triangle);
    if (area.z() == 0.0 || !covers(scene_, triangle, place)) continue;
    const Eigen::Vector3d& corner = scene_.corner(triangle, 0);
    const double height = corner.z() - (place - corner.head<2>()).dot(area.head<2>()) / area.z();
    surfaces.push_back(
        {height, normalUp(area) >= minGroundNormalUp, area.z() > 0.0, area.z() < 0.0});
  }
  std::sort(surfaces.begin(), surfaces.end(),
            [](const Surface& a, const Surface& b) { return a.height < b.height; });
  std::vector<Surface> merged;
  for (const Surface& surface : surfaces) {
    if (merged.empty() || surface.height > merged.back().height + sameSurface) {
      merged.push_back(surface);
      continue;
    }
    Surface& last = merged.back();
    last = {surface.height, last.isGround || surface.isGround, last.facesUp || surface.facesUp,
            last.facesDown || surface.facesDown};
  }
  return merged;
}

bool StartPlaces::wallsStandOn(double height) const {
  const double maxNormalUp = WallSelection{}.maxNormalUp;
  return std::any_of(triangles_.begin(), triangles_.end(), [&](const Scene::Triangle& triangle) {
    const Eigen::Vector3d area = areaVector(scene_, triangle);
    const double foot = std::min({scene_.corner(triangle, 0).z(), scene_.corner(triangle, 1).z(),
                                  scene_.corner(triangle, 2).z()});
    return normalUp(area) <= maxNormalUp && foot >= height - sameSurface;
  });
}

std::optional<double> StartPlaces::lowestGround(const Eigen::Vector2d& place) const {
  const std::vector<Surface> surfaces = surfacesAt(place);
  if (surfaces.empty()) return std::nullopt;
  double highest = surfaces.back().height;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& surface = surfaces[i];
    if (!surface.isGround) continue;
    highest = surface.height;
    if (i + 1 == surfaces.size()) return surface.height;
    const Surface& above = surfaces[i + 1];
    if (above.height - surface.height < headroom) continue;
    const bool isSolid = !surface.facesUp && !above.facesDown;
    if (!isSolid || !wallsStandOn(above.height)) return surface.height;
  }
  return highest;
}

std::optional<double> StartPlaces::groundNear(const Eigen::Vector2d& place, double height) const {
  std::optional<double> found;
  for (const Surface& surface : surfacesAt(place)) {
    if (!surface.isGround) continue;
    if (found && surface.height > height + storey) break;
    found = surface.height;
  }
  return found ? found : lowestGround(place);
}

std::optional<Eigen::Vector2d> StartPlaces::middle() const {
  Eigen::AlignedBox2d box;
  std::vector<Scene::Triangle> ground;
  for (const Scene::Triangle& triangle : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) box.extend(scene_.corner(triangle, k).head<2>());
    if (normalUp(areaVector(scene_, triangle)) >= minGroundNormalUp) ground.push_back(triangle);
  }
  if (ground.empty()) return std::nullopt;
  const std::vector<std::uint32_t> pieces = piecesOf(scene_, ground);
  std::vector<double> areas(scene_.vertices.size());
  for (const Scene::Triangle& triangle : ground) {
    areas[pieces[triangle.corners[0]]] += areaVector(scene_, triangle).norm();
  }
  const auto largest = static_cast<std::uint32_t>(
      std::distance(areas.begin(), std::max_element(areas.begin(), areas.end())));
  const Eigen::Vector2d middle = box.center();
  std::optional<Eigen::Vector2d> nearest;
  double least = std::numeric_limits<double>::infinity();
  bool isNearestLevel = false;
  for (const Scene::Triangle& triangle : ground) {
    if (pieces[triangle.corners[0]] != largest) continue;
    const bool isLevel = normalUp(areaVector(scene_, triangle)) >= minLevelNormalUp;
    const Eigen::Vector2d place =
        covers(scene_, triangle, middle) ? middle : centreOf(scene_, triangle);
    const double distance = (place - middle).norm();
    if (isLevel == isNearestLevel ? distance >= least : isNearestLevel) continue;
    nearest = place;
    least = distance;
    isNearestLevel = isLevel;
  }
  return nearest;
}

}  // namespace bumper::examples
