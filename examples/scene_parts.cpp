#include "scene_parts.h"

#include <array>
#include <cstdint>

namespace bumper::examples {

void addPart(const Scene& part, const SceneMesh& mesh, Scene& scene) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (Scene::Triangle triangle : part.triangles) {
    for (std::uint32_t& corner : triangle.corners) corner += first;
    triangle.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.triangles.push_back(triangle);
  }
  scene.meshes.push_back(mesh);
}

Scene level(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  Scene scene;
  scene.vertices = {{low.x(), low.y(), 0},
                    {high.x(), low.y(), 0},
                    {high.x(), high.y(), 0},
                    {low.x(), high.y(), 0}};
  scene.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  scene.meshes = {{}};
  return scene;
}

Scene block(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Scene scene;
  for (const double z : {low.z(), high.z()}) {
    scene.vertices.insert(scene.vertices.end(), {{low.x(), low.y(), z},
                                                 {high.x(), low.y(), z},
                                                 {high.x(), high.y(), z},
                                                 {low.x(), high.y(), z}});
  }
  // Counter-clockwise as seen from outside.
  using Quad = std::array<std::uint32_t, 4>;
  for (const Quad& q : {Quad{0, 3, 2, 1}, Quad{4, 5, 6, 7}, Quad{0, 1, 5, 4}, Quad{1, 2, 6, 5},
                        Quad{2, 3, 7, 6}, Quad{3, 0, 4, 7}}) {
    scene.triangles.push_back({{q[0], q[1], q[2]}});
    scene.triangles.push_back({{q[0], q[2], q[3]}});
  }
  scene.meshes = {{}};
  return scene;
}

}  // namespace bumper::examples
