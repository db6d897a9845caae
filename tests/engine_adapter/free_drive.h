#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "ode_world.h"

namespace bumper::tests {

/// Upright sheets, 1.5 m tall, through points of the ground plane.
inline void addSheets(Scene& scene, const std::vector<Eigen::Vector2d>& line) {
  if (scene.meshes.empty()) scene.meshes.emplace_back();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const double z : {0.0, 1.5}) {
      for (const Eigen::Vector2d& end : {line[i], line[i + 1]}) {
        scene.vertices.emplace_back(end.x(), end.y(), z);
      }
    }
    scene.triangles.push_back({.corners = {first, first + 1, first + 3}});
    scene.triangles.push_back({.corners = {first, first + 3, first + 2}});
  }
}

inline Scene sheets(const std::vector<Eigen::Vector2d>& line) {
  Scene scene;
  addSheets(scene, line);
  return scene;
}

/// A box car in a world without gravity, where nothing but Bumper and the test's forces act on it.
struct FreeDrive {
  explicit FreeDrive(const ResponderOptions& options = {})
      : responder(ode.world, options), car(ode.world) {}

  void start(const Eigen::Vector2d& place, double yaw, double speed) {
    car.place({place.x(), place.y(), car.parameters.massCentreHeight},
              Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix());
    car.move({speed * std::cos(yaw), speed * std::sin(yaw), 0.0}, Eigen::Vector3d::Zero());
    vehicle = responder.addVehicle(car.body, car.parameters, {.finiteRotation = true});
  }

  /// Returns the events of the step. `thrust` acts along the car, N.
  std::vector<ImpactEvent> step(double h, double thrust = 0.0) {
    dBodyAddRelForce(car.body, thrust, 0.0, 0.0);
    const auto found = responder.step(h);
    std::vector<ImpactEvent> events(found.begin(), found.end());
    dWorldStep(ode.world, h);
    return events;
  }

  [[nodiscard]] Eigen::Vector2d position() const {
    const dReal* place = dBodyGetPosition(car.body);
    return {place[0], place[1]};
  }
  /// Of the car's x axis.
  [[nodiscard]] Eigen::Vector2d ahead() const {
    const dReal* axes = dBodyGetRotation(car.body);
    return {axes[0], axes[4]};
  }
  /// Of a point of the car.
  [[nodiscard]] Eigen::Vector2d world(const Eigen::Vector2d& local) const {
    const Eigen::Vector2d x = ahead();
    return position() + local.x() * x + local.y() * Eigen::Vector2d(-x.y(), x.x());
  }
  /// Of the motion in the plane, J.
  [[nodiscard]] double energy() const {
    const double yawRate = car.angularVelocity().z();
    return 0.5 * car.parameters.mass * car.velocity().squaredNorm() +
           0.5 * car.parameters.yawInertia * yawRate * yawRate;
  }

  /// How far a wall reaches into the outline: of its points the greatest distance from the nearest
  /// side, m; negative if it is outside. That distance is concave along the wall.
  [[nodiscard]] double intrusion(const Eigen::Vector2d& start, const Eigen::Vector2d& end) const {
    const Eigen::Vector2d x = ahead();
    const Eigen::Vector2d y(-x.y(), x.x());
    const auto depth = [&](double share) {
      const Eigen::Vector2d seen = start + share * (end - start) - position();
      const double forward = x.dot(seen);
      return std::min({car.parameters.massCentreToFront - forward,
                       car.parameters.massCentreToRear + forward,
                       0.5 * car.parameters.width - std::abs(y.dot(seen))});
    };
    const double reach =
        std::max(car.parameters.massCentreToFront, car.parameters.massCentreToRear) +
        0.5 * car.parameters.width + (end - start).norm();
    if ((start - position()).norm() > reach) return -1.0;  // about
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 80; ++i) {
      const double third = (high - low) / 3.0;
      if (depth(low + third) < depth(high - third)) {
        low += third;
      } else {
        high -= third;
      }
    }
    return depth(0.5 * (low + high));
  }
  [[nodiscard]] double intrusion(const std::vector<Eigen::Vector2d>& line) const {
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      deepest = std::max(deepest, intrusion(line[i], line[i + 1]));
    }
    return deepest;
  }

  OdeWorld ode;
  Responder responder;
  BoxCar car;
  VehicleId vehicle;
};

}  // namespace bumper::tests
