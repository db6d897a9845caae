#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bumper/response/outline.h"
#include "envelope.h"
#include "outside.h"
#include "vehicle_bodies.h"
#include "wall_table.h"

namespace bumper {

/// The walls of a mesh that are so small and so many in one place that a vehicle cannot tell them
/// apart: grouped once, so that a step asks for the outside of a group without a look at its walls.
class FineWalls {
 public:
  FineWalls() = default;
  explicit FineWalls(const WallTable& walls);

  [[nodiscard]] bool isEmpty() const { return roots_.empty(); }
  /// Whether a wall is one of them.
  [[nodiscard]] bool has(std::size_t wall) const { return !isFine_.empty() && isFine_[wall]; }

  /// Calls with one of them for each mesh of the scene.
  template <typename Call>
  void forEachMesh(const Call& call) const {
    for (const std::uint32_t root : roots_) call(static_cast<int>(groups_[root].wall));
  }

  /// What lies close together, from above.
  struct Crowd {
    int wall = 0;     ///< one of its own
    Outside outside;  ///< in the vehicle's yaw plane; of the part in its band
  };

  /// Fills `crowds` with what may meet a rectangle of the yaw plane: crowds of up to 0.2 m, or
  /// twice that and so on until they are few.
  void find(const Envelope& vehicle, const VehicleState& state, const PlanRectangle& within,
            std::vector<Crowd>& crowds) const;

  /// So many crowds are few.
  static constexpr std::size_t most = 8;

  /// Bytes.
  [[nodiscard]] std::size_t memory() const;

 private:
  // Walls that are together; the parts of a group are in its place.
  struct Group {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    Eigen::Vector3d half = Eigen::Vector3d::Zero();
    // Corners that are extreme in directions of the world's plan.
    std::array<std::uint32_t, Outside::directions> corners{};
    std::uint32_t wall = 0;                   // the first of them
    std::array<std::uint32_t, 2> parts = {};  // numbers of groups; 0: none

    [[nodiscard]] bool hasParts() const { return parts[0] != 0; }
  };
  // A wall, while they are grouped.
  struct Member {
    std::uint32_t wall;
    Eigen::Vector3d low;
    Eigen::Vector3d high;
    [[nodiscard]] Eigen::Vector3d middle() const { return 0.5 * (low + high); }
  };
  // A vehicle's question, and a group as it sees it.
  struct View;

  void choose(const WallTable& walls);
  std::uint32_t group(const WallTable& walls, Member* first, Member* last);
  void findCorners(const WallTable& walls, std::span<const Member> members, Group& made) const;
  [[nodiscard]] bool addCrowds(std::uint32_t number, const View& view, double size,
                               std::vector<Crowd>& crowds) const;
  void addOutside(const Group& group, const View& view, Crowd& crowd) const;

  std::vector<bool> isFine_;  // by wall
  std::vector<Group> groups_;
  std::vector<std::uint32_t> roots_;  // one for each mesh of the scene
  std::vector<Eigen::Vector3d> corners_;
};

}  // namespace bumper
