#pragma once

#include <ode/ode.h>

#include <vector>

#include "barrier.h"
#include "envelope.h"
#include "ode_handles.h"
#include "vehicle_bodies.h"

namespace bumper {

/// Queries ODE's trimesh collider for the walls near a vehicle's envelope.
class WallQuery {
 public:
  WallQuery();

  /// How far a box around the envelope goes beyond it on its sides, m.
  struct Margins {
    double front = 0.0;
    double rear = 0.0;
    double side = 0.0;
    double height = 0.0;
  };

  /// The numbers of those of the mesh's walls that the collider finds in that box, in order; valid
  /// until the next call.
  const std::vector<int>& list(const BarrierMesh& mesh, const Envelope& vehicle,
                               const VehicleState& state, const Margins& margins);

 private:
  OwnGeom box_;
  std::vector<int> near_;
};

}  // namespace bumper
