#include "standing_car.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace bumper::tests {

StandingCar carOn(const std::array<Eigen::Vector3d, 4>& wheels, double overhang, double bottom,
                  double top) {
  const Eigen::Vector3d front = 0.5 * (wheels[0] + wheels[1]);
  const Eigen::Vector3d rear = 0.5 * (wheels[2] + wheels[3]);
  const Eigen::Vector3d left = 0.5 * (wheels[0] + wheels[2]);
  const Eigen::Vector3d right = 0.5 * (wheels[1] + wheels[3]);
  StandingCar car;
  car.axes.col(0) = (front - rear).normalized();
  car.axes.col(2) = car.axes.col(0).cross(left - right).normalized();
  car.axes.col(1) = car.axes.col(2).cross(car.axes.col(0));
  car.half = {0.5 * (front - rear).norm() + overhang, 0.5 * (left - right).norm(),
              0.5 * (top - bottom)};
  car.middle = 0.5 * (front + rear) + 0.5 * (bottom + top) * car.axes.col(2);
  return car;
}

bool touches(const StandingCar& car, const std::array<Eigen::Vector3d, 3>& triangle) {
  std::vector<Eigen::Vector3d> polygon;
  polygon.reserve(triangle.size());
  for (const Eigen::Vector3d& corner : triangle) {
    polygon.emplace_back(car.axes.transpose() * (corner - car.middle));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto inside = [&](const Eigen::Vector3d& p) { return car.half[axis] - side * p[axis]; };
      std::vector<Eigen::Vector3d> rest;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector3d& from = polygon[i];
        const Eigen::Vector3d& to = polygon[(i + 1) % polygon.size()];
        const double a = inside(from);
        const double b = inside(to);
        if (a >= 0.0) rest.push_back(from);
        if ((a < 0.0) != (b < 0.0)) rest.emplace_back(from + a / (a - b) * (to - from));
      }
      polygon = rest;
      if (polygon.empty()) return false;
    }
  }
  return true;
}

std::set<std::vector<double>> touchingWalls(const StandingCar& car,
                                            const std::vector<Wall>& walls) {
  std::set<std::vector<double>> result;
  const double radius = car.half.norm();
  for (const Wall& wall : walls) {
    const auto& [a, b, c] = wall.corners;
    const Eigen::Vector3d low = a.cwiseMin(b).cwiseMin(c).array() - radius;
    const Eigen::Vector3d high = a.cwiseMax(b).cwiseMax(c).array() + radius;
    if ((car.middle.array() < low.array()).any() || (car.middle.array() > high.array()).any()) {
      continue;
    }
    if (!touches(car, wall.corners)) continue;
    std::vector<std::vector<double>> corners;
    for (const Eigen::Vector3d& p : wall.corners) corners.push_back({p.x(), p.y(), p.z()});
    std::sort(corners.begin(), corners.end());
    std::vector<double> key;
    for (const std::vector<double>& corner : corners) {
      key.insert(key.end(), corner.begin(), corner.end());
    }
    result.insert(key);
  }
  return result;
}

}  // namespace bumper::tests
