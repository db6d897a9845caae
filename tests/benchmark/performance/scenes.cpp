#include "scenes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"

namespace bumper::benchmark {

namespace {

// |vertical component of the unit normal| of a wall.
constexpr double wallNormalUp = 0.3;

bool isWall(const Scene& scene, const Scene::Triangle& triangle) {
  const Eigen::Vector3d a = scene.corner(triangle, 0);
  const Eigen::Vector3d normal =
      (scene.corner(triangle, 1) - a).cross(scene.corner(triangle, 2) - a);
  return std::abs(normal.z()) <= wallNormalUp * normal.norm();
}

}  // namespace

NamedScene makeScene(const std::string& name) {
  if (name == "S1") return {.name = name, .scene = testRail()};
  if (name == "S2") return {.name = name, .scene = wallsAlone(course())};
  if (name == "S2g") return {.name = name, .scene = course()};
  if (name == "S3") {
    return {
        .name = name,
        .scene = course(
            {.innerPanels = 5000, .outerPanels = 5000, .groundAlong = 5000, .groundAcross = 8})};
  }
  if (name == "S4") {
    return {.name = name,
            .scene = course({.innerPanels = 10000,
                             .outerPanels = 10000,
                             .groundAlong = 10000,
                             .groundAcross = 48})};
  }
  throw Error("there is no scene " + name + ": S1, S2, S2g, S3 and S4 are");
}

NamedScene courseOfSize(std::size_t triangles) {
  constexpr std::size_t trianglesPerPanel = 20;  // inner and outer wall: 4; ground: 16
  const std::size_t panels = std::max<std::size_t>(50, triangles / trianglesPerPanel);
  return {.name = "course " + std::to_string(triangles),
          .scene = course({.innerPanels = panels,
                           .outerPanels = panels,
                           .groundAlong = panels,
                           .groundAcross = 8})};
}

Scene wallsAlone(const Scene& scene) {
  constexpr auto unused = static_cast<std::uint32_t>(-1);
  Scene result;
  result.name = scene.name;
  result.meshes = scene.meshes;
  std::vector<std::uint32_t> newNumber(scene.vertices.size(), unused);
  for (Scene::Triangle triangle : scene.triangles) {
    if (!isWall(scene, triangle)) continue;
    for (std::uint32_t& corner : triangle.corners) {
      if (newNumber[corner] == unused) {
        newNumber[corner] = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(scene.vertices[corner]);
      }
      corner = newNumber[corner];
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

Scene shuffled(Scene scene) {
  std::mt19937 random(1998);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same order in each run
  // Not std::shuffle, whose result is the library's own.
  for (std::size_t left = scene.triangles.size(); left > 1; --left) {
    std::swap(scene.triangles[left - 1], scene.triangles[random() % left]);
  }
  return scene;
}

VehicleParameters queryCar() {
  return {.mass = 1500.0,
          .yawInertia = 2600.0,
          .massCentreToFront = 2.2,
          .massCentreToRear = 2.2,
          .width = 1.8,
          .massCentreHeight = 0.55};
}

}  // namespace bumper::benchmark
