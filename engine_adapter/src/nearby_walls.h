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
  NearbyWalls() { walls_.reserve(32); }

  /// All pieces of walls that a vehicle in that state may come at within its reach, m, in the order
  /// of barriers and walls. A piece's id is its wall's number here.
  void collect(WallQuery& query, const std::vector<std::unique_ptr<Barrier>>& barriers,
               const VehicleState& state, double reach, std::vector<WallSegment>& segments);

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
    double offset;  // of its plane along the normal
  };

  [[nodiscard]] bool covers(const WallQuery& query, const VehicleState& state, double reach) const;
  [[nodiscard]] static bool isBeyondPlane(const WallQuery& query, const VehicleState& state,
                                          const Near& near, double reach);
  void list(WallQuery& query, const std::vector<std::unique_ptr<Barrier>>& barriers,
            const VehicleState& state, double reach);

  bool isKnown_ = false;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();    // the region: the vehicle's place,
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // its axes,
  WallQuery::Margins margins_;                          // and how far it reaches beyond the outline
  std::vector<Near> walls_;
};

}  // namespace bumper
