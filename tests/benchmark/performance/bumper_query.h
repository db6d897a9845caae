#pragma once

#include "bumper/engine_adapter/responder.h"
#include "moved_body.h"

namespace bumper::benchmark {

/// Responder::step() itself: reads the body, looks, sweeps, responds, adds the force.
class BumperQuery {
 public:
  explicit BumperQuery(const Scene& scene) : responder_(body_.world()) {
    responder_.addBarrier(scene);
    responder_.addVehicle(body_.id(), queryCar(),
                          {.band = Band{.bottom = bandBottom, .top = bandTop}});
  }

  void moveTo(const Pose& pose) { body_.moveTo(pose); }
  std::size_t query() { return responder_.step(stepSize).size(); }
  [[nodiscard]] bool found() const {
    const dReal* force = dBodyGetForce(body_.id());
    return force[0] != 0.0 || force[1] != 0.0;
  }

 private:
  QueryBody body_;
  Responder responder_;
};

/// ODE's step of the same body.
class WorldStep {
 public:
  explicit WorldStep(const Scene& /*scene*/) {}

  void moveTo(const Pose& pose) { body_.moveTo(pose); }
  std::size_t query() {
    dWorldQuickStep(body_.world(), stepSize);
    return 0;
  }
  [[nodiscard]] static bool found() { return false; }

 private:
  QueryBody body_;
};

}  // namespace bumper::benchmark
