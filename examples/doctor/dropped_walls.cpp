#include "dropped_walls.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

namespace bumper::doctor {

namespace {

std::vector<bool> trianglesOf(const Scene& scene, const Walls& walls) {
  std::vector<bool> is(scene.triangles.size(), false);
  for (const Wall& wall : walls.walls) is[static_cast<std::size_t>(wall.triangle)] = true;
  return is;
}

/// Twice the area along its normal.
Eigen::Vector3d areaOf(const Scene& scene, const Scene::Triangle& triangle) {
  return (scene.corner(triangle, 1) - scene.corner(triangle, 0))
      .cross(scene.corner(triangle, 2) - scene.corner(triangle, 0));
}

}  // namespace

std::vector<DroppedGroup> droppedGroups(const Subject& subject, const Walls& walls) {
  const Scene& scene = subject.scene;
  const WallReport& report = walls.report;
  std::vector<DroppedGroup> groups;
  const auto add = [&](DroppedGroup group, const std::function<bool(std::size_t)>& belongs) {
    if (group.triangles == 0) return;
    double largest = -1.0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
      const double area = areaOf(scene, scene.triangles[i]).norm();
      if (area <= largest || !belongs(i)) continue;
      largest = area;
      group.largest = i;
    }
    const Scene::Triangle& triangle = scene.triangles[group.largest];
    group.place =
        (scene.corner(triangle, 0) + scene.corner(triangle, 1) + scene.corner(triangle, 2)) / 3.0;
    group.mesh = scene.meshes[triangle.mesh].name;
    groups.push_back(std::move(group));
  };

  const std::vector<bool> kept = trianglesOf(scene, walls);
  const std::vector<bool> scenery = matchingMeshes(scene, subject.scenery);
  const auto upward = [&](std::size_t i) {
    return std::abs(areaOf(scene, scene.triangles[i]).normalized().z());
  };
  const WallSelection usual = subject.selection();
  add({.reason = "steeper than 45°, taken for hillsides on a guess",
       .triangles = report.droppedOnGuess,
       .isGuess = true},
      [&](std::size_t i) {
        return !kept[i] && !scenery[scene.triangles[i].mesh] && upward(i) > usual.maxNormalUp &&
               upward(i) < std::sqrt(0.5);
      });
  add({.reason = "scenery", .triangles = report.droppedScenery}, [&](std::size_t i) {
    return scenery[scene.triangles[i].mesh] && upward(i) <= usual.maxNormalUp;
  });
  if (report.droppedOverhead + report.droppedBuried > 0) {
    WallSelection all = usual;
    all.groundReach.reset();
    const std::vector<bool> reached = trianglesOf(scene, selectWalls(scene, all));
    add({.reason = "out of reach of the ground",
         .triangles = report.droppedOverhead + report.droppedBuried},
        [&](std::size_t i) { return reached[i] && !kept[i]; });
  }
  if (report.droppedDuplicate + report.droppedRetriangulated > 0) {
    WallSelection all = usual;
    all.dropRepeated = false;
    const std::vector<bool> repeated = trianglesOf(scene, selectWalls(scene, all));
    add({.reason = "there twice",
         .triangles = report.droppedDuplicate + report.droppedRetriangulated},
        [&](std::size_t i) { return repeated[i] && !kept[i]; });
  }
  return groups;
}

}  // namespace bumper::doctor
