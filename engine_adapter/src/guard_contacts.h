#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "bumper/engine_adapter/saved_state.h"
#include "bumper/response/speculative_contact.h"
#include "vehicle_bodies.h"

namespace bumper {

/// Whether a joint connects one of the bodies with something else: the world, or a body that is not
/// among them. A contact that the application made for the coming step is such a joint.
bool hasOuterJoint(const VehicleBodies& bodies);

/// Whether such a joint leads to another body: it may wake them in the coming step, as may other
/// bodies of its island.
bool hasJointWithBody(const VehicleBodies& bodies);

/// The distance, m, within which a wall gets guard contacts: what the outline may cover in a step
/// of `h` seconds at twice its speed, m/s, or at that after a blow.
inline double guardDistance(double speed, double h) {
  constexpr double afterBlow = 50.0;
  return h * std::max(2.0 * speed, afterBlow);
}

/// A point that is no further from what it may meet than this, m, slides along it in the step.
inline constexpr double slidingGap = 1e-3;

/// One vehicle's guard contacts. A force pulse is computed for a vehicle without other contacts.
/// Where joints act on it too, its guard contacts make the walls a part of the world's own solve:
/// contact joints for one step, with the wall's own normal, that only keep a point of the outline
/// from passing its wall within the step, under any load. Without load they have no effect.
class GuardContacts {
 public:
  /// The frame must live as long.
  explicit GuardContacts(const WorldFrame& frame) : frame_(frame) {}

  struct Guard {
    SpeculativeContact contact;  ///< in the vehicle's axes
    BarrierId barrier;
    int wall = 0;           ///< number in the barrier
    double friction = 0.0;  ///< Coulomb's coefficient
  };

  /// A guard contact with another vehicle, in the world.
  struct PairGuard {
    VehicleId other;
    dBodyID chassis = nullptr;                           ///< the other one's
    Eigen::Vector3d place = Eigen::Vector3d::Zero();     ///< m
    Eigen::Vector3d arm = Eigen::Vector3d::Zero();       ///< from the own mass centre, m
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, into the own vehicle
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< relative, without other loads, m/s
    double room = 0.0;                                   ///< m
    double friction = 0.0;
  };

  struct Step {
    double time = 0.0;  ///< when it begins, s
    double size = 0.0;  ///< s
  };

  /// Adds one to `group` for a step, at the height of the mass centre; no more than
  /// SpeculativeContacts::most. Its normal is level, whatever the vehicle's lean.
  void add(const Guard& guard, dJointGroupID group, dBodyID chassis, const VehicleState& state,
           const Step& step);
  void add(const PairGuard& guard, dJointGroupID group, dBodyID chassis, const Step& step);
  [[nodiscard]] bool isEmpty() const { return count_ == 0; }

  /// Their loads in the world's last step.
  [[nodiscard]] std::span<GuardLoad> loads();
  /// Replaces their loads.
  void setLoads(std::span<const GuardLoad> loads);

  /// The joints are gone, or their loads are no longer read.
  void forget() { count_ = 0; }
  void release();

 private:
  struct Constraint {
    dBodyID other = nullptr;  // null: the world
    double leastSpeed = 0.0;  // along the load's normal, m/s
    double friction = 0.0;
  };
  void attach(const Constraint& constraint, dJointGroupID group, dBodyID chassis, const Step& step);

  const WorldFrame& frame_;
  std::array<GuardLoad, SpeculativeContacts::most> loads_{};
  std::array<dJointFeedback, SpeculativeContacts::most> feedback_{};
  std::array<dJointID, SpeculativeContacts::most> joints_{};
  std::size_t count_ = 0;
};

}  // namespace bumper
