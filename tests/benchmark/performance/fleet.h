#pragma once

#include <ode/ode.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "bumper/engine_adapter/responder.h"
#include "drive.h"
#include "hinge2_car.h"
#include "ode_world.h"
#include "yaw_plane_car.h"

namespace bumper::benchmark {

/// Who answers contacts with walls.
enum class Answer {
  nobody,  ///< the world steps, nothing is collided
  bumper,
  joints  ///< ODE's contact joints, 8 contacts a pair
};

struct FleetOptions {
  std::size_t vehicles = 1;
  bool fiveBodies = false;  ///< a chassis with four wheels on hinge2 joints; otherwise one body
  bool inContact = false;   ///< each leans on the wall at its right with 3 kN and slides along it
  Answer answer = Answer::bumper;
};

/// Vehicles on the course at 20 m/s, at equal distances, in a world without gravity.
class Fleet {
 public:
  Fleet(const Scene& scene, const FleetOptions& options);
  ~Fleet();
  Fleet(const Fleet&) = delete;
  Fleet& operator=(const Fleet&) = delete;
  Fleet(Fleet&&) = delete;
  Fleet& operator=(Fleet&&) = delete;

  /// Back to the start.
  void reset();
  /// What an application does in one step, apart.
  void push();     ///< the forces that press on the wall
  void collide();  ///< collides the one vehicle with the walls; of several: nothing
  void respond() {
    if (responder_) responder_->step(stepSize_);
  }
  void stepWorld();
  /// Instead of a world step: each body goes on at its velocity.
  void glide();

 private:
  struct Start {
    dBodyID body;
    std::array<dReal, 3> position;
    std::array<dReal, 4> rotation;
    std::array<dReal, 3> velocity;
    std::array<dReal, 3> turning;
  };

  void addVehicle(const PlanPlace& place);
  static void near(void* fleet, dGeomID a, dGeomID b);

  static constexpr double stepSize_ = 0.005;  // s
  FleetOptions options_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID joints_;
  std::vector<std::unique_ptr<examples::YawPlaneCar>> cars_;
  std::vector<std::unique_ptr<tests::Hinge2Car>> hinge2Cars_;
  std::vector<dBodyID> chassis_;
  std::vector<std::array<double, 2>> pushes_;  // N, on each chassis
  std::vector<Start> starts_;
  std::optional<tests::OdeMesh> mesh_;
  std::optional<Responder> responder_;
  SavedState saved_;
};

}  // namespace bumper::benchmark
