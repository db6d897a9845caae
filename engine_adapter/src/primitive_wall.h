#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <optional>

#include "bumper/response/segment.h"
#include "bumper/scenes/wall_plan.h"
#include "envelope.h"
#include "vehicle_bodies.h"
#include "world_frame.h"

namespace bumper {

/// An ODE plane, which is half of the world, or a post: an upright ODE cylinder or capsule, or a
/// sphere. Of round ends what is steeper than 45° is the wall, what is flatter its top.
class PrimitiveWall {
 public:
  /// Throws Error if the geom's class is another or it leans too far to be a wall:
  /// `maxNormalUp` as in WallSelection.
  PrimitiveWall(dGeomID geom, const WorldFrame& frame, double maxNormalUp);

  /// Its section with a vehicle's yaw plane over the band, extended to `beyond` the envelope, m;
  /// nothing if it is further away than that.
  [[nodiscard]] std::optional<Segment> cut(const VehicleState& state, const Envelope& vehicle,
                                           double beyond) const;

  /// Distance to the plane, or to the post as if it had no ends, from the nearest of the places
  /// up to `height` above or below one, m.
  [[nodiscard]] double clearanceAtLeast(const Eigen::Vector3d& place, double height) const;

  /// How far along its middle line a strip is free, m, as in WallPlan::freeUntil(): within `height`
  /// above and below `z`.
  [[nodiscard]] double freeUntil(const PlanStrip& strip, double z, double height) const;

  /// How far from the vertical it leans: m aside for each m up.
  [[nodiscard]] double lean() const;

  [[nodiscard]] double foot() const { return foot_; }
  [[nodiscard]] double top() const { return top_; }
  [[nodiscard]] bool isPost() const { return radius_ > 0.0; }

 private:
  /// Where a vehicle meets the post: the point of its axis, in the vehicle's axes, and the radius
  /// of the section there, both at the height of the band where that is widest.
  struct Section {
    Vector2 centre;
    double radius;
  };
  [[nodiscard]] std::optional<Section> sectionOf(const Eigen::Vector3d& place,
                                                 const Eigen::Vector3d& direction, double low,
                                                 double high) const;

  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();      // a point of the plane, or the middle
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();  // the plane's normal, or the post's axis
  double radius_ = 0.0;
  double halfLength_ = 0.0;  // of a post, along its axis, without round ends
  bool isRound_ = false;     // it has round ends
  double foot_ = 0.0;
  double top_ = 0.0;
};

}  // namespace bumper
