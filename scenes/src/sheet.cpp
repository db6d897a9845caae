#include "sheet.h"

namespace bumper {

std::uint32_t addMesh(Scene& scene, const std::string& name, const std::string& material,
                      const Eigen::Vector3f& colour) {
  scene.meshes.push_back({name, material, colour});
  return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

void addQuad(Scene& scene, std::uint32_t mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
             std::uint32_t d) {
  scene.triangles.push_back({{a, b, c}, mesh});
  scene.triangles.push_back({{a, c, d}, mesh});
}

std::uint32_t addSheet(Scene& scene, const Sheet& sheet) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), sheet.points.begin(), sheet.points.end());
  const std::size_t stations = sheet.points.size() / sheet.across;
  const auto vertex = [&](std::size_t station, std::size_t k) {
    return first + static_cast<std::uint32_t>(station % stations * sheet.across + k);
  };
  for (std::size_t k = 0; k + 1 < sheet.across; ++k) {
    for (std::size_t s = 0; s < stations - (sheet.closed ? 0 : 1); ++s) {
      addQuad(scene, sheet.meshes[k], vertex(s, k), vertex(s, k + 1), vertex(s + 1, k + 1),
              vertex(s + 1, k));
    }
  }
  return first;
}

}  // namespace bumper
