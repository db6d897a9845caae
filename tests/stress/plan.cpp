#include "plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <string>

namespace bumper::tests {

double intrusion(const VehicleParameters& vehicle, const PlanarMotion& pose, const Line& wall) {
  const Vector2 a = rotated(wall.start - pose.position, -pose.yaw);
  const Vector2 b = rotated(wall.end - pose.position, -pose.yaw);
  // Distance inside each of the four sides at the wall's start, and its change to the wall's end.
  const double halfWidth = 0.5 * vehicle.width;
  const std::array<double, 4> inside{vehicle.massCentreToFront - a.x(),
                                     vehicle.massCentreToRear + a.x(), halfWidth - a.y(),
                                     halfWidth + a.y()};
  const std::array<double, 4> change{a.x() - b.x(), b.x() - a.x(), a.y() - b.y(), b.y() - a.y()};
  const auto depthAt = [&](double share) {
    double least = inside[0] + share * change[0];
    for (std::size_t i = 1; i < 4; ++i) least = std::min(least, inside[i] + share * change[i]);
    return least;
  };
  // The least of four straight lines is highest at an end or where two of them cross.
  double deepest = std::max(depthAt(0.0), depthAt(1.0));
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double share = (inside[k] - inside[i]) / (change[i] - change[k]);
      if (share > 0.0 && share < 1.0) deepest = std::max(deepest, depthAt(share));
    }
  }
  return std::max(deepest, 0.0);
}

double deepestIntrusion(const VehicleParameters& vehicle, const PlanarMotion& pose,
                        std::span<const Line> plan) {
  double deepest = 0.0;
  for (const Line& wall : plan) deepest = std::max(deepest, intrusion(vehicle, pose, wall));
  return deepest;
}

double slidingDepth(const VehicleParameters& vehicle, const PlanarMotion& motion, double h) {
  constexpr double touch = 2e-3;  // m: what may add up over the steps before it is eased out
  const double radius = std::hypot(std::max(vehicle.massCentreToFront, vehicle.massCentreToRear),
                                   0.5 * vehicle.width);
  const double turning = std::abs(motion.yawRate);
  const double acceleration = 2.0 * turning * motion.velocity.norm() + turning * turning * radius;
  const double between = h / 12.0;
  constexpr double looks = 4.0;  // what one leaves the next may find
  return touch + looks * 0.5 * acceleration * between * between;
}

bool leadsThrough(const Vector2& from, const Vector2& to, std::span<const Line> plan) {
  const Vector2 way = to - from;
  return std::any_of(plan.begin(), plan.end(), [&](const Line& wall) {
    const Vector2 along = wall.end - wall.start;
    return cross(way, wall.start - from) * cross(way, wall.end - from) < 0.0 &&
           cross(along, from - wall.start) * cross(along, to - wall.start) < 0.0;
  });
}

Plan slab(const Line& middle, double thickness) {
  const Vector2 aside = 0.5 * thickness * turnedLeft((middle.end - middle.start).normalized());
  const std::array<Vector2, 4> corners{middle.start - aside, middle.end - aside, middle.end + aside,
                                       middle.start + aside};
  Plan plan;
  for (std::size_t i = 0; i < 4; ++i) plan.push_back({corners[i], corners[(i + 1) % 4]});
  return plan;
}

std::vector<Segment> segmentsOf(const Plan& plan) {
  std::vector<Segment> walls;
  for (const Line& line : plan) {
    walls.push_back({.start = line.start,
                     .end = line.end,
                     .normal = turnedLeft((line.end - line.start).normalized()),
                     .id = static_cast<int>(walls.size())});
  }
  return walls;
}

Plan polygon(double radius, std::size_t sides) {
  const auto corner = [&](std::size_t i) -> Vector2 {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sides);
    return {radius * std::cos(angle), radius * std::sin(angle)};
  };
  Plan plan;
  for (std::size_t i = 0; i < sides; ++i) plan.push_back({corner(i), corner((i + 1) % sides)});
  return plan;
}

Scene standing(std::span<const Line> plan, double height, std::size_t panels, std::size_t rows) {
  Scene scene;
  scene.name = "walls";
  scene.meshes.push_back({.name = "walls", .material = "", .colour = {0.7F, 0.7F, 0.7F}});
  for (const Line& wall : plan) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (std::size_t row = 0; row <= rows; ++row) {
      const double z = height * static_cast<double>(row) / static_cast<double>(rows);
      for (std::size_t panel = 0; panel <= panels; ++panel) {
        const double share = static_cast<double>(panel) / static_cast<double>(panels);
        const Vector2 place = (1.0 - share) * wall.start + share * wall.end;
        scene.vertices.emplace_back(place.x(), place.y(), z);
      }
    }
    const auto width = static_cast<std::uint32_t>(panels + 1);
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t panel = 0; panel < panels; ++panel) {
        const std::uint32_t corner = first + row * width + panel;
        scene.triangles.push_back({.corners = {corner, corner + 1, corner + width + 1}, .mesh = 0});
        scene.triangles.push_back(
            {.corners = {corner, corner + width + 1, corner + width}, .mesh = 0});
      }
    }
  }
  return scene;
}

std::ostream& printExactly(std::ostream& out, const VehicleParameters& vehicle,
                           const PlanarMotion& motion, std::span<const Line> plan) {
  out << std::setprecision(17) << "vehicle: mass " << vehicle.mass << ", yaw inertia "
      << vehicle.yawInertia << ", front " << vehicle.massCentreToFront << ", rear "
      << vehicle.massCentreToRear << ", width " << vehicle.width << "\nmotion: position ("
      << motion.position.x() << ", " << motion.position.y() << "), yaw " << motion.yaw
      << ", velocity (" << motion.velocity.x() << ", " << motion.velocity.y() << "), yaw rate "
      << motion.yawRate << '\n';
  for (const Line& wall : plan) {
    out << "wall (" << wall.start.x() << ", " << wall.start.y() << ") to (" << wall.end.x() << ", "
        << wall.end.y() << ")\n";
  }
  return out;
}

}  // namespace bumper::tests
