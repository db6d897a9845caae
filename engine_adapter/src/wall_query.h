#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "barrier.h"
#include "bumper/response/contact_point.h"
#include "bumper/response/impact.h"
#include "vehicle_bodies.h"
#include "wall_face.h"

namespace bumper {

/// A wall is near if the outline may come to it within a step of `h` seconds: by twice the speed
/// that it has, or by that which a blow of others may give it, m/s. A vehicle that joints act on
/// has guard contacts with what is near.
inline double nearDistance(double speed, double h) {
  constexpr double afterBlow = 50.0;
  return h * std::max(2.0 * speed, afterBlow);
}

/// The part of a face within [low, high] of a vehicle's z axis, laid into its yaw plane; nothing if
/// the face lies outside. Of one that leans the line is the foremost, as seen from the mass centre.
std::optional<WallSegment> cutFace(const WallFace& face, const VehicleState& state, double low,
                                   double high);

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

  /// How far a box around the outline, over the band, goes beyond it on its sides, m.
  struct Margins {
    double front = 0.0;
    double rear = 0.0;
    double side = 0.0;
    double height = 0.0;
  };

  /// The numbers of those of the mesh's walls that ODE's collider finds in that box, in order;
  /// valid until the next call.
  const std::vector<int>& list(const BarrierMesh& mesh, const VehicleState& state,
                               const Margins& margins);

  /// The part of a face in the band, laid into the yaw plane; nothing if there is none. The segment
  /// is without id, group, settings and `solid`.
  [[nodiscard]] std::optional<WallSegment> cut(const WallFace& face,
                                               const VehicleState& state) const {
    return cutFace(face, state, low_, high_);
  }
  /// The same of a plane or post, long enough for `reach` beyond the outline, m; nothing if it is
  /// further away than that.
  [[nodiscard]] std::optional<WallSegment> cut(const PrimitiveWall& wall, const VehicleState& state,
                                               double reach) const {
    return wall.cut(state, low_, high_, radius_ + reach);
  }

  [[nodiscard]] const Outline& outline() const { return outline_; }
  /// What the outline passes over in a step of `h` seconds if nothing stops it. `motion` is in the
  /// vehicle's axes at the step's start.
  [[nodiscard]] PlanRectangle swept(const PlanarMotion& motion, double h) const;
  /// Of a sphere around the mass centre that holds the outline over the band, m.
  [[nodiscard]] double radius() const { return radius_; }

  /// The middle of the band, m above the mass centre.
  [[nodiscard]] double middleHeight() const { return 0.5 * (low_ + high_); }
  /// How far a wall that is no flatter than 45° goes beyond its line within the band, m.
  [[nodiscard]] double lean() const { return high_ - low_; }

  /// The impact that ODE's own contacts make of the situation: their depth-weighted mean.
  std::optional<Impact> meanOfContacts(const BarrierMesh& mesh, const VehicleState& state);

  /// Whether a wall that stands between the heights foot and top at a place of the world reaches
  /// into the band.
  [[nodiscard]] bool inBand(const VehiclePose& state, const Eigen::Vector3d& place, double foot,
                            double top) const;
  /// Whether a place of the world lies above the band's lower limit.
  [[nodiscard]] bool isAboveBottom(const VehiclePose& state, const Eigen::Vector3d& place) const;
  /// Whether it lies below the band's upper limit.
  [[nodiscard]] bool isBelowTop(const VehiclePose& state, const Eigen::Vector3d& place) const;
  /// The same as inBand() for every wall within the outline's reach that has its foot no higher and
  /// its top no lower than these; false if in doubt.
  [[nodiscard]] bool allInBand(const VehiclePose& state, double highestFoot,
                               double lowestTop) const;

 private:
  void placeBox(const VehicleState& state, const Margins& margins);

  Outline outline_;
  double low_;  // the band in the vehicle's frame
  double high_;
  double radius_;
  dGeomID box_;
  std::vector<int> near_;
};

}  // namespace bumper
