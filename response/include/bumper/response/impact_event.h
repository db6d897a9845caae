#pragma once

#include <Eigen/Core>
#include <string_view>

#include "bumper/base/api.h"
#include "bumper/response/impact.h"

namespace BUMPER_API bumper {

enum class EventPhase {
  impact,  ///< one impulse with an approach speed above the settings' rest speed, or above
           ///< five times that while a contact lasts; or an external load on the vehicle against
           ///< the barrier that rises to twice its recent maximum: its approach speed is that
           ///< before the step, and no law was evaluated
  contact_begin,  ///< slower impacts in successive steps begin: the vehicle rests against the
                  ///< barrier or scrapes along it
  contact_end     ///< they have ended; impulses, energyLost and duration are those of the whole
                  ///< contact
};

/// One impact of a vehicle on a barrier, or of two vehicles, for applications; the latter is told
/// once, by the one that was registered first. SI units; vectors in the world frame (right-handed,
/// z up) unless they say otherwise; yaw rates about the vehicle's own z axis, positive turning
/// left. The names stay valid as long as the vehicle and the barrier are registered.
struct ImpactEvent {
  double time = 0.0;  ///< of the impact within its step, counted by the steps taken, s
  EventPhase phase = EventPhase::impact;
  std::string_view vehicle;
  std::string_view barrier;       ///< what it hit; empty if that is …
  std::string_view otherVehicle;  ///< … another vehicle; empty for a barrier
  int triangle = -1;              ///< in the barrier's own mesh
  std::string_view material;

  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< at mass-centre height
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< unit, into the vehicle
  Vector2 arm = Vector2::Zero();  ///< mass centre to contact point in the vehicle's frame
  /// Of the other vehicle: the same in its frame, and its motion before and after; else 0.
  Vector2 otherArm = Vector2::Zero();
  Eigen::Vector3d otherVelocityBefore = Eigen::Vector3d::Zero();
  Eigen::Vector3d otherVelocityAfter = Eigen::Vector3d::Zero();
  double otherYawRateBefore = 0.0;
  double otherYawRateAfter = 0.0;

  Law law = Law::restitution;
  AnglesOfAttack angles;
  double approachSpeed = 0.0;  ///< of the contact point, positive when closing
  double restitution = 0.0;
  double friction = 0.0;
  double impulseNormal = 0.0;   ///< N s along normal
  double impulseTangent = 0.0;  ///< N s along z × normal
  double impulseRatio = 0.0;
  double criticalImpulseRatio = 0.0;
  double deltaV = 0.0;  ///< magnitude of the mass centre's velocity change
  double yawRateBefore = 0.0;
  double yawRateAfter = 0.0;
  double speedBefore = 0.0;  ///< of the mass centre in the yaw plane
  double speedAfter = 0.0;
  Eigen::Vector3d velocityBefore = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocityAfter = Eigen::Vector3d::Zero();
  double energyAsked = 1.0;  ///< P; NaN under the restitution law
  double energyRatio = 1.0;
  double energyLost = 0.0;  ///< yaw-plane energy of all that moves, J
  double duration = 0.0;    ///< of a contact that has ended, s
  EnergyOutcome outcome = EnergyOutcome::not_asked;
  Regime regime = Regime::separating;
};

/// The words that files and logs use.
std::string_view toString(EventPhase phase);
std::string_view toString(Law law);
std::string_view toString(Regime regime);
std::string_view toString(EnergyOutcome outcome);

}  // namespace bumper
