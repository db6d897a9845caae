#include "bumper/scenes/wall_parts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "corners.h"
#include "weld.h"

namespace bumper {

namespace {

std::vector<Corners> weldedCorners(const Scene& scene) {
  const std::vector<std::uint32_t> welded = weld(scene.vertices);
  std::vector<Corners> corners(scene.triangles.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) corners[i][k] = welded[scene.triangles[i].corners[k]];
  }
  return corners;
}

void include(WallPart& part, const WallPart& wall) {
  if (part.kind == WallPart::Kind::none) {
    part = {.kind = WallPart::Kind::cap, .foot = wall.foot, .top = wall.top};
    return;
  }
  part.foot = std::min(part.foot, wall.foot);
  part.top = std::max(part.top, wall.top);
}

}  // namespace

std::vector<WallPart> wallParts(const Scene& scene, const Walls& walls) {
  const std::vector<Corners> corners = weldedCorners(scene);
  std::vector<WallPart> parts(scene.triangles.size());
  TriangleTable faces(walls.walls.size());
  std::vector<std::size_t> faceOf;  // by number in that table: one of its walls
  std::vector<WallPart> upperEdge(scene.vertices.size());  // by corner
  for (const Wall& wall : walls.walls) {
    const WallPart face{.kind = WallPart::Kind::face, .foot = wall.foot, .top = wall.top};
    const Corners& own = corners[static_cast<std::size_t>(wall.triangle)];
    parts[static_cast<std::size_t>(wall.triangle)] = face;
    if (faces.insert(sorted(own))) faceOf.push_back(static_cast<std::size_t>(wall.triangle));
    for (const std::uint32_t corner : own) {
      // A top may slope; its corners lie in the upper half all the same.
      if (scene.vertices[corner].z() > 0.5 * (wall.foot + wall.top)) {
        include(upperEdge[corner], face);
      }
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].kind == WallPart::Kind::face) continue;
    const std::uint32_t skin = faces.find(sorted(corners[i]));
    if (skin != noIndex) {
      parts[i] = parts[faceOf[skin]];
      continue;
    }
    for (const std::uint32_t corner : corners[i]) {
      if (upperEdge[corner].kind != WallPart::Kind::none) include(parts[i], upperEdge[corner]);
    }
  }
  return parts;
}

}  // namespace bumper
