#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/planar_motion.h"
#include "driving_plane.h"
#include "ode_mesh.h"
#include "subject.h"

namespace bumper::doctor {

/// A test drive: a start and what acts on the vehicle then.
struct TestDrive {
  DrivingPlane plane{};
  PlanarMotion start{};    ///< in the plane
  double sideForce = 0.0;  ///< N, at right angles to the velocity, positive to its left
  double attack = 0.0;     ///< rad, against the wall: contact joints get e and μ at this angle
  std::size_t steps = 0;
};

struct DriveContact {
  std::size_t step = 0;  ///< the one in which it acted
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, into the vehicle
  int wall = -1;                                     ///< index; -1: not known
};

struct DriveState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double yawRate = 0.0;
  double energy = 0.0;  ///< kinetic, J
};

/// What a test drive led to: the state at its start and after each step.
struct DriveTrace {
  std::vector<DriveState> states;
  std::vector<DriveContact> contacts;
};

/// A world without gravity with a scene's walls and a box as a vehicle, driven by one method.
class Rig {
 public:
  Rig();
  virtual ~Rig();
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;
  Rig(Rig&&) = delete;
  Rig& operator=(Rig&&) = delete;

  virtual DriveTrace run(const TestDrive& drive) = 0;

 protected:
  void place(const TestDrive& drive) const;
  void push(const TestDrive& drive) const;
  void makeVehicle(const VehicleParameters& vehicle);

  dWorldID world_;
  dJointGroupID joints_;
  dBodyID body_ = nullptr;
  dGeomID box_ = nullptr;
};

/// What a plain application does: a contact joint for each contact that dCollide gives, QuickStep.
class JointRig : public Rig {
 public:
  JointRig(const Subject& subject, const std::vector<Wall>& walls);

  DriveTrace run(const TestDrive& drive) override;

  /// dCollide's contacts of the vehicle where a drive starts.
  std::vector<DriveContact> contactsAt(const TestDrive& drive);

 private:
  int collide(std::vector<dContact>& contacts) const;
  [[nodiscard]] DriveState state() const;

  const Subject& subject_;
  OdeMesh mesh_;
};

/// The same with Bumper.
class BumperRig : public Rig {
 public:
  explicit BumperRig(const Subject& subject);

  DriveTrace run(const TestDrive& drive) override;

  [[nodiscard]] const WallReport& report() const { return responder_.report(barrier_); }
  /// What Responder::warnings() said of the scene.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void attachUnclaimed();
  [[nodiscard]] DriveState state(VehicleId vehicle) const;

  const Subject& subject_;
  Responder responder_;
  BarrierId barrier_;
  std::vector<std::string> warnings_;
};

}  // namespace bumper::doctor
