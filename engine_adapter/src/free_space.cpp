#include "free_space.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "guard_contacts.h"
#include "ode_vectors.h"

namespace bumper {

struct FreeSpace::Room {
  bool anyHeading;        // room for the vehicle to turn round
  double aside;           // by which it may move to either side, m
  double turn;            // by which it may turn otherwise, rad
  double moreSpeed;       // times as fast as now it may become …
  double speedAllowance;  // … and this more, m/s
};

namespace {

// Allowed increase of the loads on a vehicle before the next search.
constexpr double moreForce = 4.0;
constexpr double accelerationAllowance = 4.0;     // m/s²
constexpr double yawAccelerationAllowance = 4.0;  // rad/s²
constexpr double moreTurning = 1.5;
constexpr double turningAllowance = 0.3;  // rad/s

// By how much the world's gravity may change between two searches, m/s².
constexpr double gravityAllowance = 1000.0;

// By how much the vehicle may lean over more than now, rad.
constexpr double moreTilt = 0.05;

// Mass and inertia are read at each search. Until the next they may change by a fifth.
constexpr double massChange = 1.2;
constexpr int stepsBetweenLooks = 256;
constexpr int stepsAfterFailure = 8;

// The corridor's length: the distance covered in this time, s, within limits, m. A vehicle slower
// than this, m/s, may move in any direction.
constexpr double timeAhead = 1.0;
constexpr double leastAhead = 2.0;
constexpr double leastBehind = 0.25;
constexpr double mostAhead = 32.0;
constexpr double slow = 1.0;

// A corridor that the vehicle leaves within so few steps is not worth a search.
constexpr double fewestSteps = 4.0;

// More than rounding, m.
constexpr double slack = 1e-5;

double square(double value) { return value * value; }

// How far from its line in the yaw plane a wall may be, m for each m of the band's height. Faces
// that lean further are not walls.
double leanAsSeen(double wallLean, double tilt) {
  constexpr double most = 10.0;
  const double angle = std::atan(wallLean) + tilt;
  return angle < std::atan(most) ? std::tan(angle) : most;
}

}  // namespace

FreeSpace::FreeSpace(const VehicleBodies& bodies, const Envelope& envelope, double minUprightness)
    : envelope_(envelope),
      minUprightness_(minUprightness),
      rotation_(bodies.numbers().front().rotation),
      quaternion_(dBodyGetQuaternion(bodies.chassis())),
      turning_(bodies.numbers().front().turning) {
  for (const BodyNumbers& body : bodies.numbers()) {
    bodies_.push_back({.position = body.position,
                       .velocity = body.velocity,
                       .force = body.force,
                       .torque = body.torque});
  }
}

void FreeSpace::allowMotion(const VehicleState& state, const Room& room) {
  double speed2 = 0.0;
  for (const Body& body : bodies_) speed2 = std::max(speed2, squaredNorm(body.velocity));
  speedWeight_ = 1.0 / square(room.moreSpeed * std::sqrt(speed2) + room.speedAllowance);
  const auto count = static_cast<double>(bodies_.size());
  double torque = 0.0;
  for (Body& body : bodies_) {
    body.forceWeight = 1.0 / square(moreForce * std::sqrt(squaredNorm(body.force)) +
                                    accelerationAllowance * state.mass / count);
    torque = std::max(torque, std::sqrt(squaredNorm(body.torque)));
  }
  torqueWeight_ =
      1.0 / square(moreForce * torque + yawAccelerationAllowance * state.yawInertia / count);
  turningWeight_ = 1.0 / square(moreTurning * std::sqrt(squaredNorm(turning_)) + turningAllowance);
}

// Whether the vehicle has such a corridor; it is shortened if that helps.
bool FreeSpace::fits(const std::vector<std::unique_ptr<Barrier>>& barriers,
                     const VehicleState& state, const Room& room, double gravity, double h) {
  allowMotion(state, room);
  const auto count = static_cast<double>(bodies_.size());
  const double speed = 1.0 / std::sqrt(speedWeight_);
  double forces = 0.0;
  double arm = 0.0;
  for (const Body& body : bodies_) {
    forces += 1.0 / std::sqrt(body.forceWeight);
    arm = std::max(arm, (toVector(body.position) - state.massCentre).norm());
  }
  const double acceleration = massChange * forces / state.mass + gravity + gravityAllowance;
  const double way = h * (speed + h * acceleration);
  const double near = guardDistance(speed, h);
  const double tilt = std::acos(std::clamp(leastUp_, 0.0, 1.0));
  const Outline& outline = envelope_.outline();
  const double bandHeight = envelope_.bandHeight();
  const double height = std::max(std::abs(envelope_.low()), std::abs(envelope_.high()));

  // The vehicle's extent in the horizontal plane, with the guard distance and its motion in the
  // step.
  const Eigen::Vector2d along(forwardX_, forwardY_);
  const Eigen::Vector2d across = turnedLeft(along);
  double front = 0.0;
  double rear = 0.0;
  double side = 0.0;
  if (room.anyHeading) {
    const double zone = outline.enlarged(near).farthest();
    front = rear = side = std::hypot(std::max(zone, outline.radius() + way) + slack, height);
  } else {
    const double torques = count / std::sqrt(torqueWeight_);
    // While the bodies move separately.
    const double farthestArm = count > 1.0 ? 2.0 * arm : 0.0;
    const double yawAcceleration = massChange * (torques + farthestArm * forces) / state.yawInertia;
    const double turned =
        h * (1.0 / std::sqrt(turningWeight_) + h * yawAcceleration) * outline.radius();
    const PlanRectangle zone = outline.enlarged(std::max(near, way + turned) + slack);
    for (const double x : {zone.middle.x() - zone.half.x(), zone.middle.x() + zone.half.x()}) {
      for (const double y : {-zone.half.y(), zone.half.y()}) {
        for (const double z : {envelope_.low(), envelope_.high()}) {
          const Eigen::Vector2d corner = (state.axes * Eigen::Vector3d(x, y, z)).head<2>();
          front = std::max(front, along.dot(corner));
          rear = std::max(rear, -along.dot(corner));
          side = std::max(side, std::abs(across.dot(corner)));
        }
      }
    }
    const double more = room.turn * std::hypot(zone.farthest(), height);
    front += more;
    rear += more;
    side += more;
  }

  const double speedNow = state.velocity.head<2>().norm();
  double ahead = std::clamp(timeAhead * speedNow, leastAhead, mostAhead);
  const double wanted = std::min(fewestSteps * h * speedNow, 0.5 * ahead);
  // Most barriers are upright, or lean alike.
  double known = 0.0;
  double lean = bandHeight * leanAsSeen(known, tilt);
  for (const std::unique_ptr<Barrier>& barrier : barriers) {
    if (barrier->frame().moves()) continue;
    if (barrier->lean() != known) {
      known = barrier->lean();
      lean = bandHeight * leanAsSeen(known, tilt);
    }
    const PlanStrip strip{.origin = state.massCentre.head<2>(),
                          .direction = along,
                          .start = -(rear + lean + leastBehind),
                          .end = front + lean + ahead,
                          .halfWidth = side + lean + room.aside};
    ahead = std::min(ahead, barrier->freeUntil(strip, state.massCentre.z(), heightChange + height) -
                                (front + lean));
    if (!(ahead >= wanted)) return false;
  }
  anyHeading_ = room.anyHeading;
  halfLength_ = 0.5 * (ahead + leastBehind);
  halfWidth_ = room.aside;
  leastTurn_ = std::cos(0.5 * room.turn);
  const Eigen::Vector2d toMiddle = 0.5 * (ahead - leastBehind) * along;
  for (Body& body : bodies_) {
    body.x = body.position[0] + toMiddle.x();
    body.y = body.position[1] + toMiddle.y();
    body.z = body.position[2];
  }
  return true;
}

bool FreeSpace::find(const std::vector<std::unique_ptr<Barrier>>& barriers,
                     const VehicleState& state, double gravity, double h, int mostSteps) {
  // A larger corridor is valid for longer.
  static constexpr std::array<Room, 5> rooms = {
      {{.anyHeading = true, .aside = 2.0, .turn = 0.0, .moreSpeed = 1.2, .speedAllowance = 1.0},
       {.anyHeading = true, .aside = 0.6, .turn = 0.0, .moreSpeed = 1.2, .speedAllowance = 1.0},
       {.anyHeading = false, .aside = 0.8, .turn = 0.12, .moreSpeed = 1.1, .speedAllowance = 0.5},
       {.anyHeading = false, .aside = 0.3, .turn = 0.05, .moreSpeed = 1.1, .speedAllowance = 0.3},
       {.anyHeading = false,
        .aside = 0.08,
        .turn = 0.02,
        .moreSpeed = 1.06,
        .speedAllowance = 0.1}}};
  if (--stepsUntilLook_ > 0) return false;
  leastUp_ = std::max(std::cos(std::acos(std::clamp(state.up().z(), -1.0, 1.0)) + moreTilt),
                      minUprightness_);
  const Eigen::Vector2d velocity = state.velocity.head<2>();
  // Along its velocity; along the heading if at rest.
  const Eigen::Vector2d way =
      velocity.norm() > slow ? velocity : Eigen::Vector2d(state.axes.col(0).head<2>());
  forwardX_ = way.x() / way.norm();
  forwardY_ = way.y() / way.norm();
  std::copy_n(quaternion_, 4, heading_);
  for (const Room& room : rooms) {
    if (!fits(barriers, state, room, gravity, h)) continue;
    step_ = h;
    stepsLeft_ = std::min(stepsBetweenLooks, mostSteps);
    return true;
  }
  stepsUntilLook_ = stepsAfterFailure;
  return false;
}

}  // namespace bumper
