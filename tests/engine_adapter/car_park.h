#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "ode_world.h"

namespace bumper::tests {

/// Free cars on a plane without friction, and their responder.
class CarPark {
 public:
  explicit CarPark(const ResponderOptions& options = {}) : responder(ode.world, options) {}

  BoxCar& add(const Vector2& place, double yaw, const Vector2& velocity, double yawRate = 0.0) {
    cars.push_back(std::make_unique<BoxCar>(ode.world, ode.space));
    BoxCar& car = *cars.back();
    car.place({place.x(), place.y(), 0.55},
              Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix());
    car.move({velocity.x(), velocity.y(), 0.0}, {0.0, 0.0, yawRate});
    ids.push_back(responder.addVehicle(car.body, car.parameters));
    return car;
  }

  /// Steps for a time; calls `each(events)` after each step() and before the world steps.
  template <typename Call>
  void run(double time, double h, const Call& each) {
    const long steps = std::lround(time / h);
    for (long i = 0; i < steps; ++i) {
      ode.step(h, &responder, [&] { each(responder.step(h)); });
    }
  }
  void run(double time, double h) {
    run(time, h, [](auto&&) {});
  }

  /// By the law, with pending impulses.
  [[nodiscard]] double energy() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < cars.size(); ++i) {
      const VehicleParameters& car = cars[i]->parameters;
      const double yawRate = responder.yawRate(ids[i]);
      sum += 0.5 * car.mass * responder.velocity(ids[i]).squaredNorm() +
             0.5 * car.yawInertia * yawRate * yawRate;
    }
    return sum;
  }
  [[nodiscard]] Eigen::Vector3d momentum() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < cars.size(); ++i) {
      sum += cars[i]->parameters.mass * responder.velocity(ids[i]);
    }
    return sum;
  }

  OdeWorld ode;
  std::vector<std::unique_ptr<BoxCar>> cars;
  Responder responder;
  std::vector<VehicleId> ids;
};

/// How deep two rectangles overlap, m: the least way by which one has to move for them to be apart;
/// negative where they are. By their corners and the directions of their sides.
inline double overlapOf(const BoxCar& a, const BoxCar& b) {
  using Corners = std::array<Eigen::Vector2d, 4>;
  const auto axesOf = [](const BoxCar& car) {
    const dReal* r = dBodyGetRotation(car.body);
    return std::array<Eigen::Vector2d, 2>{Eigen::Vector2d(r[0], r[4]).normalized(),
                                          Eigen::Vector2d(-r[4], r[0]).normalized()};
  };
  const auto cornersOf = [&](const BoxCar& car) {
    const dReal* p = dBodyGetPosition(car.body);
    const auto [ahead, left] = axesOf(car);
    const double half = 0.5 * car.parameters.width;
    Corners corners;
    std::size_t i = 0;
    for (const double x : {car.parameters.massCentreToFront, -car.parameters.massCentreToRear}) {
      for (const double y : {half, -half}) {
        corners[i++] = Eigen::Vector2d(p[0], p[1]) + x * ahead + y * left;
      }
    }
    return corners;
  };
  const Corners one = cornersOf(a);
  const Corners other = cornersOf(b);
  double depth = 1e9;
  for (const BoxCar* car : {&a, &b}) {
    for (const Eigen::Vector2d& axis : axesOf(*car)) {
      const auto extent = [&](const Corners& corners) {
        std::pair<double, double> range{1e9, -1e9};
        for (const Eigen::Vector2d& corner : corners) {
          range.first = std::min(range.first, axis.dot(corner));
          range.second = std::max(range.second, axis.dot(corner));
        }
        return range;
      };
      const auto [low, high] = extent(one);
      const auto [itsLow, itsHigh] = extent(other);
      depth = std::min({depth, high - itsLow, itsHigh - low});
    }
  }
  return depth;
}

}  // namespace bumper::tests
