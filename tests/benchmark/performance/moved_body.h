#pragma once

#include <ode/ode.h>

#include <array>
#include <cstring>

#include "drive.h"
#include "scenes.h"

namespace bumper::benchmark {

/// Writes a pose into a body as a world step leaves it: no force, and nothing told. The functions
/// that ODE has for it also normalise the rotation, which would take longer than what is measured.
inline void writePose(dBodyID body, const Pose& pose, double height) {
  const auto write = [](const dReal* place, const std::array<dReal, 4>& values) {
    // ODE hands out its own memory, which is not const.
    std::memcpy(const_cast<dReal*>(place), values.data(), sizeof values);  // NOLINT
  };
  const PlanPlace& place = pose.place;
  write(dBodyGetPosition(body), {place.position.x(), place.position.y(), height, 0.0});
  const dReal* rotation = dBodyGetRotation(body);
  write(rotation, {place.cosine, -place.sine, 0.0, 0.0});
  write(rotation + 4, {place.sine, place.cosine, 0.0, 0.0});
  write(rotation + 8, {0.0, 0.0, 1.0, 0.0});
  write(dBodyGetQuaternion(body), {pose.halfCosine, 0.0, 0.0, pose.halfSine});
  write(dBodyGetLinearVel(body), {pose.velocity.x(), pose.velocity.y(), 0.0, 0.0});
  write(dBodyGetAngularVel(body), {0.0, 0.0, pose.yawRate, 0.0});
  write(dBodyGetForce(body), {});
  write(dBodyGetTorque(body), {});
}

/// The car of all queries, a free body without a geom in a world of its own, without gravity.
class QueryBody {
 public:
  QueryBody() : world_(dWorldCreate()), body_(dBodyCreate(world_)) {
    const VehicleParameters car = queryCar();
    dMass mass;
    dMassSetParameters(&mass, car.mass, 0.0, 0.0, 0.0, 0.25 * car.yawInertia, 0.95 * car.yawInertia,
                       car.yawInertia, 0.0, 0.0, 0.0);
    dBodySetMass(body_, &mass);
    dBodySetPosition(body_, 0.0, 0.0, car.massCentreHeight);
  }
  ~QueryBody() { dWorldDestroy(world_); }
  QueryBody(const QueryBody&) = delete;
  QueryBody& operator=(const QueryBody&) = delete;
  QueryBody(QueryBody&&) = delete;
  QueryBody& operator=(QueryBody&&) = delete;

  void moveTo(const Pose& pose) { writePose(body_, pose, height_); }

  [[nodiscard]] dWorldID world() const { return world_; }
  [[nodiscard]] dBodyID id() const { return body_; }

 private:
  double height_ = queryCar().massCentreHeight;
  dWorldID world_;
  dBodyID body_;
};

}  // namespace bumper::benchmark
