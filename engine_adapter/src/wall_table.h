#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "bumper/scenes/scene.h"
#include "bumper/scenes/walls.h"
#include "wall_face.h"

namespace bumper {

/// In single precision, never more and never less than the value.
float roundedDown(double value);
float roundedUp(double value);

/// A compact table of walls, and which of them make one face. Corners that are the same are stored
/// once, in double precision around a local origin, and are what ODE's trimesh is built on; foot
/// and top are kept in single precision, rounded away from the wall. A wall is assembled on access.
class WallTable {
 public:
  WallTable() = default;
  /// `walls` were selected from `scene`.
  WallTable(const std::vector<Wall>& walls, const Scene& scene);

  [[nodiscard]] std::size_t size() const { return records_.size(); }
  [[nodiscard]] Wall operator[](std::size_t wall) const;
  /// Which of the scene's meshes a wall belongs to.
  [[nodiscard]] std::uint32_t meshOf(std::size_t wall) const;
  [[nodiscard]] double foot(std::size_t wall) const;
  [[nodiscard]] double top(std::size_t wall) const;
  [[nodiscard]] int triangle(std::size_t wall) const;

  /// Walls that follow one another, of one mesh: [first, last).
  struct Stretch {
    std::size_t first;
    std::size_t last;
  };
  /// Which walls make one face with a wall. Every wall belongs to one face.
  [[nodiscard]] Stretch faceOf(std::size_t wall) const;
  [[nodiscard]] WallFace face(const Stretch& walls) const;
  /// Which wall of a face is at a point of it, or next to a point beside it.
  [[nodiscard]] std::size_t wallAt(const Stretch& walls, const Eigen::Vector3d& point) const;

  /// Where the vertices' zero is. It is the world's own for walls near that.
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  /// Three numbers each, and three indices for each wall; stay where they are when the table moves.
  [[nodiscard]] const std::vector<double>& vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<dTriIndex>& indices() const { return indices_; }

  /// Bytes.
  [[nodiscard]] std::size_t memory() const;

  /// For loops over all walls.
  class Iterator {
   public:
    using difference_type = std::ptrdiff_t;
    using value_type = Wall;
    Iterator(const WallTable& table, std::size_t wall) : table_(&table), wall_(wall) {}
    Wall operator*() const { return (*table_)[wall_]; }
    Iterator& operator++() {
      ++wall_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return wall_ == other.wall_; }

   private:
    const WallTable* table_;
    std::size_t wall_;
  };
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

 private:
  struct Record {
    float foot;  // above the origin
    float top;
  };
  /// Walls of one mesh whose triangles follow one another.
  struct Run {
    std::uint32_t firstWall;
    std::uint32_t mesh;
    std::int32_t firstTriangle;
  };

  [[nodiscard]] Eigen::Vector3d corner(std::size_t wall, std::size_t k) const;
  [[nodiscard]] const Run& runOf(std::size_t wall) const;
  void chooseOrigin(const std::vector<Wall>& walls);
  void findFaces();

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
  std::vector<Record> records_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> faces_;  // the first wall of each
};

}  // namespace bumper
