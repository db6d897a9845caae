#pragma once

#include <Eigen/Core>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/engine_adapter/barrier.h"
#include "bumper/engine_adapter/vehicle.h"
#include "bumper/response/force_pulse.h"

/// What a responder remembers from step to step, as plain data. Times are Responder::time(), s;
/// world frame unless said otherwise, as zUp() of WorldAxes has it: in metres with z up, whatever
/// the world's own axes and unit.
namespace BUMPER_API bumper {

/// A wall that a vehicle passes through: it broke and the outline has not left it yet, or its long
/// force pulse still runs: those that isOneWall() says, of all barriers while a pulse runs, of one
/// that broke those of its barrier with its settings.
struct PassableWall {
  BarrierId barrier;
  int settings = 0;  ///< number of the settings in the barrier
  /// Where it was hit, m; of a barrier that moves as that stood when its walls were read.
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, into the vehicle
  double until = 0.0;                                ///< end of the pulse; 0 if it broke
  double depth = 0.0;                                ///< penetration that the pulse allows, m
};

/// What a vehicle is in contact with: a barrier, or another vehicle, registered later.
struct ContactPartner {
  BarrierId barrier{};
  VehicleId vehicle{};
  bool operator==(const ContactPartner&) const = default;
};

/// A contact that has begun and not ended.
struct SustainedContact {
  ContactPartner with{};
  int wall = 0;  ///< number of the wall in the barrier that was touched last
  double begun = 0.0;
  double last = 0.0;
  double impulseNormal = 0.0;   ///< N s, the sum
  double impulseTangent = 0.0;  ///< N s, the sum
  double energyLost = 0.0;      ///< J, the sum
  double load = 0.0;            ///< N, along the normal: the recent maximum, decaying
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// Another vehicle, registered later, that was hit of late.
struct VehicleHit {
  VehicleId vehicle;
  double last = 0.0;  ///< when, at a speed above the settings' rest speed
  double passableUntil =
      0.0;  ///< the end of a long force pulse, until which no other impact occurs
};

/// What the last step() added to a vehicle's bodies, and the chassis' state then.
struct LastDelivery {
  bool any = false;
  double step = 0.0;      ///< s
  PlanarImpulse impulse;  ///< in the vehicle's axes then
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// The motion predicted from the last step's known forces, where joints act too and a pulse
/// continues.
struct Expectation {
  double step = 0.0;                                   ///< s; 0: nothing is expected
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the mass centre, m/s
  double yawRate = 0.0;
};

/// A guard contact of the last step, and its force.
struct GuardLoad {
  ContactPartner with{};
  int wall = 0;  ///< number in the barrier
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, into the vehicle
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();       ///< from the mass centre, m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the point, before, m/s
  Eigen::Vector3d force = Eigen::Vector3d::Zero();     ///< on the vehicle, N
};

/// All that is remembered of a vehicle.
struct VehicleMemory {
  VehicleId vehicle;
  ForcePulse pulse;  ///< not yet delivered, in the vehicle's axes at the last step
  LastDelivery delivery;
  Expectation expectation;
  std::vector<PassableWall> passable;
  std::vector<VehicleHit> hits;
  std::vector<SustainedContact> contacts;
  std::vector<GuardLoad> guards;  ///< in a saved state only
};

/// How a barrier that moves stood before the last step, and moved.
struct BarrierMotion {
  BarrierId barrier{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of its body or else its geom, m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of that place, m/s
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();   ///< rad/s
  // Of one that updateBarrier() has moved: when last, in how many successive steps, and where it
  // was before that.
  double moved = -1.0;
  int moves = 0;
  Eigen::Vector3d lastPosition = Eigen::Vector3d::Zero();
  Eigen::Matrix3d lastAxes = Eigen::Matrix3d::Identity();
};

/// All that a responder remembers: Responder::save() and restore().
struct SavedState {
  double time = 0.0;
  std::vector<VehicleMemory> vehicles;
  std::vector<BarrierMotion> barriers;  ///< those that move
};

}  // namespace bumper
