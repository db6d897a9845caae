#pragma once

#include <ode/ode.h>

#include <cmath>
#include <memory>
#include <vector>

#include "barrier.h"
#include "bumper/response/contact_point.h"
#include "vehicle_bodies.h"

namespace bumper {

/// Room around a vehicle without any wall, and the motion for which it cannot reach one within a
/// step: as long as the vehicle is in that room and no faster than that, its step is skipped.
///
/// The room is a strip along the vehicle's forward axis, in the horizontal plane. It is found with
/// the barriers' clearance maps, and holds whatever the walls' heights.
class FreeSpace {
 public:
  FreeSpace(const VehicleBodies& bodies, const VehicleParameters& parameters, const Band& band,
            double minUprightness);

  /// Whether the vehicle is certainly out of every wall's reach in the coming step of `h` seconds.
  /// A comparison of what its bodies are and do now; false if in doubt.
  [[nodiscard]] bool holds(double h);

  /// Looks for such room, and returns whether there is. `gravity` is the world's, m/s²,
  /// `penetrationTime` the longest of the barriers' settings.
  bool find(const std::vector<std::unique_ptr<Barrier>>& barriers, const VehicleState& state,
            double gravity, double penetrationTime, double h);

  /// Nothing is known: barriers have changed.
  void forget() {
    step_ = 0.0;
    stepsUntilLook_ = 0;
  }

 private:
  // What ODE keeps of a body. These addresses do not change while the body lives.
  struct Body {
    const dReal* position;
    const dReal* velocity;
    const dReal* force;
    const dReal* torque;
    double x, y, z;  // its place when the room was found
  };

  struct Strip {
    double ahead = 0.0;   // m, by which the vehicle can move on
    double behind = 0.0;  // m, by which it can move back
    double aside = 0.0;   // m, by which it can move to either side
    double middle = 0.0;  // of the way from -behind to ahead, m
    double half = 0.0;    // of its length, m
  };

  // How far the vehicle's up axis may turn, rad, and it may rise or sink, m.
  static constexpr double upTurn = 0.05;
  static constexpr double heightChange = 16.0;

  // Less than the cosine of an angle, rad.
  static constexpr double cosineOf(double angle) { return 1.0 - 0.5 * angle * angle; }
  static double squaredNorm(const dReal* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

  void allowMotion(const VehicleState& state);
  [[nodiscard]] double reachOfAllowed(const VehicleState& state, double gravity,
                                      double penetrationTime, double h) const;
  [[nodiscard]] bool fits(const std::vector<std::unique_ptr<Barrier>>& barriers,
                          const VehicleState& state, double reach, double turn, double spacing);

  VehicleParameters parameters_;
  Outline outline_;
  double low_;  // the band in the vehicle's frame
  double high_;
  double minUprightness_;

  std::vector<Body> bodies_;
  const dReal* rotation_;
  const dReal* turning_;

  double step_ = 0.0;  // the longest step for which it holds, s; 0: nothing is known
  int stepsLeft_ = 0;
  int stepsUntilLook_ = 0;
  Strip strip_;
  double leastForward_ = 1.0;  // cosine of the turn that is allowed
  double forwardX_ = 0.0;      // the strip's direction
  double forwardY_ = 0.0;
  Eigen::Vector3d forward_ = Eigen::Vector3d::Zero();  // the vehicle's axes then
  Eigen::Vector3d up_ = Eigen::Vector3d::Zero();

  // What is allowed, as squares.
  double speed2_ = 0.0;    // of each body
  double turning2_ = 0.0;  // of the chassis
  double force2_ = 0.0;    // of all bodies together
  double torque2_ = 0.0;
};

// Here, because it is all that most steps do.
inline bool FreeSpace::holds(double h) {
  if (!(h <= step_) || --stepsLeft_ < 0) return false;
  const dReal* r = rotation_;
  const double forward = r[0] * forward_.x() + r[4] * forward_.y() + r[8] * forward_.z();
  const double up = r[2] * up_.x() + r[6] * up_.y() + r[10] * up_.z();
  // A number that is not finite fails its comparison.
  bool inside =
      forward >= leastForward_ && up >= cosineOf(upTurn) && squaredNorm(turning_) <= turning2_;
  double force2 = 0.0;
  double torque2 = 0.0;
  for (const Body& body : bodies_) {
    const double x = body.position[0] - body.x;
    const double y = body.position[1] - body.y;
    const double along = x * forwardX_ + y * forwardY_ - strip_.middle;
    const double across = y * forwardX_ - x * forwardY_;
    inside = inside && std::abs(along) <= strip_.half && std::abs(across) <= strip_.aside &&
             std::abs(body.position[2] - body.z) <= heightChange &&
             squaredNorm(body.velocity) <= speed2_;
    force2 += squaredNorm(body.force);
    torque2 += squaredNorm(body.torque);
  }
  return inside && force2 <= force2_ && torque2 <= torque2_;
}

}  // namespace bumper
