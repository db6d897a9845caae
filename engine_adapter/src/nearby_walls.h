#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "barrier.h"
#include "vehicle_bodies.h"
#include "wall_face.h"
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
  NearbyWalls() { faces_.reserve(32); }

  /// What is asked of the walls around a vehicle.
  struct Question {
    PlanRectangle around;  ///< what the outline passes over in the step if it hits nothing, or more
    double reach = 0.0;    ///< how far it may come, whatever it hits, m
    bool evenIfNoneIsThere = false;
  };

  /// `segments` gets all pieces of walls within the reach of the vehicle in that state, in the
  /// order of barriers and walls; none if no wall is in the rectangle, unless they are wanted even
  /// then. A piece's id is its face's number here.
  void collect(WallQuery& query, const std::vector<std::unique_ptr<Barrier>>& barriers,
               const VehicleState& state, const Question& question,
               std::vector<WallSegment>& segments);

  /// A wall of the face with that number, until the next collect().
  [[nodiscard]] BarrierWall at(int number) const {
    const Near& near = faces_[static_cast<std::size_t>(number)];
    return {near.barrier, static_cast<int>(near.walls.first)};
  }

  /// Barriers have changed.
  void forget() { isKnown_ = false; }

 private:
  struct Near {
    const Barrier* barrier = nullptr;
    WallTable::Stretch walls{};                        // of the face
    WallFace face{};                                   // none for what is no triangle
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // of a ball around the face
    double radius = 0.0;
    const ResponseSettings* settings = nullptr;
  };

  [[nodiscard]] bool covers(const WallQuery& query, const VehicleState& state, double reach) const;
  [[nodiscard]] static bool mayMeet(const Near& near, const WallQuery& query,
                                    const VehicleState& state, const PlanRectangle& around);
  static std::optional<WallSegment> pieceOf(const Near& near, const WallQuery& query,
                                            const VehicleState& state, double reach);
  void list(WallQuery& query, const std::vector<std::unique_ptr<Barrier>>& barriers,
            const VehicleState& state, double reach);
  void listFaces(const Barrier& barrier, std::span<const int> walls);

  bool isKnown_ = false;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();    // the region: the vehicle's place,
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // its axes,
  WallQuery::Margins margins_;                          // and how far it reaches beyond the outline
  std::vector<Near> faces_;
  // Something was there in the last step: looking at all at once is then the shortest way.
  bool wasThere_ = false;
};

}  // namespace bumper
