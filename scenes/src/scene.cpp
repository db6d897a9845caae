#include "bumper/scenes/scene.h"

#include <algorithm>
#include <regex>

#include "bumper/response/error.h"
#include "bumper/scenes/scene_budget.h"

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

void validate(const Scene& scene, const SceneBudget& budget) {
  const auto require = [&](std::size_t actual, std::size_t most, const char* what,
                           const char* limit) {
    if (actual <= most) return;
    fail(scene, "has " + std::to_string(actual) + ' ' + what + ": SceneBudget::" + limit +
                    " allows " + std::to_string(most));
  };
  require(scene.triangles.size(), budget.triangles, "triangles", "triangles");
  require(scene.vertices.size() / 3, budget.triangles, "times three vertices", "triangles");
  require(scene.meshes.size(), budget.nodes, "meshes", "nodes");
  std::size_t names = 0;
  for (const SceneMesh& mesh : scene.meshes) {
    for (const std::string* name : {&mesh.name, &mesh.material}) {
      require(name->size(), budget.nameLength, "bytes in one name", "nameLength");
      names += name->size();
    }
  }
  require(names, budget.names, "bytes of names", "names");
}

std::vector<bool> matchingMeshes(const Scene& scene, const std::string& pattern) {
  std::vector<bool> matching(scene.meshes.size(), false);
  if (pattern.empty()) return matching;
  const std::size_t longest = SceneBudget{}.nameLength;
  for (const SceneMesh& mesh : scene.meshes) {
    const std::size_t length = std::max(mesh.name.size(), mesh.material.size());
    if (length <= longest) continue;
    fail(scene, "mesh \"" + mesh.name.substr(0, 40) + "…\" has a name or material of " +
                    std::to_string(length) + " bytes: to be matched with a pattern it may have " +
                    std::to_string(longest) + " (SceneBudget::nameLength)");
  }
  try {
    const std::regex expression(pattern);
    std::transform(scene.meshes.begin(), scene.meshes.end(), matching.begin(),
                   [&](const SceneMesh& mesh) {
                     return std::regex_match(mesh.name, expression) ||
                            std::regex_match(mesh.material, expression);
                   });
  } catch (const std::regex_error& error) {
    throw Error("the pattern \"" + pattern + "\" is no regular expression: " + error.what());
  }
  return matching;
}

}  // namespace bumper
