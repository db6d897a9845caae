#include "ground.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace bumper::doctor {

Ground::Ground(const Subject& subject)
    : mesh_(subject.scene.triangles.size()), ray_(dCreateRay(nullptr, 1.0)) {
  const Scene& scene = subject.scene;
  const std::vector<bool> scenery = matchingMeshes(scene, subject.scenery);
  for (const Scene::Triangle& triangle : scene.triangles) {
    if (scenery[triangle.mesh]) continue;
    const Eigen::Vector3d& a = scene.corner(triangle, 0);
    const Eigen::Vector3d& b = scene.corner(triangle, 1);
    const Eigen::Vector3d& c = scene.corner(triangle, 2);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    if (std::abs(normal.z()) > normal.head<2>().norm()) mesh_.add(a, b, c);
  }
  mesh_.build();
}

Ground::~Ground() { dGeomDestroy(ray_); }

std::vector<double> Ground::heightsAt(const Eigen::Vector2d& place, double bottom,
                                      double top) const {
  std::vector<double> heights;
  if (mesh_.geom() == nullptr || !(top > bottom)) return heights;
  constexpr int mostHits = 64;
  std::array<dContactGeom, mostHits> hits{};
  dGeomRaySetLength(ray_, top - bottom);
  dGeomRaySet(ray_, place.x(), place.y(), top, 0.0, 0.0, -1.0);
  const int count = dCollide(ray_, mesh_.geom(), mostHits, hits.data(), sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) heights.push_back(hits.at(static_cast<std::size_t>(i)).pos[2]);
  std::ranges::sort(heights);
  return heights;
}

}  // namespace bumper::doctor
