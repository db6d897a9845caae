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
  const Eigen::Vector3d& a = scene.corner(triangle, 0);
  const Eigen::Vector3d normal =
      (scene.corner(triangle, 1) - a).cross(scene.corner(triangle, 2) - a);
  return std::abs(normal.z()) <= wallNormalUp * normal.norm();
}

}  // namespace

NamedScene makeScene(const std::string& name) {
  if (name == "S1") return {.name = name, .scene = testRail()};
  if (name == "S2") return {.name = name, .scene = wallsAlone(course())};
  if (name == "S2g") return {.name = name, .scene = course()};
  if (name == "S3") return {.name = name, .scene = courseOfSize(100000).scene};
  if (name == "S4") return {.name = name, .scene = courseOfSize(1000000).scene};
  throw Error("there is no scene " + name + ": S1, S2, S2g, S3 and S4 are");
}

NamedScene courseOfSize(std::size_t triangles) {
  // Of a panel of both walls there are 4 triangles, of 20 until panels are 0.54 m long.
  const std::size_t panels = std::clamp<std::size_t>(triangles / 20, 50, 10000);
  const std::size_t ground = triangles - 4 * panels;
  return {.name = "course " + std::to_string(triangles),
          .scene = course({.innerPanels = panels,
                           .outerPanels = panels,
                           .groundAlong = panels,
                           .groundAcross = ground / (2 * panels)})};
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

Scene regrouped(Scene scene) {
  constexpr double square = 50.0;  // m
  const auto place = [&](const Scene::Triangle& triangle) {
    const Eigen::Vector3d& corner = scene.corner(triangle, 0);
    return std::pair(std::floor(corner.x() / square), std::floor(corner.y() / square));
  };
  std::ranges::stable_sort(scene.triangles, {}, place);
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
