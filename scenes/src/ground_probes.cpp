#include "ground_probes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "box_tree.h"

namespace bumper {

namespace {

/// Ground bends by less than 15°, and steps by no more than this, m, where it goes on.
constexpr double minEvenness = 0.966;
constexpr double maxStep = 0.03;

std::vector<TriangleCorners> flatTriangles(const Scene& scene, const std::vector<bool>& isWall) {
  std::vector<TriangleCorners> flat;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    if (isWall[i]) continue;
    const TriangleCorners triangle = cornersOf(scene, scene.triangles[i]);
    if (upwardNormal(triangle).z() >= minGroundNormalUp * minEvenness) flat.push_back(triangle);
  }
  return flat;
}

}  // namespace

bool covers(const TriangleCorners& triangle, const Vector2& place) {
  const Vector2 a = triangle[0].head<2>() - place;
  const Vector2 b = triangle[1].head<2>() - place;
  const Vector2 c = triangle[2].head<2>() - place;
  const double ab = cross(a, b);
  const double bc = cross(b, c);
  const double ca = cross(c, a);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

Eigen::Vector3d upwardNormal(const TriangleCorners& triangle) {
  const Eigen::Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  return (normal.z() < 0.0 ? -normal : normal).normalized();
}

double heightOfPlane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                     const Vector2& place) {
  return point.z() - (place - point.head<2>()).dot(normal.head<2>()) / normal.z();
}

std::vector<bool> onGround(const std::vector<GroundProbe>& probes, const Scene& scene,
                           const std::vector<bool>& isWall) {
  std::vector<bool> found(probes.size(), false);
  if (probes.empty()) return found;
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(probes.size());
  const Eigen::Vector3d aside = maxStep * Eigen::Vector3d::UnitZ();
  for (const GroundProbe& probe : probes) {
    boxes.emplace_back(probe.place - aside, probe.place + aside);
  }
  const BoxTree tree(boxes);
  const std::vector<TriangleCorners> flat = flatTriangles(scene, isWall);
  std::size_t visits = maxVisits * (probes.size() + flat.size());
  for (const TriangleCorners& triangle : flat) {
    const auto enter = [&](double /*distance2*/, double /*low*/, double /*high*/) {
      if (visits == 0) return false;
      --visits;
      return true;
    };
    tree.search(boxOf(triangle), 0.0, enter, [&](std::uint32_t i) {
      const GroundProbe& probe = probes[i];
      if (found[i] || !covers(triangle, probe.place.head<2>())) return;
      const Eigen::Vector3d normal = upwardNormal(triangle);
      const double height = heightOfPlane(triangle[0], normal, probe.place.head<2>());
      found[i] =
          normal.dot(probe.normal) >= minEvenness && std::abs(height - probe.place.z()) <= maxStep;
    });
  }
  if (visits == 0) found.assign(probes.size(), true);
  return found;
}

}  // namespace bumper
