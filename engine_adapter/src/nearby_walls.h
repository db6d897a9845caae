#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "barrier.h"
#include "vehicle_bodies.h"
#include "wall_query.h"

namespace bumper {

/// A wall of one of a responder's barriers.
struct BarrierWall {
  const Barrier* barrier = nullptr;
  int wall = 0;
};

/// The walls around one vehicle: ODE's collider lists them for a region, and the list serves until
/// the vehicle may reach out of it.
class NearbyWalls {
 public:
  NearbyWalls() {
    walls_.reserve(32);
    sheets_.reserve(32);
  }

  /// What is asked of the walls around a vehicle.
  struct Question {
    double reach = 0.0;   ///< how far the outline may come in the step, whatever it hits, m
    PlanRectangle swept;  ///< what it passes over if it hits nothing
    bool evenIfNoneIsTouched = false;
  };

  /// All pieces of walls within the reach of a vehicle in that state, in the order of barriers and
  /// walls; none if no wall can be touched in the step, unless they are wanted even then. A piece's
  /// id is its wall's number here. Returns whether there is any piece within the reach.
  bool collect(WallQuery& query, const std::vector<std::unique_ptr<Barrier>>& barriers,
               const VehicleState& state, const Question& question,
               std::vector<WallSegment>& segments);

  /// The wall with that number, until the next collect().
  [[nodiscard]] BarrierWall at(int number) const {
    return walls_[static_cast<std::size_t>(number)].of;
  }

  /// Barriers have changed.
  void forget() { isKnown_ = false; }

 private:
  struct Near {
    BarrierWall of;
    Wall wall;               // with a normal of zero for what is no triangle
    Eigen::Vector3d centre;  // of a ball around the wall
    double radius;
    std::size_t sheet;
  };

  // A plane in which walls lie.
  struct Sheet {
    Eigen::Vector3d normal;
    double offset;  // along the normal, from the region's centre
    bool isBeyond;  // no wall in it meets the rectangle that was asked for last
  };

  [[nodiscard]] bool covers(const WallQuery& query, const VehicleState& state, double reach) const;
  void lookAtSheets(const WallQuery& query, const VehicleState& state, const PlanRectangle& around);
  [[nodiscard]] bool mayMeet(const Near& near, const VehicleState& state,
                             const PlanRectangle& around) const;
  [[nodiscard]] bool anyMayMeet(const WallQuery& query, const VehicleState& state,
                                const PlanRectangle& around);
  [[nodiscard]] bool anyWithin(const WallQuery& query, const VehicleState& state, double reach);
  [[nodiscard]] std::size_t sheetOf(const Wall& wall);
  void list(WallQuery& query, const std::vector<std::unique_ptr<Barrier>>& barriers,
            const VehicleState& state, double reach);

  bool isKnown_ = false;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();    // the region: the vehicle's place,
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // its axes,
  WallQuery::Margins margins_;                          // and how far it reaches beyond the outline
  std::vector<Near> walls_;
  std::vector<Sheet> sheets_;
  std::size_t lastWithin_ = 0;  // a wall that was within reach, to be asked first
};

}  // namespace bumper
