#include "wall_query.h"

#include <algorithm>

namespace bumper {

namespace {

// Margins grow by `more` for the collider's single precision.
void placeBox(dGeomID box, const Envelope& vehicle, const VehicleState& state,
              const WallQuery::Margins& margins, double more) {
  const Outline& outline = vehicle.outline();
  const double front = outline.front + margins.front + more;
  const double rear = outline.rear + margins.rear + more;
  const Eigen::Vector3d middle(0.5 * (front - rear), 0.0, vehicle.middleHeight());
  const Eigen::Vector3d place = state.massCentre + state.axes * middle;
  dMatrix3 rotation = {state.axes(0, 0), state.axes(0, 1), state.axes(0, 2), 0.0,
                       state.axes(1, 0), state.axes(1, 1), state.axes(1, 2), 0.0,
                       state.axes(2, 0), state.axes(2, 1), state.axes(2, 2), 0.0};
  dGeomBoxSetLengths(box, front + rear, 2.0 * (outline.halfWidth + margins.side + more),
                     vehicle.bandHeight() + 2.0 * (margins.height + more));
  dGeomSetPosition(box, place.x(), place.y(), place.z());
  dGeomSetRotation(box, rotation);
}

}  // namespace

WallQuery::WallQuery() : box_(dCreateBox(nullptr, 1.0, 1.0, 1.0)) { near_.reserve(256); }

const std::vector<int>& WallQuery::list(const BarrierMesh& mesh, const Envelope& vehicle,
                                        const VehicleState& state, const Margins& margins) {
  placeBox(box_.get(), vehicle, state, margins, mesh.margin());
  mesh.list(box_.get(), near_);
  std::sort(near_.begin(), near_.end());
  return near_;
}

}  // namespace bumper
