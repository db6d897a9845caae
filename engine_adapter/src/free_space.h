#pragma once

#include <ode/ode.h>

#include <cmath>
#include <memory>
#include <vector>

#include "barrier.h"
#include "envelope.h"
#include "vehicle_bodies.h"

namespace bumper {

/// A region around a vehicle without any wall, and limits of motion within which it cannot come
/// near one in a step: while the vehicle is in that region and within these limits, its step is
/// skipped.
///
/// The region is a corridor in the horizontal plane along the vehicle's path, wide enough for any
/// heading or, between walls, for the heading that the vehicle has. It is found with the barriers'
/// plans, and holds whatever the walls' heights.
class FreeSpace {
 public:
  /// The envelope must live as long.
  FreeSpace(const VehicleBodies& bodies, const Envelope& envelope, double minUprightness);

  /// Whether the vehicle certainly touches no wall in the coming step of `h` seconds, and is not
  /// within guardDistance() of one. Compares its bodies' current state with the limits; false if in
  /// doubt.
  [[nodiscard]] bool holds(double h);

  /// Searches for such a region after leave(), and returns whether there is one. `gravity` is the
  /// world's, m/s²; the result is valid for no more than `mostSteps`.
  bool find(const std::vector<std::unique_ptr<Barrier>>& barriers, const VehicleState& state,
            double gravity, double h, int mostSteps);

  /// The vehicle has left it: it has to be found anew.
  void leave() { step_ = 0.0; }

  /// Nothing is known: barriers have changed.
  void forget() {
    leave();
    stepsUntilLook_ = 0;
  }

 private:
  // A body's BodyNumbers.
  struct Body {
    const dReal* position;
    const dReal* velocity;
    const dReal* force;
    const dReal* torque;
    double x = 0.0, y = 0.0, z = 0.0;  // its position in the middle of the corridor
    double forceWeight = 0.0;          // 1 over the square of the force that is allowed, 1/N²
  };

  // How far the vehicle may rise or sink, m.
  static constexpr double heightChange = 16.0;

  /// The size of the corridor searched for, and the changes of motion allowed in it.
  struct Room;

  static double squaredNorm(const dReal* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

  [[nodiscard]] bool keepsWithin(const Body& body) const;
  [[nodiscard]] bool keepsHeading() const;
  void allowMotion(const VehicleState& state, const Room& room);
  [[nodiscard]] bool fits(const std::vector<std::unique_ptr<Barrier>>& barriers,
                          const VehicleState& state, const Room& room, double gravity, double h);

  const Envelope& envelope_;
  double minUprightness_;

  std::vector<Body> bodies_;
  const dReal* rotation_;
  const dReal* quaternion_;  // ODE's own: only the angle between two counts
  const dReal* turning_;

  double step_ = 0.0;  // the longest step for which it holds, s; 0: nothing is known
  int stepsLeft_ = 0;
  int stepsUntilLook_ = 0;

  // The corridor: its direction, and how far the vehicle may be from its middle, m.
  double forwardX_ = 0.0;
  double forwardY_ = 0.0;
  double halfLength_ = 0.0;
  double halfWidth_ = 0.0;

  // What is allowed: weights are 1 over squares.
  double leastUp_ = 1.0;                        // vertical part of the vehicle's up axis
  double speedWeight_ = 0.0;                    // of each body
  bool anyHeading_ = false;                     // … if true, the rest is not checked
  double leastTurn_ = 1.0;                      // cosine of half the rotation
  double turningWeight_ = 0.0;                  // of the chassis
  double torqueWeight_ = 0.0;                   // of each body
  dQuaternion heading_ = {1.0, 0.0, 0.0, 0.0};  // when the room was found
};

// Inline, because most steps do nothing else. A number that is not finite fails its comparison.
inline bool FreeSpace::keepsWithin(const Body& body) const {
  const double x = body.position[0] - body.x;
  const double y = body.position[1] - body.y;
  return std::abs(x * forwardX_ + y * forwardY_) <= halfLength_ &&
         std::abs(y * forwardX_ - x * forwardY_) <= halfWidth_ &&
         std::abs(body.position[2] - body.z) <= heightChange &&
         speedWeight_ * squaredNorm(body.velocity) + body.forceWeight * squaredNorm(body.force) <=
             1.0;
}

inline bool FreeSpace::keepsHeading() const {
  const dReal* q = quaternion_;
  double turn = turningWeight_ * squaredNorm(turning_);
  for (const Body& body : bodies_) turn += torqueWeight_ * squaredNorm(body.torque);
  return turn <= 1.0 &&
         q[0] * heading_[0] + q[1] * heading_[1] + q[2] * heading_[2] + q[3] * heading_[3] >=
             leastTurn_;
}

inline bool FreeSpace::holds(double h) {
  if (!(h <= step_) || stepsLeft_ <= 0 || !(rotation_[10] >= leastUp_)) return false;
  --stepsLeft_;
  for (const Body& body : bodies_) {
    if (!keepsWithin(body)) return false;
  }
  return anyHeading_ || keepsHeading();
}

}  // namespace bumper
