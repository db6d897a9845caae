#include "mesh_edges.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace bumper::doctor {

namespace {

struct Edge {
  std::uint32_t low;
  std::uint32_t high;
  bool isRising;  ///< the triangle runs from low to high
  std::uint32_t mesh;
};

void count(EdgeCount& kind, const Scene& scene, const Edge& edge) {
  ++kind.count;
  const Eigen::Vector3d& a = scene.vertices[edge.low];
  const Eigen::Vector3d& b = scene.vertices[edge.high];
  if ((b - a).norm() <= kind.longest) return;
  kind.longest = (b - a).norm();
  kind.place = 0.5 * (a + b);
}

}  // namespace

MeshEdges examineEdges(const Scene& scene) {
  std::vector<Edge> edges;
  edges.reserve(3 * scene.triangles.size());
  for (const Scene::Triangle& triangle : scene.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle.corners[k];
      const std::uint32_t b = triangle.corners[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b, triangle.mesh});
    }
  }
  std::ranges::sort(edges, [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high) < std::tie(b.low, b.high);
  });
  MeshEdges result;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low &&
           edges[end].high == edges[i].high) {
      ++end;
    }
    const std::size_t sharing = end - i;
    if (sharing == 1) count(result.open, scene, edges[i]);
    if (sharing > 2) count(result.nonManifold, scene, edges[i]);
    if (sharing == 2 && edges[i].isRising == edges[i + 1].isRising &&
        edges[i].mesh == edges[i + 1].mesh) {
      count(result.flipped, scene, edges[i]);
    }
    i = end;
  }
  return result;
}

}  // namespace bumper::doctor
