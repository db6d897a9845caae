#include "bumper/scenes/scene.h"

#include "bumper/response/error.h"

namespace bumper {

namespace {

[[noreturn]] void fail(const Scene& scene, const std::string& defect) {
  throw Error("scene \"" + scene.name + "\": " + defect);
}

void validate(const Scene& scene, std::size_t index) {
  const Scene::Triangle& triangle = scene.triangles[index];
  for (const std::uint32_t corner : triangle.corners) {
    if (corner < scene.vertices.size()) continue;
    fail(scene, "triangle " + std::to_string(index) + " uses vertex " + std::to_string(corner) +
                    ", allowed are 0 to " + std::to_string(scene.vertices.size()) + " exclusive");
  }
  if (triangle.mesh >= scene.meshes.size()) {
    fail(scene, "triangle " + std::to_string(index) + " belongs to mesh " +
                    std::to_string(triangle.mesh) + ", allowed are 0 to " +
                    std::to_string(scene.meshes.size()) + " exclusive");
  }
}

}  // namespace

void validate(const Scene& scene) {
  if (scene.triangles.empty()) fail(scene, "has no triangle, at least one is needed");
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    if (scene.vertices[i].allFinite()) continue;
    fail(scene,
         "vertex " + std::to_string(i) + " has a coordinate that is not finite; all must be");
  }
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) validate(scene, i);
}

}  // namespace bumper
