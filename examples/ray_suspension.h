#pragma once

#include <ode/ode.h>

#include <array>

#include "yaw_plane_car.h"

namespace bumper::examples {

/// Four springs that carry a yaw-plane car over uneven ground, each standing on what a ray from the
/// wheel downwards hits first.
class RaySuspension {
 public:
  /// `ground` is a static trimesh. Needs a world with gravity; at rest on level ground the mass
  /// centre is at the design's height.
  RaySuspension(YawPlaneCar& car, dGeomID ground, double gravity);
  ~RaySuspension();
  RaySuspension(const RaySuspension&) = delete;
  RaySuspension& operator=(const RaySuspension&) = delete;
  RaySuspension(RaySuspension&&) = delete;
  RaySuspension& operator=(RaySuspension&&) = delete;

  /// Adds this step's spring forces to the body and tells the car what its tyres carry.
  void addForces();

 private:
  YawPlaneCar& car_;
  dGeomID ground_;
  dGeomID ray_;
  std::array<double, 4> staticLoads_{};
};

}  // namespace bumper::examples
