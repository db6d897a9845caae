#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "barrier.h"
#include "bumper/response/collision_step.h"
#include "crowded_walls.h"
#include "envelope.h"
#include "fine_walls.h"
#include "vehicle_bodies.h"
#include "wall_face.h"
#include "wall_query.h"

namespace bumper {

/// A wall of one of a responder's barriers.
struct BarrierWall {
  const Barrier* barrier = nullptr;
  int wall = 0;
};

/// A responder's barriers, and those of them that move.
struct BarrierList {
  const std::vector<std::unique_ptr<Barrier>>& all;
  std::span<Barrier* const> moving;
};

/// The walls around one vehicle: ODE's collider lists them for a region, and the list is valid
/// until the vehicle may reach out of it.
class NearbyWalls {
 public:
  NearbyWalls() {
    faces_.reserve(32);
    surfaces_.reserve(8);
    owners_.reserve(8);
    segments_.reserve(32);
  }

  /// A query for the walls around a vehicle.
  struct Question {
    PlanRectangle around;  ///< at least what the outline sweeps in the step if it hits nothing
    double reach = 0.0;    ///< how far it may move, whatever it hits, m
    bool evenIfNoneIsThere = false;
  };

  /// Finds all pieces of walls within the reach of the vehicle in that state, in the order of
  /// barriers and walls; none if no wall is in the rectangle, unless they are wanted even then. A
  /// segment's id is its face's number here, and its surface one of a barrier's settings.
  void collect(const Envelope& vehicle, const BarrierList& barriers, const VehicleState& state,
               const Question& question);

  /// As if collect() had found nothing.
  void clear() { segments_.clear(); }

  /// What the last collect() found, until the next one.
  [[nodiscard]] CollisionStep::Walls all() const { return {segments_, surfaces_}; }

  /// Which barrier a surface belongs to, and the number of its settings there.
  struct Owner {
    BarrierId barrier;
    int settings = 0;
    bool operator==(const Owner&) const = default;
  };
  [[nodiscard]] const Owner& ownerOf(const Segment& wall) const {
    return owners_[static_cast<std::size_t>(wall.surface)];
  }
  [[nodiscard]] const ResponseSettings& settingsOf(int surface) const {
    return *surfaces_[static_cast<std::size_t>(surface)].settings;
  }
  /// A long force pulse of those segments runs, which allows this penetration, m.
  template <typename IsOfIt>
  void enter(const IsOfIt& isOfIt, double depth);
  template <typename IsOfIt>
  void remove(const IsOfIt& isOfIt) {
    std::erase_if(segments_, isOfIt);
  }

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
    WallFace face{};                                   // empty for planes and posts
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // of a ball around the face
    double radius = 0.0;
    int surface = 0;
  };

  void listMoving(const Envelope& vehicle, std::span<Barrier* const> moving,
                  const VehicleState& state, double reach);
  [[nodiscard]] bool covers(const Envelope& vehicle, const VehicleState& state, double reach) const;
  [[nodiscard]] static bool mayMeet(const Near& near, const Envelope& vehicle,
                                    const VehicleState& state, const PlanRectangle& around);
  static std::optional<Segment> pieceOf(const Near& near, const Envelope& vehicle,
                                        const VehicleState& state, double reach);
  void list(const Envelope& vehicle, const std::vector<std::unique_ptr<Barrier>>& barriers,
            const VehicleState& state, double reach);
  void addFineWalls(const Envelope& vehicle, const VehicleState& state,
                    const PlanRectangle& within);
  void listWalls(const Barrier& barrier, const Envelope& vehicle, const VehicleState& state,
                 const WallQuery::Margins& margins);
  void listFaces(const Barrier& barrier, std::span<const int> walls);
  int surfaceNumber(const Barrier& barrier, int wall);

  WallQuery query_;
  bool isKnown_ = false;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();    // the region: the vehicle's place,
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // its axes, and
  WallQuery::Margins margins_;                          // how far it reaches beyond the envelope
  // Those that stand still come first, and are known until the vehicle leaves the region; then come
  // those that move, of this step.
  std::vector<Near> faces_;
  std::size_t listedFaces_ = 0;  // the first of them; then one for each crowd of fine walls
  std::vector<const Barrier*> withFine_;  // barriers that may be near
  std::vector<FineWalls::Crowd> fine_;
  std::vector<Surface> surfaces_;
  std::vector<Owner> owners_;  // of the surfaces
  std::size_t standingFaces_ = 0;
  std::size_t standingFine_ = 0;
  std::size_t standingSurfaces_ = 0;
  std::size_t listedSurfaces_ = 0;  // the first of both; what comes after is entered
  std::vector<Segment> segments_;
  CrowdedWalls crowds_;
  // Walls were found in the last step: cutting all faces at once is then fastest.
  bool wasThere_ = false;
};

template <typename IsOfIt>
void NearbyWalls::enter(const IsOfIt& isOfIt, double depth) {
  for (Segment& segment : segments_) {
    if (!isOfIt(segment)) continue;
    const auto number = static_cast<std::size_t>(segment.surface);
    if (surfaces_[number].entered) {
      surfaces_[number].depth = std::max(surfaces_[number].depth, depth);
      continue;
    }
    std::size_t entered = listedSurfaces_;
    while (entered < surfaces_.size() &&
           !(owners_[entered] == owners_[number] && surfaces_[entered].depth == depth)) {
      ++entered;
    }
    if (entered == surfaces_.size()) {
      const Owner owner = owners_[number];
      owners_.push_back(owner);
      Surface surface = surfaces_[number];
      surface.entered = true;
      surface.depth = depth;
      surfaces_.push_back(surface);
    }
    segment.surface = static_cast<int>(entered);
  }
}

}  // namespace bumper
