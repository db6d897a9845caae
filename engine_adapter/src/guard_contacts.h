#pragma once

#include <ode/ode.h>

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

/// Whether such a joint leads to a body that is awake.
bool isHeldByAwakeBody(const VehicleBodies& bodies);

/// One vehicle's guard contacts. A force pulse is worked out for a vehicle that nothing else
/// touches. Where joints act on it too, its guard contacts make the walls a part of the world's own
/// solve: contact joints for one step, with the wall's own normal, that demand no more than that a
/// point of the outline does not pass its wall within the step, whatever pushes. Where nothing does
/// they have no effect.
class GuardContacts {
 public:
  struct Guard {
    SpeculativeContact contact;  ///< in the vehicle's axes
    BarrierId barrier;
    int wall = 0;           ///< number in the barrier
    double friction = 0.0;  ///< Coulomb's coefficient
  };

  /// Adds one to `group`, at the height of the mass centre, until it is emptied; no more than
  /// SpeculativeContacts::most. `time` is that of the step, s.
  void add(const Guard& guard, dJointGroupID group, dBodyID chassis, const VehicleState& state,
           double time);

  /// What they did in the world's last step.
  [[nodiscard]] std::span<GuardLoad> loads();
  /// As if these were what they did.
  void setLoads(std::span<const GuardLoad> loads);

  /// The joints are gone, or go on without telling what they do.
  void forget() { count_ = 0; }
  void release();

 private:
  std::array<GuardLoad, SpeculativeContacts::most> loads_{};
  std::array<dJointFeedback, SpeculativeContacts::most> feedback_{};
  std::array<dJointID, SpeculativeContacts::most> joints_{};
  std::size_t count_ = 0;
};

}  // namespace bumper
