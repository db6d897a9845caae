#include "roadside.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace bumper::tests {

using Eigen::Vector2d;
using Eigen::Vector3d;

Roadside::Roadside() {
  scene.name = "roadside";
  scene.meshes.push_back({.name = "ground", .material = "asphalt", .colour = {0.4F, 0.4F, 0.4F}});
  scene.meshes.push_back({.name = "rail", .material = "steel", .colour = {0.7F, 0.7F, 0.7F}});
}

void Roadside::addQuad(Mesh mesh, const Vector3d& a, const Vector3d& b, const Vector3d& c,
                       const Vector3d& d) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), {a, b, c, d});
  scene.triangles.push_back({.corners = {first, first + 1, first + 2}, .mesh = mesh});
  scene.triangles.push_back({.corners = {first, first + 2, first + 3}, .mesh = mesh});
}

void Roadside::addFloor(const Vector2d& low, const Vector2d& high, double height) {
  addQuad(ground, {low.x(), low.y(), height}, {high.x(), low.y(), height},
          {high.x(), high.y(), height}, {low.x(), high.y(), height});
}

void Roadside::addPlanks(const Vector2d& low, const Vector2d& high, double height, double width,
                         double joint) {
  const int count = static_cast<int>((high.x() - low.x()) / (width + joint)) + 1;
  for (int i = 0; i < count; ++i) {
    const double x = low.x() + i * (width + joint);
    addFloor({x, low.y()}, {x + width, high.y()}, height);
  }
}

void Roadside::addBeam(const std::vector<Vector2d>& section, double from, double to, int pieces) {
  for (int i = 0; i < pieces; ++i) {
    const double begin = from + (to - from) * i / pieces;
    const double end = from + (to - from) * (i + 1) / pieces;
    for (std::size_t k = 0; k + 1 < section.size(); ++k) {
      const Vector2d& a = section[k];
      const Vector2d& b = section[k + 1];
      addQuad(rail, {begin, a.x(), a.y()}, {end, a.x(), a.y()}, {end, b.x(), b.y()},
              {begin, b.x(), b.y()});
    }
  }
}

void Roadside::addRail(double y, double height, double from, double to) {
  for (const double each : {y, y + 0.1}) {
    addBeam({{each, height + 0.3}, {each, height + 0.8}}, from, to);
  }
}

std::vector<Vector3d> tubeSection(const Vector3d& from, const Vector3d& to, double radius,
                                  int sides, double turn) {
  const Vector3d axis = (to - from).normalized();
  const Vector3d aside = axis.unitOrthogonal();
  const Vector3d across = axis.cross(aside);
  std::vector<Vector3d> section;
  for (int k = 0; k < sides; ++k) {
    const double angle = turn + 2.0 * std::numbers::pi * k / sides;
    section.emplace_back(radius * (std::cos(angle) * aside + std::sin(angle) * across));
  }
  return section;
}

void Roadside::addTube(const Vector3d& from, const Vector3d& to, double radius, int sides,
                       double turn) {
  const std::vector<Vector3d> section = tubeSection(from, to, radius, sides, turn);
  for (std::size_t k = 0; k < section.size(); ++k) {
    const Vector3d& a = section[k];
    const Vector3d& b = section[(k + 1) % section.size()];
    addQuad(rail, from + a, to + a, to + b, from + b);
  }
}

void Roadside::turn(double yaw) {
  const Eigen::AngleAxisd turned(yaw, Vector3d::UnitZ());
  for (Vector3d& vertex : scene.vertices) vertex = turned * vertex;
}

}  // namespace bumper::tests
