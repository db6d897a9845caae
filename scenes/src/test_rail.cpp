#include <Eigen/LU>
#include <array>

#include "bumper/scenes/paper_scenes.h"
#include "sheet.h"

namespace bumper {

namespace {

constexpr double wallLength = 60.0;
constexpr double railHeight = 0.9;
constexpr double wallThickness = 0.3;
constexpr std::size_t wallPanels = 17;

struct Line {
  Eigen::Vector2d point;
  Eigen::Vector2d normal;  ///< unit, towards the car
};

Line sideWallLine() { return {{42.334, -0.900}, Eigen::Vector2d(-0.10453, 0.99452).normalized()}; }

Line endWallLine() { return {{67.197, 1.713}, Eigen::Vector2d(-0.98163, -0.19081).normalized()}; }

Eigen::Vector2d intersection(const Line& a, const Line& b) {
  Eigen::Matrix2d normals;
  normals << a.normal.transpose(), b.normal.transpose();
  return normals.inverse() * Eigen::Vector2d(a.normal.dot(a.point), b.normal.dot(b.point));
}

/// The way along a wall that has its face on the left.
Eigen::Vector2d wayAlong(const Line& line) { return {line.normal.y(), -line.normal.x()}; }

/// A slab behind the face from `start` along the wall.
void addSlab(Scene& scene, std::uint32_t mesh, const Eigen::Vector2d& start, const Line& line) {
  const Eigen::Vector2d behind = -wallThickness * line.normal;
  Sheet sheet{{}, 4, false, {mesh, mesh, mesh}};
  for (std::size_t i = 0; i <= wallPanels; ++i) {
    const double way = wallLength * static_cast<double>(i) / static_cast<double>(wallPanels);
    const Eigen::Vector2d front = start + way * wayAlong(line);
    const Eigen::Vector2d back = front + behind;
    sheet.points.insert(sheet.points.end(), {{front.x(), front.y(), 0.0},
                                             {front.x(), front.y(), railHeight},
                                             {back.x(), back.y(), railHeight},
                                             {back.x(), back.y(), 0.0}});
  }
  const std::uint32_t begin = addSheet(scene, sheet);
  const auto end = begin + static_cast<std::uint32_t>(4 * wallPanels);
  addQuad(scene, mesh, begin, begin + 3, begin + 2, begin + 1);
  addQuad(scene, mesh, end, end + 1, end + 2, end + 3);
}

void addGround(Scene& scene) {
  constexpr std::size_t along = 20;
  constexpr std::size_t across = 10;
  const std::uint32_t mesh = addMesh(scene, "ground", "asphalt", {0.35F, 0.36F, 0.38F});
  Sheet sheet{{}, across + 1, false, std::vector<std::uint32_t>(across, mesh)};
  for (std::size_t i = 0; i <= along; ++i) {
    for (std::size_t k = 0; k <= across; ++k) {
      sheet.points.emplace_back(-20.0 + 5.0 * static_cast<double>(i),
                                70.0 - 9.0 * static_cast<double>(k), 0.0);
    }
  }
  addSheet(scene, sheet);
}

}  // namespace

Scene testRail() {
  Scene scene;
  scene.name = "test_rail";
  const Eigen::Vector3f concrete(0.76F, 0.74F, 0.69F);
  const Line side = sideWallLine();
  const Line end = endWallLine();
  const Eigen::Vector2d corner = intersection(side, end);
  addSlab(scene, addMesh(scene, "side_wall", "concrete", concrete),
          corner - wallLength * wayAlong(side), side);
  addSlab(scene, addMesh(scene, "end_wall", "concrete", concrete), corner, end);
  addGround(scene);
  return scene;
}

}  // namespace bumper
