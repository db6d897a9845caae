#pragma once

#include <ode/ode.h>

#include <optional>
#include <vector>

#include "barrier.h"
#include "bumper/response/contact_point.h"
#include "bumper/response/impact.h"
#include "vehicle_bodies.h"

namespace bumper {

/// Asks a barrier what is near one vehicle's outline. Works in the vehicle's own frame: axes
/// forward, left, up; origin at the mass centre.
class WallQuery {
 public:
  /// `band` is above the ground, the mass centre at parameters.massCentreHeight.
  WallQuery(const VehicleParameters& parameters, const Band& band);
  ~WallQuery();
  WallQuery(const WallQuery&) = delete;
  WallQuery& operator=(const WallQuery&) = delete;
  WallQuery(WallQuery&&) = delete;
  WallQuery& operator=(WallQuery&&) = delete;

  /// Appends the pieces of the barrier's walls at the outline enlarged by `reach` on every side, m,
  /// cut to the band and laid into the yaw plane. A segment's id is `firstId` plus the wall's
  /// number in the barrier, its group the barrier's id.
  void append(const Barrier& barrier, const VehicleState& state, double reach, int firstId,
              std::vector<WallSegment>& segments);

  /// Whether no triangle of the barrier comes near the outline, over the band, enlarged by
  /// `distance` in all directions, m. False if in doubt.
  bool isClear(const Barrier& barrier, const VehicleState& state, double distance);

  [[nodiscard]] const Outline& outline() const { return outline_; }
  /// Of a sphere around the mass centre that holds the outline over the band, m.
  [[nodiscard]] double radius() const { return radius_; }

  /// The impact that ODE's own contacts make of the situation: their depth-weighted mean.
  std::optional<Impact> meanOfContacts(const BarrierMesh& mesh, const VehicleState& state);

  /// Whether a wall that stands between the heights foot and top at a place of the world reaches
  /// into the band.
  [[nodiscard]] bool inBand(const VehicleState& state, const Eigen::Vector3d& place, double foot,
                            double top) const;
  /// Whether a place of the world lies above the band's lower limit.
  [[nodiscard]] bool isAboveBottom(const VehicleState& state, const Eigen::Vector3d& place) const;
  /// The same as inBand() for every wall within the outline's reach that has its foot no higher and
  /// its top no lower than these; false if in doubt.
  [[nodiscard]] bool allInBand(const VehicleState& state, double highestFoot,
                               double lowestTop) const;

 private:
  void placeBox(const VehicleState& state, double aside, double upAndDown);

  Outline outline_;
  double low_;  // the band in the vehicle's frame
  double high_;
  double radius_;
  dGeomID box_;
  std::vector<int> near_;
};

/// The part of a wall within [low, high] of a vehicle's z axis, laid into its yaw plane; nothing if
/// the wall lies outside. Of a wall that leans the line is the foremost, as seen from the mass
/// centre.
std::optional<WallSegment> cutWall(const Wall& wall, const VehicleState& state, double low,
                                   double high);

}  // namespace bumper
