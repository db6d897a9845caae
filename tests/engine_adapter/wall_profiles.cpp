#include "wall_profiles.h"

#include <cmath>
#include <random>

namespace bumper::tests {

namespace {

WallProfile plinth(double depth, double height) {
  return {.name = "plinth " + std::to_string(depth) + " deep, " + std::to_string(height) + " tall",
          .points = {{-depth, 0.0}, {-depth, height}, {0.0, height}, {0.0, 1.2}}};
}

// Steps of up to 8 cm below 0.4 m.
WallProfile rocks(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> out(0.0, 0.08);
  std::uniform_real_distribution<double> up(0.02, 0.08);
  WallProfile profile{.name = "rocks " + std::to_string(seed), .points = {{-0.08, 0.0}}};
  for (double z = up(random); z < 0.4; z += up(random))
    profile.points.emplace_back(-out(random), z);
  profile.points.emplace_back(0.0, 0.4);
  profile.points.emplace_back(0.0, 1.2);
  return profile;
}

}  // namespace

std::vector<WallProfile> wallProfiles() {
  std::vector<WallProfile> all{{.name = "flush", .points = {{0.0, 0.0}, {0.0, 1.2}}}};
  for (const double height : {0.05, 0.1, 0.25, 0.4}) all.push_back(plinth(0.05, height));
  for (const double depth : {0.1, 0.2, 0.3, 0.4}) all.push_back(plinth(depth, 0.25));
  all.push_back({.name = "New Jersey",
                 .points = {{-0.178, 0.0}, {-0.178, 0.075}, {0.0, 0.33}, {0.05, 0.81}}});
  all.push_back(
      {.name = "F shape", .points = {{-0.103, 0.0}, {-0.103, 0.075}, {0.0, 0.255}, {0.06, 0.81}}});
  const double lean = std::tan(11.0 / 180.0 * 3.141592653589793);
  all.push_back({.name = "single slope", .points = {{-0.3 * lean, 0.0}, {0.51 * lean, 0.81}}});
  all.push_back({.name = "behind a sidewalk",
                 .points = {{-1.5, 0.0}, {-1.5, 0.15}, {0.0, 0.15}, {0.0, 1.2}},
                 .groundZ = 0.15,
                 .ground = 2});
  for (unsigned seed = 1; seed <= 3; ++seed) all.push_back(rocks(seed));
  return all;
}

ProfileScene::ProfileScene(const WallProfile& profile, double fineness,
                           const Eigen::Isometry3d& place) {
  constexpr double length = 16.0;
  constexpr double roadWidth = 2.0;
  scene.meshes.push_back({.name = "wall", .material = "", .colour = {0.5F, 0.5F, 0.5F}});
  std::vector<Eigen::Vector2d> points = profile.points;
  points.insert(points.begin(), {points.front().x() - roadWidth, 0.0});
  const auto count = [&](double size) {
    return static_cast<std::size_t>(std::ceil(size / fineness - 1e-9));
  };
  const std::size_t along = count(length);
  for (std::size_t piece = 0; piece + 1 < points.size(); ++piece) {
    const std::size_t across = count((points[piece + 1] - points[piece]).norm());
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (std::size_t i = 0; i <= across; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(across);
      const Eigen::Vector2d point = (1.0 - share) * points[piece] + share * points[piece + 1];
      for (std::size_t j = 0; j <= along; ++j) {
        const double y = length * (static_cast<double>(j) / static_cast<double>(along) - 0.5);
        scene.vertices.push_back(place * Eigen::Vector3d(point.x(), y, point.y()));
      }
    }
    const auto vertex = [&](std::size_t i, std::size_t j) {
      return first + static_cast<std::uint32_t>(i * (along + 1) + j);
    };
    for (std::size_t i = 0; i < across; ++i) {
      for (std::size_t j = 0; j < along; ++j) {
        scene.triangles.push_back(
            {.corners = {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)}, .mesh = 0});
        scene.triangles.push_back(
            {.corners = {vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)}, .mesh = 0});
        pieceOf.insert(pieceOf.end(), 2, piece);
      }
    }
  }
}

}  // namespace bumper::tests
