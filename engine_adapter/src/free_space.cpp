#include "free_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bumper/response/collision_step.h"
#include "ode_vectors.h"

namespace bumper {

namespace {

// How much faster than now the vehicle may become, and how much more may act on it, before one
// looks again.
constexpr double moreSpeed = 1.2;
constexpr double speedAllowance = 1.0;    // m/s
constexpr double turningAllowance = 0.3;  // rad/s
constexpr double moreForce = 1.5;
constexpr double accelerationAllowance = 2.0;     // m/s²
constexpr double yawAccelerationAllowance = 2.0;  // rad/s²

// Mass and inertia are read when one looks. Until the next time they may change by a fifth.
constexpr double massChange = 1.2;
constexpr int stepsBetweenLooks = 128;
constexpr int stepsAfterFailure = 8;

// The strip's length: what is passed in this time, s, within limits, m. A vehicle that is slower
// than that, m/s, may go any way.
constexpr double timeAhead = 1.0;
constexpr double leastAhead = 2.0;
constexpr double leastBehind = 0.25;
constexpr double mostAhead = 32.0;
constexpr double slow = 1.0;

// The widths of strips that are tried, m, the turns of the forward axis that go with them, rad, and
// how far apart they are looked at, m: the more room, the longer it lasts.
struct Width {
  double aside;
  double turn;
  double spacing;
};
constexpr std::array<Width, 4> widths = {
    {{2.0, 0.3, 4.0}, {1.0, 0.15, 3.0}, {0.5, 0.08, 2.0}, {0.15, 0.04, 1.0}}};

// A strip that the vehicle leaves within so many steps is not worth the look.
constexpr double fewestSteps = 4.0;

double square(double value) { return value * value; }

}  // namespace

FreeSpace::FreeSpace(const VehicleBodies& bodies, const VehicleParameters& parameters,
                     const Band& band, double minUprightness)
    : parameters_(parameters),
      outline_(parameters),
      low_(band.bottom - parameters.massCentreHeight),
      high_(band.top - parameters.massCentreHeight),
      minUprightness_(minUprightness),
      rotation_(dBodyGetRotation(bodies.chassis())),
      turning_(dBodyGetAngularVel(bodies.chassis())) {
  for (dBodyID body : bodies.all()) {
    bodies_.push_back({.position = dBodyGetPosition(body),
                       .velocity = dBodyGetLinearVel(body),
                       .force = dBodyGetForce(body),
                       .torque = dBodyGetTorque(body),
                       .x = 0.0,
                       .y = 0.0,
                       .z = 0.0});
  }
}

void FreeSpace::allowMotion(const VehicleState& state) {
  double speed2 = 0.0;
  double force2 = 0.0;
  double torque2 = 0.0;
  for (const Body& body : bodies_) {
    speed2 = std::max(speed2, squaredNorm(body.velocity));
    force2 += squaredNorm(body.force);
    torque2 += squaredNorm(body.torque);
  }
  speed2_ = square(moreSpeed * std::sqrt(speed2) + speedAllowance);
  turning2_ = square(moreSpeed * std::sqrt(squaredNorm(turning_)) + turningAllowance);
  force2_ = square(moreForce * std::sqrt(force2) + accelerationAllowance * state.mass);
  torque2_ = square(moreForce * std::sqrt(torque2) + yawAccelerationAllowance * state.yawInertia);
}

// How far any point of the outline comes in a step with the most that is allowed.
double FreeSpace::reachOfAllowed(const VehicleState& state, double gravity, double penetrationTime,
                                 double h) const {
  const double count = std::sqrt(static_cast<double>(bodies_.size()));
  // Sums of lengths, from the root of the sum of their squares.
  const double forces = count * std::sqrt(force2_);
  const double torques = count * std::sqrt(torque2_);
  double arm = 0.0;
  if (bodies_.size() > 1) {
    for (const Body& body : bodies_) {
      arm = std::max(arm, (toVector(body.position) - state.massCentre).norm());
    }
    // While the bodies move each for itself.
    arm += 2.0 * std::hypot(std::max(strip_.ahead, strip_.behind), strip_.aside, heightChange);
  }
  const double acceleration = massChange * forces / state.mass + gravity;
  const double yawAcceleration = massChange * (torques + arm * forces) / state.yawInertia;
  VehicleParameters vehicle = parameters_;
  vehicle.mass = state.mass;
  vehicle.yawInertia = state.yawInertia;
  const PlanarMotion motion{.velocity = {std::sqrt(speed2_) + h * acceleration, 0.0},
                            .yawRate = std::sqrt(turning2_) + h * yawAcceleration};
  return massChange * CollisionStep::reach(vehicle, motion, penetrationTime, h);
}

// Whether there is no wall in the strip; it is made shorter if that helps.
bool FreeSpace::fits(const std::vector<std::unique_ptr<Barrier>>& barriers,
                     const VehicleState& state, double reach, double turn, double spacing) {
  const Eigen::Vector2d along(forwardX_, forwardY_);
  const Eigen::Vector2d across = turnedLeft(along);
  // What the outline over the band takes in the horizontal plane.
  double front = 0.0;
  double rear = 0.0;
  double side = 0.0;
  for (const double x : {outline_.front, -outline_.rear}) {
    for (const double y : {outline_.halfWidth, -outline_.halfWidth}) {
      for (const double z : {low_, high_}) {
        const Eigen::Vector2d corner = (state.axes * Eigen::Vector3d(x, y, z)).head<2>();
        front = std::max(front, along.dot(corner));
        rear = std::max(rear, -along.dot(corner));
        side = std::max(side, std::abs(across.dot(corner)));
      }
    }
  }
  // The left axis turns by no more than both others together.
  const double turned = turn * std::max(outline_.front, outline_.rear) +
                        (turn + upTurn) * outline_.halfWidth +
                        upTurn * std::max(std::abs(low_), std::abs(high_));
  const double slack = reach + turned;
  const double start = -(rear + slack + strip_.behind);
  const double beyond = front + slack;
  const double radius = std::hypot(side + slack + strip_.aside, 0.5 * spacing);

  double end = beyond + strip_.ahead;
  const Eigen::Vector2d centre = state.massCentre.head<2>();
  for (const std::unique_ptr<Barrier>& barrier : barriers) {
    if (barrier == nullptr) continue;
    const auto clearanceAt = [&](double x) {
      const Eigen::Vector2d place = centre + x * along;
      return barrier->clearanceAtLeast({place.x(), place.y(), state.massCentre.z()}, heightChange);
    };
    const double middle = 0.5 * (start + end);
    if (clearanceAt(middle) >= std::hypot(end - middle, radius)) continue;
    // Discs in a row.
    const int discs = static_cast<int>(std::ceil((end - start) / spacing));
    for (int k = 0; k < discs; ++k) {
      if (clearanceAt(start + (k + 0.5) * spacing) >= radius) continue;
      end = start + k * spacing;
      break;
    }
    if (end < beyond) return false;
  }
  strip_.ahead = end - beyond;
  return true;
}

bool FreeSpace::find(const std::vector<std::unique_ptr<Barrier>>& barriers,
                     const VehicleState& state, double gravity, double penetrationTime, double h) {
  step_ = 0.0;
  if (--stepsUntilLook_ > 0) return false;
  // It stays upright while its up axis turns no further than it may.
  if (state.up().z() - upTurn < minUprightness_) return false;
  const Eigen::Vector2d velocity = state.velocity.head<2>();
  const double speed = velocity.norm();
  // Along the way it goes; the heading of one at rest.
  const Eigen::Vector2d way =
      speed > slow ? velocity : Eigen::Vector2d(state.axes.col(0).head<2>());
  forwardX_ = way.x() / way.norm();
  forwardY_ = way.y() / way.norm();
  forward_ = state.axes.col(0);
  up_ = state.up();
  allowMotion(state);
  const double ahead = std::clamp(timeAhead * speed, leastAhead, mostAhead);
  strip_ = {.ahead = ahead, .behind = leastBehind, .aside = widths.front().aside};
  const double reach = reachOfAllowed(state, gravity, penetrationTime, h);
  double around = std::numeric_limits<double>::infinity();
  for (const std::unique_ptr<Barrier>& barrier : barriers) {
    if (barrier == nullptr) continue;
    around = std::min(around, barrier->clearanceAtLeast(state.massCentre, heightChange));
  }
  for (const Width& width : widths) {
    if (around < outline_.halfWidth + reach + width.aside) continue;
    strip_ = {.ahead = ahead, .behind = leastBehind, .aside = width.aside};
    if (!fits(barriers, state, reach, width.turn, width.spacing)) continue;
    if (strip_.ahead < std::min(fewestSteps * h * speed, 0.5 * ahead)) continue;
    strip_.middle = 0.5 * (strip_.ahead - strip_.behind);
    strip_.half = 0.5 * (strip_.ahead + strip_.behind);
    leastForward_ = cosineOf(width.turn);
    step_ = h;
    stepsLeft_ = stepsBetweenLooks;
    for (Body& body : bodies_) {
      body.x = body.position[0];
      body.y = body.position[1];
      body.z = body.position[2];
    }
    return true;
  }
  stepsUntilLook_ = stepsAfterFailure;
  return false;
}

}  // namespace bumper
